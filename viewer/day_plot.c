#include "day_plot.h"

#include "kernels/constants.h"

#include <math.h>

enum { STRIP = 8 };

static const canvas_colour ink = {25, 25, 25, 255}, paper = {255, 255, 255, 220},
                           curve = {178, 24, 43, 255}, sunny = {243, 195, 0, 255},
                           shaded = {120, 130, 150, 255};

static void draw_strip(const preview *p, const pixel_day *day, preview_rectangle into)
{
    const double step = into.width / day->step_count;

    for (uint32_t i = 0; i < day->step_count; i++)
        canvas_fill(p->c, into.x + i * step, into.y, step, into.height,
                    day->lit[i] ? sunny : shaded);
}

static void find_range(const pixel_day *day, double *out_low_k, double *out_high_k)
{
    *out_low_k = INFINITY;
    *out_high_k = -INFINITY;
    for (uint32_t i = 0; i < day->step_count; i++) {
        *out_low_k = fmin(*out_low_k, (double)day->temperature_k[i]); /* fmin passes NAN over */
        *out_high_k = fmax(*out_high_k, (double)day->temperature_k[i]);
    }
}

static void draw_curve(const preview *p, const pixel_day *day, preview_rectangle into, double low_k,
                       double high_k)
{
    const double step = into.width / (day->step_count - 1);

    for (uint32_t i = 1; i < day->step_count; i++) {
        const double before = ((double)day->temperature_k[i - 1] - low_k) / (high_k - low_k);
        const double now = ((double)day->temperature_k[i] - low_k) / (high_k - low_k);
        if (isnan(before) || isnan(now)) continue;
        canvas_line(p->c, into.x + (i - 1) * step, into.y + into.height * (1.0 - before),
                    into.x + i * step, into.y + into.height * (1.0 - now), 1.5 * p->scale, curve);
    }
}

void day_plot_draw(const preview *p, preview_rectangle into)
{
    const pixel_day *day = &p->day.day;
    const double strip = STRIP * p->scale;
    char text[160], time[SITE_TIME_SIZE], temperatures[64] = "";
    double lit_h = 0.0, low_k, high_k;

    if (day->step_count < 2) return;
    for (uint32_t i = 0; i < day->step_count; i++) lit_h += day->lit[i] * day->step_s / 3600.0;
    canvas_fill(p->c, into.x, into.y, into.width,
                into.height + canvas_line_height(p->c, CANVAS_TEXT), paper);
    draw_strip(p, day,
               (preview_rectangle){into.x, into.y + into.height - strip, into.width, strip});
    if (day->temperature_k) {
        find_range(day, &low_k, &high_k);
        if (high_k > low_k)
            draw_curve(
                p, day,
                (preview_rectangle){into.x, into.y + 2.0, into.width, into.height - strip - 4.0},
                low_k, high_k);
        snprintf(temperatures, sizeof temperatures, ", %.1f to %.1f C",
                 low_k - (double)ZERO_CELSIUS_K, high_k - (double)ZERO_CELSIUS_K);
    }
    site_format_time(day->last_s, preview_scene(p)->place.utc_offset_min, time);
    snprintf(text, sizeof text, "24 h to %.5s: sun %.4g h%s", time + 11, lit_h, temperatures);
    canvas_text(p->c, into.x + 4.0, into.y + into.height, CANVAS_TEXT, ink, text);
}
