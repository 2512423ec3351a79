#include "inspection.h"

#include "day_plot.h"
#include "image/image.h"
#include "kernels/constants.h"
#include "page.h"

#include <math.h>
#include <stdarg.h>

enum { LINE_LIMIT = 40, LINE_SIZE = 160, SPECTRUM_BANDS = 3, PLOT_WIDTH = 280, PLOT_HEIGHT = 60 };

static const canvas_colour ink = {25, 25, 25, 255}, paper = {255, 255, 255, 220},
                           mark = {0, 230, 118, 255}, curve = {178, 24, 43, 255};

typedef struct lines {
    char text[LINE_LIMIT][LINE_SIZE];
    int count;
} lines;

__attribute__((format(printf, 2, 3))) static void add(lines *l, const char *format, ...);

static void add(lines *l, const char *format, ...)
{
    va_list arguments;

    if (l->count == LINE_LIMIT) return;
    va_start(arguments, format);
    vsnprintf(l->text[l->count++], LINE_SIZE, format, arguments);
    va_end(arguments);
}

/* The value of a plane at a pixel, or IMAGE_NO_DATA. */
static float value_at(const frame *f, const char *plane, size_t pixel)
{
    const size_t i = frame_find(f, plane);

    return i < f->plane_count && f->values[i] ? f->values[i][pixel] : IMAGE_NO_DATA;
}

static void add_names(lines *l, const frame *f, size_t pixel)
{
    const scene *s = f->of->s;
    const geometry *g = s->shape;
    const float facet = value_at(f, "facet", pixel), material = value_at(f, "material", pixel);
    uint32_t i = 0;

    if (facet != IMAGE_NO_DATA) {
        while (i < g->facet_count && (float)g->facet_id[i] != facet) i++;
        if (i < g->facet_count && g->part[i] < g->part_count) {
            const uint32_t part = g->part[i];
            add(l, "object %s", g->object_name[g->part_object[part]]);
            add(l, "part %s, facet %.0f", g->part_name[part], (double)facet);
        }
    } else if (material != IMAGE_NO_DATA) {
        add(l, "the ground beyond the scene");
    } else {
        add(l, "sky");
    }
    for (i = 0; i < s->material_count; i++)
        if ((float)s->materials[i].record.number == material)
            add(l, "material %s", s->materials[i].name);
}

/* Whether a plane belongs to another band than the one that is shown. */
static bool is_of_other_band(const preview *p, const render_plane *plane)
{
    const render_plane *shown = &p->live->planes[p->plane];
    const uint32_t number = shown->is_of_band ? shown->source / BAND_PLANES : 0;

    return plane->is_of_band && plane->source / BAND_PLANES != number;
}

static void add_values(lines *l, const preview *p, size_t pixel)
{
    const frame *f = p->live;

    for (size_t i = 0; i < f->plane_count; i++) {
        const render_plane *plane = &f->planes[i];
        if (!f->values[i] || plane->plane.categorical || is_of_other_band(p, plane)) continue;
        if (f->values[i][pixel] == IMAGE_NO_DATA) continue;
        add(l, "%s %.6g %s", plane->name, (double)f->values[i][pixel],
            plane->plane.unit ? plane->plane.unit : "");
    }
    if (p->difference) add(l, "difference %.6g", (double)p->difference[pixel]);
}

/* Radiance against wavelength. */
static void draw_spectrum(const preview *p, size_t pixel, preview_rectangle into)
{
    const frame *f = p->live;
    const uint32_t bands = f->of->s->band_count;
    double most = 0.0, x0 = 0.0, y0 = 0.0;
    char text[64];

    for (uint32_t b = 0; b < bands; b++) most = fmax(most, (double)f->values[b][pixel]);
    const double first_um = f->planes[0].plane.wavelength_um;
    const double last_um = f->planes[bands - 1].plane.wavelength_um;
    if (most <= 0.0 || last_um == first_um) return;
    canvas_fill(p->c, into.x, into.y, into.width, into.height, paper);
    for (uint32_t b = 0; b < bands; b++) {
        const double fraction =
            (f->planes[b].plane.wavelength_um - first_um) / (last_um - first_um);
        const double x = into.x + fraction * into.width;
        const double y =
            into.y + into.height * (1.0 - fmax(0.0, (double)f->values[b][pixel]) / most);
        if (b > 0) canvas_line(p->c, x0, y0, x, y, 1.5 * p->scale, curve);
        x0 = x;
        y0 = y;
    }
    snprintf(text, sizeof text, "%.4g to %.4g um, up to %.4g", first_um, last_um, most);
    canvas_text(p->c, into.x + 2.0, into.y + into.height, CANVAS_TEXT, ink, text);
}

