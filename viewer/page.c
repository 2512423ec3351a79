#include "page.h"

#include "inspection.h"
#include "legend.h"
#include "motion.h"
#include "overlay.h"
#include "sky/sun.h"

#include <math.h>
#include <string.h>

/* Pixels at scale 1; the page is never smaller than the title needs. */
enum { MARGIN = 12, SIDE = 150, TOP = 56, FOOT = 26, LEAST_WIDTH = 560, LEAST_HEIGHT = 300 };

static const canvas_colour ink = {25, 25, 25, 255}, faint = {90, 90, 90, 255},
                           paper = {255, 255, 255, 220};

static int larger(int a, int b)
{
    return a > b ? a : b;
}

void preview_page_size(int columns, int rows, double scale, int *out_width, int *out_height)
{
    *out_width = larger(columns + (int)(scale * (2 * MARGIN + SIDE)), (int)(scale * LEAST_WIDTH));
    *out_height = larger(rows + (int)(scale * (TOP + FOOT)), (int)(scale * LEAST_HEIGHT));
}

/* Pixels of the page that are left for the picture. */
static void find_room(const preview *p, int *out_width, int *out_height)
{
    *out_width = larger(16, p->width - (int)(p->scale * (2 * MARGIN + SIDE)));
    *out_height = larger(16, p->height - (int)(p->scale * (TOP + FOOT)));
}

void page_fit(const preview *p, int *out_columns, int *out_rows)
{
    const int each = larger(1, (int)p->scale);

    find_room(p, out_columns, out_rows);
    *out_columns = larger(16, *out_columns / each);
    *out_rows = larger(16, *out_rows / each);
}

/* A small picture is enlarged by a whole factor, so that its pixels stay alike. */
void page_place(preview *p)
{
    int width, height;

    find_room(p, &width, &height);
    const double factor =
        fmax(1.0, floor(fmin((double)width / p->wish.columns, (double)height / p->wish.rows)));
    p->picture = (preview_rectangle){floor(p->scale * MARGIN), floor(p->scale * TOP),
                                     factor * p->wish.columns, factor * p->wish.rows};
}

bool page_find_pixel(const preview *p, double x, double y, int *out_column, int *out_row)
{
    const double column = floor((x - p->picture.x) / p->picture.width * p->wish.columns);
    const double row = floor((y - p->picture.y) / p->picture.height * p->wish.rows);

    if (column < 0.0 || row < 0.0 || column >= p->wish.columns || row >= p->wish.rows) return false;
    *out_column = (int)column;
    *out_row = (int)row;
    return true;
}

void page_find_point(const preview *p, int column, int row, double *out_x, double *out_y)
{
    *out_x = p->picture.x + (column + 0.5) * p->picture.width / p->wish.columns;
    *out_y = p->picture.y + (row + 0.5) * p->picture.height / p->wish.rows;
}

static void draw_title(const preview *p)
{
    char text[512], time[SITE_TIME_SIZE];
    const double x = p->scale * MARGIN, y = p->scale * 6.0;

    if (!p->live) {
        canvas_text(p->c, x, y, CANVAS_HEADING, ink, p->state.task ? p->state.task : "opening");
        return;
    }
    const scene *s = p->live->of->s;
    const render_plane *plane = &p->live->planes[p->plane];
    const sun_position sun = sun_at(p->live->time_s, s->place.latitude_deg, s->place.longitude_deg);
    const bool has_unit = plane->plane.unit && !plane->plane.categorical;
    snprintf(text, sizeof text, "%s: %s%s%s%s%s, %s", s->name, plane->name,
             p->difference ? " minus the pinned picture" : "", has_unit ? " [" : "",
             has_unit ? plane->plane.unit : "", has_unit ? "]" : "",
             s->thesis ? "thesis" : "exact");
    canvas_text(p->c, x, y, CANVAS_HEADING, ink, text);
    site_format_time(p->live->time_s, s->place.utc_offset_min, time);
    snprintf(text, sizeof text, "%s   sun %.1f deg %s the horizon, azimuth %.1f deg   %d x %d%s",
             time, fabs(90.0 - sun.zenith_rad * 180.0 / M_PI),
             sun.zenith_rad < 0.5 * M_PI ? "above" : "below", sun.azimuth_rad * 180.0 / M_PI,
             p->live->camera.columns, p->live->camera.rows, p->live->is_exact ? "" : ", coarse");
    canvas_text(p->c, x, y + canvas_line_height(p->c, CANVAS_HEADING), CANVAS_TEXT, faint, text);
}

