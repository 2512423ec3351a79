#include "legend.h"

#include <math.h>

enum { TICK_DISTANCE = 32, BAR = 14, BINS = 64, HISTOGRAM = 70, NUMBERS = 256 };

static const canvas_colour ink = {25, 25, 25, 255}, line = {110, 110, 110, 255};

static void draw_ticks(const preview *p, preview_rectangle bar)
{
    const value_range range = p->colours.range;
    const double span = range.max - range.min;
    const double step = value_range_step(span * TICK_DISTANCE * p->scale / bar.height);
    double tick[VALUE_RANGE_TICKS];
    const size_t count = value_range_ticks(&range, step, tick);
    char text[64];

    for (size_t i = 0; i < count; i++) {
        const double y = bar.y + bar.height * (1.0 - (tick[i] - range.min) / span);
        canvas_fill(p->c, bar.x + bar.width, floor(y), 5.0 * p->scale, 1.0, line);
        value_range_label(text, sizeof text, tick[i], step);
        canvas_text(p->c, bar.x + bar.width + 8.0 * p->scale,
                    y - 0.5 * canvas_line_height(p->c, CANVAS_TEXT), CANVAS_TEXT, ink, text);
    }
}

static void draw_bar(const preview *p, preview_rectangle bar)
{
    const painting_scale *colours = &p->colours;
    const scene *s = p->live->of->s;

    canvas_fill(p->c, bar.x - 1.0, bar.y - 1.0, bar.width + 2.0, bar.height + 2.0, line);
    for (int y = 0; y < (int)bar.height; y++) {
        const double fraction = 1.0 - (y + 0.5) / bar.height;
        uint8_t rgb[3];
        painting_colour(colours, s,
                        colours->range.min + fraction * (colours->range.max - colours->range.min),
                        rgb);
        canvas_fill(p->c, bar.x, bar.y + y, bar.width, 1.0,
                    (canvas_colour){rgb[0], rgb[1], rgb[2], 255});
    }
    draw_ticks(p, bar);
}

static void draw_histogram(const preview *p, preview_rectangle into)
{
    double fraction[BINS];
    const double width = into.width / BINS;

    painting_histogram(preview_values(p), frame_pixels(p->live), p->colours.range, BINS, fraction);
    canvas_fill(p->c, into.x, into.y + into.height, into.width, 1.0, line);
    for (int i = 0; i < BINS; i++)
        canvas_fill(p->c, into.x + i * width, into.y + into.height * (1.0 - fraction[i]), width,
                    into.height * fraction[i], line);
}

/* The materials of the scene that the picture shows, with their colours. */
static void draw_materials(const preview *p, preview_rectangle into)
{
    const scene *s = p->live->of->s;
    const float *value = p->live->values[p->plane];
    const double height = canvas_line_height(p->c, CANVAS_TEXT);
    bool is_shown[NUMBERS] = {false};
    double y = into.y;

    for (size_t i = 0, count = frame_pixels(p->live); i < count; i++)
        if (value[i] >= 0.0f && value[i] < NUMBERS) is_shown[(int)value[i]] = true;
    for (uint32_t i = 0; i < s->material_count && y + height <= into.y + into.height; i++) {
        const uint32_t number = s->materials[i].record.number;
        uint8_t rgb[3];
        if (number >= NUMBERS || !is_shown[number]) continue;
        painting_colour(&p->colours, s, (double)number, rgb);
        canvas_fill(p->c, into.x, y + 3.0, BAR * p->scale, BAR * p->scale - 3.0,
                    (canvas_colour){rgb[0], rgb[1], rgb[2], 255});
        canvas_text(p->c, into.x + (BAR + 6) * p->scale, y, CANVAS_TEXT, ink, s->materials[i].name);
        y += height;
    }
}

static void draw_interactions(const preview *p, preview_rectangle into)
{
    static const char *const names[] = {"missed",        "diffuse",
                                        "sky, specular", "background, specular",
                                        "sky, partly",   "background, partly"};
    double y = into.y;

    for (int i = 0; i < 6; i++, y += canvas_line_height(p->c, CANVAS_TEXT)) {
        uint8_t rgb[3];
        painting_colour(&p->colours, p->live->of->s, i, rgb);
        canvas_fill(p->c, into.x, y + 3.0, BAR * p->scale, BAR * p->scale - 3.0,
                    (canvas_colour){rgb[0], rgb[1], rgb[2], 255});
        canvas_text(p->c, into.x + (BAR + 6) * p->scale, y, CANVAS_TEXT, ink, names[i]);
    }
}

void legend_draw(const preview *p, preview_rectangle into)
{
    const char *unit = p->live->planes[p->plane].plane.unit;
    const double text = canvas_line_height(p->c, CANVAS_TEXT);

    if (p->colours.is_by_number && p->colours.is_facet) return;
    if (p->colours.is_by_number && p->colours.is_material) {
        draw_materials(p, into);
        return;
    }
    if (p->colours.is_by_number) {
        draw_interactions(p, into);
        return;
    }
    const double below = p->shows_histogram ? (HISTOGRAM + 10) * p->scale : 0.0;
    const preview_rectangle bar = {into.x, into.y + text + 4.0, BAR * p->scale,
                                   into.height - text - below - 12.0 * p->scale};
    canvas_text(p->c, into.x, into.y - 4.0, CANVAS_TEXT, ink, unit ? unit : "");
    draw_bar(p, bar);
    if (!p->shows_histogram) return;
    draw_histogram(p, (preview_rectangle){into.x, into.y + into.height - HISTOGRAM * p->scale,
                                          into.width, HISTOGRAM * p->scale});
}