static void draw_cross(const preview *p)
{
    double x, y;
    const double arm = 8.0 * p->scale, width = 2.0 * p->scale;

    page_find_point(p, p->pick_column, p->pick_row, &x, &y);
    canvas_line(p->c, x - arm, y, x - 0.3 * arm, y, width, mark);
    canvas_line(p->c, x + 0.3 * arm, y, x + arm, y, width, mark);
    canvas_line(p->c, x, y - arm, x, y - 0.3 * arm, width, mark);
    canvas_line(p->c, x, y + 0.3 * arm, x, y + arm, width, mark);
}

/* The plots stand on the pixel's side, above it or below it. */
static preview_rectangle place_plots(const preview *p)
{
    const double pad = 6.0 * p->scale, width = PLOT_WIDTH * p->scale;
    const double each = PLOT_HEIGHT * p->scale + 1.3 * canvas_line_height(p->c, CANVAS_TEXT);
    const int count = preview_has_day(p) + (p->live->of->s->band_count >= SPECTRUM_BANDS);
    const bool is_left = p->pick_column <= p->wish.columns / 2;
    const bool is_above = p->pick_row > p->wish.rows / 2;

    return (preview_rectangle){
        .x = p->picture.x + (is_left ? pad : p->picture.width - width - pad),
        .y = p->picture.y + (is_above ? pad : p->picture.height - count * each),
        .width = width,
        .height = count * each,
    };
}

static void draw_plots(const preview *p, size_t pixel, preview_rectangle all)
{
    preview_rectangle plot = {all.x, all.y, all.width, PLOT_HEIGHT * p->scale};

    if (preview_has_day(p)) {
        day_plot_draw(p, plot);
        plot.y += plot.height + 1.3 * canvas_line_height(p->c, CANVAS_TEXT);
    }
    if (p->live->of->s->band_count >= SPECTRUM_BANDS) draw_spectrum(p, pixel, plot);
}

/* The lines stand on the side where the pixel is not, and where that is too narrow, clear of the
 * plots too; there are as many as fit. */
static void draw_lines(const preview *p, const lines *l, preview_rectangle plots)
{
    const double height = canvas_line_height(p->c, CANVAS_TEXT), pad = 6.0 * p->scale;
    double y = p->picture.y + pad, room = p->picture.height - 2.0 * pad;
    int width = 0;

    for (int i = 0; i < l->count; i++) {
        const int wide = canvas_text_width(p->c, CANVAS_TEXT, l->text[i]);
        width = wide > width ? wide : width;
    }
    if (width + 4.0 * pad + plots.width > p->picture.width) {
        if (plots.y < y + pad) y += plots.height;
        room -= plots.height;
    }
    const int count = (int)fmax(0.0, fmin(l->count, floor((room - pad) / height)));
    const double x = p->pick_column > p->wish.columns / 2
                         ? p->picture.x + pad
                         : p->picture.x + fmax(pad, p->picture.width - width - 3.0 * pad);
    if (count > 0) canvas_fill(p->c, x, y, width + 2.0 * pad, count * height + pad, paper);
    for (int i = 0; i < count; i++)
        canvas_text(p->c, x + pad, y + 0.5 * pad + i * height, CANVAS_TEXT, ink, l->text[i]);
}

void inspection_draw(const preview *p)
{
    lines l = {.count = 0};
    const size_t pixel = preview_pixel(p, p->live, p->pick_column, p->pick_row);
    const preview_rectangle plots = place_plots(p);

    add(&l, "column %d, row %d", p->pick_column, p->pick_row);
    add_names(&l, p->live, pixel);
    add_values(&l, p, pixel);
    draw_lines(p, &l, plots);
    draw_plots(p, pixel, plots);
    draw_cross(p);
}

static void write_day(const preview *p, FILE *to)
{
    const pixel_day *day = &p->day.day;
    char time[SITE_TIME_SIZE];

    for (uint32_t i = 0; i < day->step_count; i++) {
        site_format_time(day->last_s - (day->step_count - 1 - i) * day->step_s,
                         preview_scene(p)->place.utc_offset_min, time);
        fprintf(to, "day %s %d", time, day->lit[i]);
        if (day->temperature_k)
            fprintf(to, " %.9g", (double)(day->temperature_k[i] - ZERO_CELSIUS_K));
        fprintf(to, "\n");
    }
}

void inspection_write(const preview *p, FILE *to)
{
    const frame *f = p->live;
    const size_t pixel = preview_pixel(p, f, p->pick_column, p->pick_row);

    for (size_t i = 0; i < f->plane_count; i++)
        if (f->values[i])
            fprintf(to, "pixel %d %d %s %.9g %s\n", p->pick_column, p->pick_row, f->planes[i].name,
                    (double)f->values[i][pixel],
                    f->planes[i].plane.unit ? f->planes[i].plane.unit : "");
    if (p->difference)
        fprintf(to, "pixel %d %d difference %.9g %s\n", p->pick_column, p->pick_row,
                (double)p->difference[pixel],
                f->planes[p->plane].plane.unit ? f->planes[p->plane].plane.unit : "");
    write_day(p, to);
    fflush(to);
}
