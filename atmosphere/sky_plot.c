#include "sky_plot.h"

#include "image/colour_map.h"
#include "image/picture.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>

enum {
    PAGE_WIDTH = 600,
    PAGE_HEIGHT = 500,
    RADIUS = 200,
    CENTRE_X = 240,
    CENTRE_Y = 270,
    RING_DEG = 30,
    BAR_X = 490,
    BAR_WIDTH = 18,
    TICKS = 5,
    TITLE_SIZE = 18,
    TEXT_SIZE = 13
};

#define LOG_ABOVE 5.0
#define DECADES 4.0
#define DEGREE (M_PI / 180.0)

static const uint8_t line_rgb[3] = {110, 110, 110};

/* Band radiance by direction, W m-2 sr-1, and what the colours span. */
typedef struct sky {
    const char *title;
    const atmosphere *a;
    double *radiance; /* shape (zenith_count, azimuth_count) */
    double low, high;
    bool is_log;
} sky;

static double integral(const atmosphere *a, const double *values)
{
    double sum = 0.0;

    for (int i = 1; i < a->point_count; i++)
        sum += .5 * (values[i] + values[i - 1]) * (a->wavelength_um[i] - a->wavelength_um[i - 1]);
    return sum;
}

static status integrate(sky *s, const double *direction)
{
    status rc = STATUS_OK;
    const int count = s->a->zenith_count * s->a->azimuth_count;

    s->radiance = malloc((size_t)count * sizeof *s->radiance);
    NEED(s->radiance, STATUS_MEMORY, "no memory to draw a sky");
    for (int i = 0; i < count; i++) {
        s->radiance[i] = integral(s->a, direction + (size_t)i * (size_t)s->a->point_count);
        s->low = i ? fmin(s->low, s->radiance[i]) : s->radiance[i];
        s->high = i ? fmax(s->high, s->radiance[i]) : s->radiance[i];
    }
    s->is_log = s->high > LOG_ABOVE * s->low;
    if (s->is_log) s->low = fmax(s->low, s->high * pow(10.0, -DECADES));
out:
    return rc;
}

static double share_of(const sky *s, double radiance)
{
    if (s->high <= s->low) return .5;
    if (s->is_log) return log(fmax(radiance, s->low) / s->low) / log(s->high / s->low);
    return (radiance - s->low) / (s->high - s->low);
}

static double between(const double *row, double place, int count)
{
    const int i = (int)fmin(floor(place), fmax(count - 2, 0));

    return count == 1 ? row[0] : row[i] + (place - i) * (row[i + 1] - row[i]);
}

static double radiance_at(const sky *s, double zenith_deg, double azimuth_deg)
{
    const atmosphere *a = s->a;
    const double zenith = zenith_deg / a->zenith_step_deg;
    const int i = (int)fmin(floor(zenith), a->zenith_count - 2);
    const double place = a->azimuth_count > 1 ? azimuth_deg / a->azimuth_step_deg : 0.0;
    const double ring[2] = {
        between(s->radiance + i * a->azimuth_count, place, a->azimuth_count),
        between(s->radiance + (i + 1) * a->azimuth_count, place, a->azimuth_count)};

    return between(ring, zenith - i, 2);
}

static void draw_disc(picture *pic, const sky *s)
{
    uint8_t rgb[3];

    for (int y = -RADIUS; y <= RADIUS; y++) {
        for (int x = -RADIUS; x <= RADIUS; x++) {
            const double radius = hypot(x, y);
            const double azimuth = atan2(x, -y) / DEGREE;
            if (radius > RADIUS) continue;
            colour_map_heat(share_of(s, radiance_at(s, 90.0 * radius / RADIUS,
                                                    azimuth < 0.0 ? azimuth + 360.0 : azimuth)),
                            rgb);
            picture_fill(pic, (uint32_t)(CENTRE_X + x), (uint32_t)(CENTRE_Y + y), 1, 1, rgb);
        }
    }
}

static status draw_rings(picture *pic)
{
    status rc = STATUS_OK;
    static const char *const names[] = {"N", "E", "S", "W"};

    for (int zenith = RING_DEG; zenith <= 90; zenith += RING_DEG) {
        const int radius = RADIUS * zenith / 90;
        for (int i = 0; i < 4 * radius; i++) {
            const double angle = 2.0 * M_PI * i / (4 * radius);
            picture_fill(pic, (uint32_t)(CENTRE_X + lround(radius * sin(angle))),
                         (uint32_t)(CENTRE_Y - lround(radius * cos(angle))), 1, 1, line_rgb);
        }
    }
    for (int i = 0; i < 4; i++) {
        const double angle = i * M_PI / 2.0;
        TRY(picture_text(pic, (uint32_t)(CENTRE_X - 5 + lround((RADIUS + 16) * sin(angle))),
                         (uint32_t)(CENTRE_Y + 5 - lround((RADIUS + 16) * cos(angle))), names[i],
                         TEXT_SIZE));
    }
out:
    return rc;
}

static status draw_bar(picture *pic, const sky *s)
{
    status rc = STATUS_OK;
    uint8_t rgb[3];
    char text[32];

    for (int y = 0; y <= 2 * RADIUS; y++) {
        colour_map_heat(s->high > s->low ? 1.0 - y / (2.0 * RADIUS) : .5, rgb);
        picture_fill(pic, BAR_X, (uint32_t)(CENTRE_Y - RADIUS + y), BAR_WIDTH, 1, rgb);
    }
    for (int i = 0; i < TICKS; i++) {
        const double fraction = i / (TICKS - 1.0);
        const double value = s->is_log ? s->low * pow(s->high / s->low, fraction)
                                       : s->low + fraction * (s->high - s->low);
        const uint32_t y = (uint32_t)(CENTRE_Y + RADIUS - lround(2 * RADIUS * fraction));
        picture_fill(pic, BAR_X + BAR_WIDTH, y, 4, 1, line_rgb);
        snprintf(text, sizeof text, "%.3g", value);
        TRY(picture_text(pic, BAR_X + BAR_WIDTH + 8, y + 4, text, TEXT_SIZE));
    }
out:
    return rc;
}

static status draw_names(picture *pic, const sky *s)
{
    status rc = STATUS_OK;
    char text[128];

    snprintf(text, sizeof text, "%.4g to %.4g um [W m-2 sr-1]%s; rings every %d degrees",
             s->a->wavelength_min_um, s->a->wavelength_max_um, s->is_log ? ", logarithmic" : "",
             RING_DEG);
    TRY(picture_text(pic, CENTRE_X - RADIUS, 22, s->title, TITLE_SIZE));
    TRY(picture_text(pic, CENTRE_X - RADIUS, 42, text, TEXT_SIZE));
out:
    return rc;
}

static status draw_page(picture *pic, const void *self)
{
    status rc = STATUS_OK;
    const sky *s = self;

    draw_disc(pic, s);
    TRY(draw_rings(pic));
    TRY(draw_bar(pic, s));
    TRY(draw_names(pic, s));
out:
    return rc;
}

status sky_plot_write(const char *path, const char *title, const atmosphere *a,
                      const double *direction)
{
    status rc = STATUS_OK;
    sky s = {.a = a, .title = title};
    output_file *file = NULL;

    TRY(integrate(&s, direction));
    TRY(output_file_open(&file, path));
    TRY(picture_write(file, PAGE_WIDTH, PAGE_HEIGHT, draw_page, &s));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    free(s.radiance);
    return rc;
}
