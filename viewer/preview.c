#include "preview.h"

#include "base/interrupt.h"
#include "control.h"
#include "image/image.h"
#include "inspection.h"
#include "page.h"

#include <math.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

/* How long a step of preview_rest waits. */
static const double pause_s = 0.005;

static status check_plane(const shared_scene *of, const char *plane)
{
    status rc = STATUS_OK;
    double *no_wavelengths = calloc(of->s->band_count, sizeof *no_wavelengths);
    render_plane *planes = NULL;
    size_t count = 0;

    NEED(no_wavelengths, STATUS_MEMORY, "no memory for the list of planes");
    TRY(render_plane_list(&planes, &count, of->s, no_wavelengths, no_wavelengths));
    TRY(render_plane_check(planes, count, plane));
out:
    free(planes);
    free(no_wavelengths);
    return rc;
}

status preview_open(preview **out, surface *s, shared_scene *of, int columns, int rows,
                    const char *plane, FILE *picks)
{
    status rc = STATUS_OK;
    char title[256];
    preview *p = calloc(1, sizeof *p);

    NEED(p, STATUS_MEMORY, "no memory for a preview");
    if (plane) TRY(check_plane(of, plane));
    if (plane) snprintf(p->plane_name, sizeof p->plane_name, "%s", plane);
    p->s = s;
    p->picks = picks;
    p->first = shared_scene_hold(of);
    p->camera = of->s->camera;
    p->wish = (session_wish){.columns = columns, .rows = rows};
    p->pick_column = columns / 2;
    p->pick_row = rows / 2;
    p->is_stale = true;
    TRY(session_open(&p->work, of, &p->wish));
    p->wished = 1;
    s->measure(s, &p->width, &p->height, &p->scale);
    TRY(canvas_open(&p->c, s, p->scale));
    page_place(p);
    snprintf(title, sizeof title, "radsig: %s", of->s->name);
    s->name(s, title);
    *out = p;
    p = NULL;
out:
    preview_free(p);
    return rc;
}

void preview_free(preview *p)
{
    if (!p) return;
    full_render_free(p->full);
    session_free(p->work);
    canvas_free(p->c);
    pixel_day_free(&p->day.day);
    frame_drop(p->live);
    frame_drop(p->pinned);
    shared_scene_drop(p->first);
    free(p->difference);
    free(p);
}

void preview_resize(preview *p, int width, int height)
{
    p->width = width;
    p->height = height;
    page_fit(p, &p->wish.columns, &p->wish.rows);
    p->pick_column = p->wish.columns / 2;
    p->pick_row = p->wish.rows / 2;
    page_place(p);
    preview_ask(p);
}

void preview_ask(preview *p)
{
    p->wish.camera = p->camera;
    p->wished = session_ask(p->work, &p->wish);
    p->prints_values = false;
    p->is_stale = true;
}

const scene *preview_scene(const preview *p)
{
    return p->live ? p->live->of->s : p->first->s;
}

double preview_time_s(const preview *p)
{
    return p->wish.has_time ? p->wish.time_s : preview_scene(p)->place.time_s;
}

bool preview_thesis(const preview *p)
{
    return p->wish.has_mode ? p->wish.thesis : preview_scene(p)->thesis;
}

size_t preview_pixel(const preview *p, const frame *f, int column, int row)
{
    const size_t across = (size_t)column * (size_t)f->camera.columns / (size_t)p->wish.columns;
    const size_t down = (size_t)row * (size_t)f->camera.rows / (size_t)p->wish.rows;

    return down * (size_t)f->camera.columns + across;
}

const float *preview_values(const preview *p)
{
    if (!p->live) return NULL;
    return p->difference ? p->difference : p->live->values[p->plane];
}

static status subtract(preview *p)
{
    status rc = STATUS_OK;

    free(p->difference);
    p->difference = NULL;
    if (p->compare != PREVIEW_DIFFERENCE || !p->pinned) goto out;
    p->difference = malloc(frame_pixels(p->live) * sizeof *p->difference);
    NEED(p->difference, STATUS_MEMORY, "no memory for a difference");
    painting_subtract(p->live, p->live->values[p->plane], p->pinned,
                      p->pinned->values[p->pinned_plane], p->difference);
out:
    return rc;
}

/* The range about 0 that holds both ends. */
static value_range balance(value_range range)
{
    const double most = fmax(fabs(range.min), fabs(range.max));

    range.min = -most;
    range.max = most;
    return range;
}

static status load_picture(preview *p, int index, const frame *f, const float *value,
                           const painting_scale *colours)
{
    status rc = STATUS_OK;
    const size_t facet = frame_find(f, "facet");
    uint8_t *rgb = malloc(frame_pixels(f) * 3);

    NEED(rgb, STATUS_MEMORY, "no memory for the colours");
    painting_fill(colours, f->of->s, value, frame_pixels(f), rgb);
    if (p->shows_outlines && facet < f->plane_count) painting_outline(f, f->values[facet], rgb);
    canvas_load_picture(p->c, index, f->camera.columns, f->camera.rows, rgb);
out:
    free(rgb);
    return rc;
}

