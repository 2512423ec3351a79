#include "station/light_course.h"

#include "station/light_split.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { STEP_S = 30 };

#define LOW_SUN_COS 0.25881904510252074 /* of 75 degrees from the zenith */

typedef struct course {
    const weather_cells *cells;
    int quantity;
    double first_s;
    double *light; /* shape (cells->count): W/m2 in the mean over a cell */
    double *clear; /* shape (cells->count): sum of the clear sky's over a cell's steps */
    size_t steps;  /* of a cell */
    double cap[WEATHER_RECORDS];    /* 0: no sun */
    double height[WEATHER_RECORDS]; /* cosine of the zenith angle */
} course;

static double of_quantity(const sun_span *sun, int quantity)
{
    return quantity == WEATHER_SERIES_DIRECT_W_M2 ? sun->direct_w_m2 : sun->diffuse_w_m2;
}

static double step_s(const course *c, size_t cell, size_t step)
{
    const weather_cells *cells = c->cells;

    return cells->begin_s +
           cells->span_s * ((double)cell + ((double)step + 0.5) / (double)c->steps);
}

static status open_course(course *c, const site *place)
{
    status rc = STATUS_OK;
    const size_t count = c->cells->count;

    c->steps = (size_t)fmax(1.0, round(c->cells->span_s / STEP_S));
    c->light = calloc(count, sizeof *c->light);
    c->clear = calloc(count * c->steps, sizeof *c->clear);
    NEED(c->light && c->clear, STATUS_MEMORY, "no memory for the course of light");
    for (size_t i = 0; i < count; i++) c->light[i] = c->cells->cell[i].value[c->quantity];
    for (size_t k = 0; k < count * c->steps; k++) {
        const sun_span sun = sun_span_moment(place, step_s(c, k / c->steps, k % c->steps));
        c->clear[k] = of_quantity(&sun, c->quantity);
    }
    for (int i = 0; i < WEATHER_RECORDS; i++) {
        const sun_span sun = sun_span_moment(place, c->first_s + (double)i * WEATHER_INTERVAL_S);
        const double level = sun.direct_w_m2 * sun.cos_zenith + sun.diffuse_w_m2;
        c->height[i] = sun.cos_zenith;
        c->cap[i] = LIGHT_MOST_OF_CLEAR *
                    (c->quantity == WEATHER_SERIES_DIRECT_W_M2 ? sun.direct_w_m2 : level);
    }
out:
    return rc;
}

static double clear_sum(const course *c, size_t cell)
{
    double sum = 0.0;

    for (size_t k = 0; k < c->steps; k++) sum += c->clear[cell * c->steps + k];
    return sum;
}

/* Light of a cell in which the sun is never up is its neighbour's. */
static void light_up_dark_cells(course *c)
{
    for (size_t i = 1; i + 1 < c->cells->count; i++) {
        if (!(c->light[i] > 0.0) || clear_sum(c, i) > 0.0) continue;
        for (int side = 1; side >= -1; side -= 2) {
            const size_t other = side > 0 ? i + 1 : i - 1;
            if (isnan(c->light[other]) || clear_sum(c, other) <= 0.0) continue;
            c->light[other] += c->light[i];
            break;
        }
        c->light[i] = 0.0;
    }
}

static void take_means(double *out_w_m2, const course *c)
{
    const double record_begin_s = c->first_s - 0.5 * WEATHER_INTERVAL_S;
    const double share = c->cells->span_s / (double)c->steps / WEATHER_INTERVAL_S;

    for (int r = 0; r < WEATHER_RECORDS; r++) out_w_m2[r] = 0.0;
    for (size_t i = 0; i < c->cells->count; i++) {
        const double sum = clear_sum(c, i);
        for (size_t k = 0; k < c->steps; k++) {
            const double at = floor((step_s(c, i, k) - record_begin_s) / WEATHER_INTERVAL_S);
            if (at < 0.0 || at >= WEATHER_RECORDS) continue;
            const double part =
                sum > 0.0 ? c->clear[i * c->steps + k] * (double)c->steps / sum : 0.0;
            out_w_m2[(int)at] += fmax(0.0, c->light[i]) * part * share;
            if (isnan(c->light[i])) out_w_m2[(int)at] = NAN;
        }
    }
}

/* Carries what is too much from record to record, from `from` towards `to`, and returns what is left. */
static double carry_on(double *light, const course *c, int from, int to)
{
    const int turn = to > from ? 1 : -1;
    double carried = 0.0;

    for (int i = from; i != to + turn; i += turn) {
        const double own = light[i];
        double most = c->cap[i];
        if (isnan(own)) continue;
        if (c->height[i] > LOW_SUN_COS) most = fmax(most, own);
        light[i] = fmin(most, own + carried);
        carried += own - light[i];
    }
    return carried;
}

/* A day from `from` to `to`: its ends, where the sun is lowest, have too much at first. */
static void level_day(double *light, const course *c, int from, int to)
{
    double left, sum = 0.0;
    int noon = from;

    for (int i = from; i <= to; i++)
        if (c->height[i] > c->height[noon]) noon = i;
    left = carry_on(light, c, from, noon) + carry_on(light, c, to, noon);
    for (int i = from; i <= to; i++) sum += isnan(light[i]) ? 0.0 : c->cap[i];
    for (int i = from; i <= to && left > 0.0 && sum > 0.0; i++) light[i] += left * c->cap[i] / sum;
}

/* Days end where the sun is lowest. */
static void level_days(double *light, const course *c)
{
    int from = 0;

    for (int i = 1; i + 1 < WEATHER_RECORDS; i++) {
        if (!(c->height[i] < c->height[i - 1] && c->height[i] <= c->height[i + 1])) continue;
        level_day(light, c, from, i);
        from = i + 1;
    }
    level_day(light, c, from, WEATHER_RECORDS - 1);
}

status light_course(double *out_w_m2, const weather_cells *cells, const site *place, int quantity,
                    double first_s)
{
    status rc = STATUS_OK;
    course *c = calloc(1, sizeof *c);

    NEED(c, STATUS_MEMORY, "no memory for the course of light");
    *c = (course){.cells = cells, .quantity = quantity, .first_s = first_s};
    TRY(open_course(c, place));
    light_up_dark_cells(c);
    take_means(out_w_m2, c);
    level_days(out_w_m2, c);
out:
    if (c) {
        free(c->light);
        free(c->clear);
    }
    free(c);
    return rc;
}