/* An arrow to the north as the middle of the picture sees it. */
static void draw_north(const preview *p)
{
    double right, down;
    const double size = 20.0 * p->scale;

    motion_north(&p->live->camera, &right, &down);
    const double length = hypot(right, down);
    if (length < 1e-6) return;
    const double x = p->picture.x + p->picture.width - 1.6 * size, y = p->picture.y + 1.6 * size;
    const double dx = right / length * size, dy = down / length * size;
    canvas_fill(p->c, x - 1.4 * size, y - 1.4 * size, 2.8 * size, 2.8 * size, paper);
    canvas_line(p->c, x - dx, y - dy, x + 0.5 * dx, y + 0.5 * dy, 2.0 * p->scale, ink);
    for (int side = -1; side <= 1; side += 2)
        canvas_line(p->c, x + 0.5 * dx, y + 0.5 * dy, x + 0.05 * dx - side * 0.25 * dy,
                    y + 0.05 * dy + side * 0.25 * dx, 2.0 * p->scale, ink);
    canvas_text(p->c, x + 0.95 * dx - 0.5 * canvas_text_width(p->c, CANVAS_TEXT, "N"),
                y + 0.95 * dy - 0.5 * canvas_line_height(p->c, CANVAS_TEXT), CANVAS_TEXT, ink, "N");
}

/* Fits a frame into a rectangle, its sides in proportion, with a caption below. */
static void draw_fitting(const preview *p, int index, const frame *f, preview_rectangle to,
                         const char *caption)
{
    const double text = canvas_line_height(p->c, CANVAS_TEXT), room = to.height - 2.0 * text;
    const double factor = fmin(to.width / f->camera.columns, room / f->camera.rows);
    const double width = floor(factor * f->camera.columns), height = floor(factor * f->camera.rows);
    const double y = floor(to.y + 0.5 * (room - height));

    canvas_picture(p->c, index, floor(to.x + 0.5 * (to.width - width)), y, width, height);
    canvas_text(p->c, to.x + 4.0, y + height, CANVAS_TEXT, ink, caption);
}

static void draw_beside(const preview *p)
{
    const preview_rectangle r = p->picture;
    const double half = 0.5 * r.width;
    const value_range range = p->pinned_colours.range;
    char caption[2 * RENDER_PLANE_NAME_SIZE], time[SITE_TIME_SIZE];

    canvas_fill(p->c, r.x, r.y, r.width, r.height, (canvas_colour){235, 235, 235, 255});
    site_format_time(p->pinned->time_s, p->pinned->of->s->place.utc_offset_min, time);
    const char *plane = p->pinned->planes[p->pinned_plane].name;
    if (strcmp(plane, p->live->planes[p->plane].name)) /* else the bar stands for both */
        snprintf(caption, sizeof caption, "%.5s %s, %.4g to %.4g", time + 11, plane, range.min,
                 range.max);
    else
        snprintf(caption, sizeof caption, "%.5s %s", time + 11, plane);
    draw_fitting(p, 1, p->pinned, (preview_rectangle){r.x, r.y, half - 2.0, r.height}, caption);
    site_format_time(p->live->time_s, p->live->of->s->place.utc_offset_min, time);
    snprintf(caption, sizeof caption, "%.5s %s", time + 11, p->live->planes[p->plane].name);
    draw_fitting(p, 0, p->live, (preview_rectangle){r.x + half + 2.0, r.y, half - 2.0, r.height},
                 caption);
}

static void draw_picture(const preview *p)
{
    const preview_rectangle r = p->picture;

    canvas_fill(p->c, r.x - 1.0, r.y - 1.0, r.width + 2.0, r.height + 2.0,
                (canvas_colour){110, 110, 110, 255});
    if (p->compare == PREVIEW_BESIDE && p->pinned) {
        draw_beside(p);
        return;
    }
    canvas_picture(p->c, 0, r.x, r.y, r.width, r.height);
    draw_north(p);
}

static void draw_foot(const preview *p)
{
    char text[600];
    const double x = p->scale * MARGIN, y = p->height - p->scale * FOOT + 2.0;

    if (p->state.error[0]) {
        overlay_message(p, p->state.error);
        return;
    }
    if (p->state.is_at_rest && p->live)
        snprintf(text, sizeof text, "%s", p->note[0] ? p->note : "h shows the keys");
    else
        snprintf(text, sizeof text, "%s %.0f %%   %s", p->state.task ? p->state.task : "",
                 100.0 * p->state.progress, p->note);
    canvas_text(p->c, x, y, CANVAS_TEXT, faint, text);
}

status page_draw(preview *p)
{
    const double gap = p->scale * MARGIN;
    const preview_rectangle side = {p->width - p->scale * SIDE, p->scale * TOP,
                                    p->scale * SIDE - gap, p->height - p->scale * (TOP + FOOT)};

    canvas_begin(p->c, p->width, p->height);
    draw_title(p);
    if (p->live) {
        draw_picture(p);
        legend_draw(p, side);
        if (p->shows_values && p->compare != PREVIEW_BESIDE) inspection_draw(p);
    }
    draw_foot(p);
    overlay_draw(p);
    return canvas_end(p->c);
}