/* The range and the colours of the picture, and of the pinned one beside it. */
static status colour(preview *p)
{
    status rc = STATUS_OK;
    const painting_map map = p->difference && p->map == PAINTING_OWN ? PAINTING_DIVERGING : p->map;
    const float *value = preview_values(p);
    value_range range = p->range;

    if (!p->has_fixed_range)
        TRY(value_range_find(&range, value, frame_pixels(p->live), IMAGE_NO_DATA));
    if (p->difference && !p->has_fixed_range) range = balance(range);
    p->range = range;
    p->colours = painting_scale_of(&p->live->planes[p->plane], map, range);
    if (p->difference) p->colours.is_by_number = false;
    TRY(load_picture(p, 0, p->live, value, &p->colours));
    if (p->compare != PREVIEW_BESIDE || !p->pinned) goto out;
    value = p->pinned->values[p->pinned_plane];
    if (strcmp(p->pinned->planes[p->pinned_plane].name, p->live->planes[p->plane].name))
        TRY(value_range_find(&range, value, frame_pixels(p->pinned), IMAGE_NO_DATA));
    p->pinned_colours = painting_scale_of(&p->pinned->planes[p->pinned_plane], map, range);
    TRY(load_picture(p, 1, p->pinned, value, &p->pinned_colours));
out:
    return rc;
}

/* The plane of that name in a new frame; the first where there is none or it has no values. */
static void find_plane(preview *p)
{
    p->plane = frame_find(p->live, p->plane_name);
    if (p->plane == p->live->plane_count || !p->live->values[p->plane]) p->plane = 0;
    snprintf(p->plane_name, sizeof p->plane_name, "%s", p->live->planes[p->plane].name);
}

static void take_frame(preview *p)
{
    frame *f = session_take(p->work);

    if (!f) return;
    frame_drop(p->live);
    p->live = f;
    p->asked_day = SIZE_MAX;
    if (!p->wish.has_camera) p->camera = f->of->s->camera;
    find_plane(p);
    p->is_stale = true;
}

static void take_state(preview *p)
{
    session_state state;
    int percent;

    session_look(p->work, &state);
    if (state.is_at_rest != p->state.is_at_rest || strcmp(state.error, p->state.error) ||
        floor(20.0 * state.progress) != floor(20.0 * p->state.progress) ||
        state.task != p->state.task)
        p->is_stale = true;
    if (state.warning[0] && strcmp(state.warning, p->state.warning))
        preview_note(p, "warning: %s", state.warning);
    p->state = state;
    if (!p->full || full_render_is_told(p->full)) return;
    percent = full_render_percent(p->full);
    preview_note(p, "%s: %d %%", full_render_folder(p->full), percent);
    if (!full_render_is_running(p->full)) full_render_tell(p->full, p->note, sizeof p->note);
}

bool preview_has_day(const preview *p)
{
    return p->day.is_made && p->day.wish == p->live->wish && p->live->is_exact &&
           p->day.pixel == preview_pixel(p, p->live, p->pick_column, p->pick_row);
}

/* Asks for the day of the picked pixel of an exact picture, and takes what was made. */
static void follow_day(preview *p)
{
    session_day day;

    if (session_take_day(p->work, &day)) {
        pixel_day_free(&p->day.day);
        p->day = day;
        p->is_stale = true;
    }
    if (!p->live || !p->live->is_exact || p->live->wish != p->wished) return;
    if (!p->shows_values && !p->prints_values) return;
    const size_t pixel = preview_pixel(p, p->live, p->pick_column, p->pick_row);
    if (pixel == p->asked_day) return;
    p->asked_day = pixel;
    session_pick(p->work, pixel);
}

/* Prints the values that were asked for, if they are those of the wish. */
static void print_picked(preview *p)
{
    if (!p->prints_values || p->live->wish != p->wished || !preview_has_day(p)) return;
    inspection_write(p, p->picks);
    preview_note(p, "the values of pixel %d, %d are printed", p->pick_column, p->pick_row);
    p->prints_values = false;
    p->is_stale = false; /* the note is drawn now */
}

status preview_step(preview *p, bool *out_drew)
{
    status rc = STATUS_OK;

    take_state(p);
    take_frame(p);
    follow_day(p);
    *out_drew = p->is_stale;
    if (!p->is_stale) goto out;
    p->is_stale = false;
    if (p->live) {
        TRY(subtract(p));
        TRY(colour(p));
        print_picked(p);
    }
    TRY(page_draw(p));
    p->s->show(p->s);
out:
    return rc;
}

status preview_rest(preview *p)
{
    status rc = STATUS_OK;
    event e;
    bool drew, rested = false;

    while (!rested && !p->quits) {
        TRY(interrupt_check());
        session_state state;
        session_look(p->work, &state);
        rested = state.is_at_rest && (!p->prints_values || state.error[0]);
        TRY(preview_step(p, &drew));
        if (rested || !p->s->take(p->s, &e, pause_s)) continue;
        if (e.kind == EVENT_CLOSE || e.kind == EVENT_RESIZE) control_take(p, &e);
    }
out:
    return rc;
}

void preview_show_plane(preview *p, size_t plane)
{
    p->plane = plane;
    snprintf(p->plane_name, sizeof p->plane_name, "%s", p->live->planes[plane].name);
    p->has_fixed_range = false;
    p->is_stale = true;
}

void preview_pin(preview *p)
{
    if (!p->live) return;
    frame_drop(p->pinned);
    p->pinned = frame_hold(p->live);
    p->pinned_plane = p->plane;
    p->is_stale = true;
}

void preview_note(preview *p, const char *format, ...)
{
    char text[sizeof p->note];
    va_list arguments;

    va_start(arguments, format);
    vsnprintf(text, sizeof text, format, arguments);
    va_end(arguments);
    if (strcmp(text, p->note)) p->is_stale = true;
    memcpy(p->note, text, sizeof text);
}
