#include "weather/weather_clock.h"

#include "sky/sun.h"
#include "weather/sun_span.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { STEP_S = 900, SHIFTS = 48, DAY_STEPS = 96, HOUR_STEPS = 4 };

#define BELOW_COS (-0.0697564737441253) /* of 94 degrees from the zenith */
#define DARK_W_M2 5.0
#define NIGHT_SHARE 0.01
#define MANY_DAYS 10.0
#define LEAST_OF_DARK_H 0.25
#define LEAST_H 0.75
#define LEAST_OF_FEW_H 1.5
#define CLOSE 0.97
#define AS_GOOD 2e-3

typedef struct curves {
    size_t count;
    double *light;  /* shape (count): quarter hours; not-a-number: missing */
    double *clear;  /* shape (count + 2 SHIFTS): from 12 h before */
    double *height; /* the same: cosine of the zenith angle */
} curves;

static status open_curves(curves *c, const double *light_w_m2, size_t count, double first_s,
                          double step_s, const site *place)
{
    status rc = STATUS_OK;

    c->count = (size_t)fmax(1.0, floor((double)count * step_s / STEP_S));
    const size_t all = c->count + 2 * SHIFTS;
    const double begin_s = first_s - 0.5 * step_s;
    c->light = calloc(c->count, sizeof *c->light);
    c->clear = calloc(all, sizeof *c->clear);
    c->height = calloc(all, sizeof *c->height);
    NEED(c->light && c->clear && c->height, STATUS_MEMORY,
         "no memory to compare light with the sun");
    for (size_t i = 0; i < c->count; i++)
        c->light[i] =
            light_w_m2[(size_t)fmin(((double)i + 0.5) * STEP_S / step_s, (double)(count - 1))];
    for (size_t i = 0; i < all; i++) {
        const sun_span sun = sun_span_moment(place, begin_s + STEP_S * ((double)i + 0.5 - SHIFTS));
        c->clear[i] = sun.direct_w_m2 + sun.diffuse_w_m2;
        c->height[i] = sun.cos_zenith;
    }
out:
    return rc;
}

/* How light that is moved by a shift goes with the clear sky: 1 if it is a part of it. */
static double correlation(const curves *c, int shift)
{
    double both = 0.0, light = 0.0, clear = 0.0;

    for (size_t i = 0; i < c->count; i++) {
        const double l = c->light[i], g = c->clear[i + (size_t)(SHIFTS + shift)];
        if (isnan(l)) continue;
        both += l * g;
        light += l * l;
        clear += g * g;
    }
    return light > 0.0 && clear > 0.0 ? both / sqrt(light * clear) : 0.0;
}

static double night_share(const curves *c)
{
    double sum = 0.0, night = 0.0;

    for (size_t i = 1; i + 1 < c->count; i++) {
        const double *height = &c->height[i + SHIFTS];
        if (!(c->light[i] > DARK_W_M2)) continue;
        sum += c->light[i];
        if (height[-2] < BELOW_COS && height[0] < BELOW_COS && height[2] < BELOW_COS)
            night += c->light[i];
    }
    return sum > 0.0 ? night / sum : 0.0;
}

static double days_with_light(const curves *c)
{
    double days = 0.0;

    for (size_t begin = 0; begin < c->count; begin += DAY_STEPS) {
        size_t lit = 0;
        for (size_t i = begin; i < begin + DAY_STEPS && i < c->count; i++)
            lit += c->light[i] > DARK_W_M2;
        days += lit >= 4;
    }
    return days;
}

static int best_shift(const curves *c, double *out_correlation)
{
    int best = 0;

    *out_correlation = correlation(c, 0);
    for (int k = 1; k <= SHIFTS; k++)
        for (int side = -1; side <= 1; side += 2) {
            const double there = correlation(c, side * k);
            if (there <= *out_correlation + 1e-4) continue;
            *out_correlation = there;
            best = side * k;
        }
    /* Time zones are whole hours, mostly. */
    const int whole = HOUR_STEPS * (int)lround((double)best / HOUR_STEPS);
    const double there = correlation(c, whole);
    if (there < *out_correlation - AS_GOOD) return best;
    *out_correlation = there;
    return whole;
}

status weather_clock_compare(weather_clock *out, const double *light_w_m2, size_t count,
                             double first_s, double step_s, const site *place)
{
    status rc = STATUS_OK;
    curves c = {0};
    double fit;

    *out = (weather_clock){0};
    if (count < 2) return STATUS_OK;
    TRY(open_curves(&c, light_w_m2, count, first_s, step_s, place));
    out->days = days_with_light(&c);
    out->night_share = night_share(&c);
    const double shift_h = best_shift(&c, &fit) * (STEP_S / 3600.0);
    const bool is_dark = out->night_share > NIGHT_SHARE;
    if (fabs(shift_h) < (is_dark ? LEAST_OF_DARK_H : LEAST_H)) goto out;
    if (out->days < MANY_DAYS && !is_dark && (fit < CLOSE || fabs(shift_h) < LEAST_OF_FEW_H))
        goto out;
    out->shift_h = shift_h;
out:
    free(c.light);
    free(c.clear);
    free(c.height);
    return rc;
}
