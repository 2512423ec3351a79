#include "station/weather_cells.h"

#include "station/light_split.h"
#include "weather/sun_span.h"

#include <math.h>
#include <stdlib.h>

#define HOUR_S 3600.0
#define DAY_S 86400.0
#define MARGIN_S (2.0 * HOUR_S)
#define SEA_LEVEL_PA 101325.0
#define WET_K 1.0 /* of noise of dew points in saturated air */
#define ODD_DIFFERENCE 0.3
#define MOST_DIFFERENCE 0.1 /* of the global irradiance */

static double pressure_at(double elevation_m)
{
    return SEA_LEVEL_PA * pow(1.0 - 2.25577e-5 * elevation_m, 5.25588);
}

static double end_of(const weather_cells *cells, size_t i)
{
    return cells->begin_s + (double)(i + 1) * cells->span_s;
}

/* Whether a cell lies in the two days, at least in part. */
static bool is_needed(const weather_cells *cells, size_t i, double first_s)
{
    return end_of(cells, i) > first_s + 1.0 &&
           end_of(cells, i) - cells->span_s < first_s + 2.0 * DAY_S - 1.0;
}

static status allocate(weather_cells *cells, const weather_series *series, double first_s)
{
    status rc = STATUS_OK;
    const double span_s = series->span_s;
    const double from_s = first_s - MARGIN_S;

    /* The borders of cells are those of the samples. */
    cells->begin_s = series->sample[0].end_s -
                     span_s * (1.0 + floor((series->sample[0].end_s - from_s) / span_s));
    cells->span_s = span_s;
    cells->count = 1 + (size_t)ceil((2.0 * DAY_S + 2.0 * MARGIN_S) / span_s);
    cells->cell = malloc(cells->count * sizeof *cells->cell);
    NEED(cells->cell, STATUS_MEMORY, "%s: no memory for %zu samples", series->path, cells->count);
    for (size_t i = 0; i < cells->count; i++) {
        cells->cell[i].end_s = end_of(cells, i);
        for (int q = 0; q < WEATHER_SERIES_COUNT; q++) cells->cell[i].value[q] = NAN;
    }
out:
    return rc;
}

static void take_samples(weather_cells *cells, const weather_series *series)
{
    for (size_t i = 0; i < series->count; i++) {
        const double at = round((series->sample[i].end_s - cells->begin_s) / cells->span_s) - 1.0;
        if (at < 0.0 || at >= (double)cells->count) continue;
        weather_sample *cell = &cells->cell[(size_t)at];
        for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
            if (!isnan(series->sample[i].value[q])) cell->value[q] = series->sample[i].value[q];
    }
}

static void fill_outside(weather_cells *cells, const weather_series *series, double first_s)
{
    const double begin_s = series->sample[0].end_s - series->span_s;
    const double end_s = series->sample[series->count - 1].end_s;
    const size_t day = (size_t)lround(DAY_S / cells->span_s);
    double filled_s = 0.0;

    for (size_t i = 0; i < cells->count; i++) {
        const bool before = end_of(cells, i)<begin_s + 1.0, after = end_of(cells, i)> end_s + 1.0;
        const size_t other = before ? i + day : i - day;
        if (!(before || after) || other >= cells->count) continue;
        for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
            cells->cell[i].value[q] = cells->cell[other].value[q];
        if (is_needed(cells, i, first_s)) filled_s += cells->span_s;
    }
    if (filled_s > 0.0)
        status_warn("%s: covers %.4g of the 48 hours that end with the scene's day: the others are "
                    "those of the same clock time on the other day",
                    series->path, (2.0 * DAY_S - filled_s) / HOUR_S);
}

/* Returns whether it set one. */
static bool set_dew_point(weather_sample *s)
{
    double *v = s->value;

    if (!isnan(v[WEATHER_SERIES_DEW_POINT_K]) || isnan(v[WEATHER_SERIES_AIR_K]) ||
        isnan(v[WEATHER_SERIES_HUMIDITY]))
        return false;
    v[WEATHER_SERIES_DEW_POINT_K] =
        weather_dew_point_k(v[WEATHER_SERIES_AIR_K], fmin(1.0, v[WEATHER_SERIES_HUMIDITY]));
    return true;
}

typedef struct derived {
    size_t dew_point, wet, split, closed, pressure;
} derived;

/* Sets dew points, and tells those that lie above the air's temperature. */
static status fill_humidity(weather_cells *cells, const weather_series *series, double first_s,
                            derived *count)
{
    status rc = STATUS_OK;
    double most = -INFINITY;

    for (size_t i = 0; i < cells->count; i++) {
        const double *v = cells->cell[i].value;
        const bool was_set = set_dew_point(&cells->cell[i]);
        if (was_set) most = fmax(most, v[WEATHER_SERIES_HUMIDITY]);
        if (!is_needed(cells, i, first_s)) continue;
        count->dew_point += was_set;
        count->wet += v[WEATHER_SERIES_DEW_POINT_K] > v[WEATHER_SERIES_AIR_K] + WET_K;
    }
    NEED(count->dew_point == 0 || most > WEATHER_DRIEST, STATUS_FORMAT,
         "%s: its relative humidity is at most %.3g %%: expected per cent, not fractions",
         series->path, 100.0 * most);
out:
    return rc;
}

static void complete_light(weather_sample *s, const weather_cells *cells, const site *place,
                           derived *count)
{
    double *direct = &s->value[WEATHER_SERIES_DIRECT_W_M2];
    double *diffuse = &s->value[WEATHER_SERIES_DIFFUSE_W_M2];
    const double global = s->value[WEATHER_SERIES_GLOBAL_W_M2];

    if (!isnan(*direct) && !isnan(*diffuse)) return;
    const sun_span sun = sun_span_at(place, s->end_s - cells->span_s, s->end_s);
    if (sun.beyond_w_m2 <= 0.0) {
        if (isnan(*direct)) *direct = 0.0;
        if (isnan(*diffuse)) *diffuse = 0.0;
        return;
    }
    const bool was_split = light_split_complete(&sun, global, direct, diffuse);
    count->split += was_split;
    count->closed += !was_split && !isnan(*direct) && !isnan(*diffuse);
}

/* Bridges cells `from` to `to`, which are missing, from those at their ends. */
static void bridge_light(weather_cells *cells, const site *place, int quantity, size_t from,
                         size_t to)
{
    const bool is_beam = quantity == WEATHER_SERIES_DIRECT_W_M2;
    double share[2];

    for (int side = 0; side < 2; side++) {
        const size_t i = side ? to + 1 : from - 1;
        const sun_span sun = sun_span_at(place, end_of(cells, i) - cells->span_s, end_of(cells, i));
        const double clear = is_beam ? sun.direct_w_m2 : sun.diffuse_w_m2;
        share[side] = clear > 10.0 ? cells->cell[i].value[quantity] / clear : (double)NAN;
    }
    for (size_t i = from; i <= to; i++) {
        const double fraction = (double)(i - from + 1) / (double)(to - from + 2);
        const sun_span sun = sun_span_at(place, end_of(cells, i) - cells->span_s, end_of(cells, i));
        const double clear = is_beam ? sun.direct_w_m2 : sun.diffuse_w_m2;
        const double a = isnan(share[0]) ? share[1] : share[0];
        const double b = isnan(share[1]) ? share[0] : share[1];
        cells->cell[i].value[quantity] = isnan(a) ? 0.0 : (a + fraction * (b - a)) * clear;
    }
}

static void bridge_air(weather_cells *cells, int quantity, size_t from, size_t to)
{
    const double a = cells->cell[from - 1].value[quantity], b = cells->cell[to + 1].value[quantity];

    for (size_t i = from; i <= to; i++)
        cells->cell[i].value[quantity] =
            a + (b - a) * (double)(i - from + 1) / (double)(to - from + 2);
}

/* Bridges up to an hour. */
static void bridge(weather_cells *cells, const site *place, int quantity)
{
    const bool is_light =
        quantity == WEATHER_SERIES_DIRECT_W_M2 || quantity == WEATHER_SERIES_DIFFUSE_W_M2;
    const size_t most = (size_t)floor((HOUR_S + 1.0) / cells->span_s);

    for (size_t from = 1; from + 1 < cells->count; from++) {
        size_t to = from;
        if (!isnan(cells->cell[from].value[quantity]) ||
            isnan(cells->cell[from - 1].value[quantity]))
            continue;
        while (to + 1 < cells->count && isnan(cells->cell[to + 1].value[quantity])) to++;
        if (to + 1 < cells->count && to - from < most) {
            if (is_light)
                bridge_light(cells, place, quantity, from, to);
            else
                bridge_air(cells, quantity, from, to);
        }
        from = to;
    }
}

/* How far the global irradiance is from that of direct and diffuse light, of its own, in the mean of where all
 * three are known; 0 where they never are. */
static double misfit_of_global(const weather_cells *cells, const site *place)
{
    double sum = 0.0, difference = 0.0;

    for (size_t i = 0; i < cells->count; i++) {
        const double *v = cells->cell[i].value;
        const double global = v[WEATHER_SERIES_GLOBAL_W_M2];
        const sun_span sun = sun_span_at(place, end_of(cells, i) - cells->span_s, end_of(cells, i));
        const double others =
            v[WEATHER_SERIES_DIRECT_W_M2] * sun.cos_zenith + v[WEATHER_SERIES_DIFFUSE_W_M2];
        if (isnan(global) || isnan(others) || sun.beyond_w_m2 <= 0.0) continue;
        sum += global;
        difference += fabs(global - others);
    }
    return sum > 0.0 ? difference / sum : 0.0;
}

static bool lacks_light(const weather_cells *cells)
{
    for (size_t i = 0; i < cells->count; i++)
        if (isnan(cells->cell[i].value[WEATHER_SERIES_DIRECT_W_M2]) ||
            isnan(cells->cell[i].value[WEATHER_SERIES_DIFFUSE_W_M2]))
            return true;
    return false;
}

static void fill_light(weather_cells *cells, const weather_series *series, const site *place,
                       double first_s, derived *count)
{
    const double misfit = misfit_of_global(cells, place);

    if (misfit > ODD_DIFFERENCE)
        status_warn(
            "%s: its global irradiance differs from its direct and diffuse light by %.2g %% in "
            "the mean: are all three in the units that it states?",
            series->path, 100.0 * misfit);
    if (!lacks_light(cells)) return;
    if (misfit > MOST_DIFFERENCE) {
        bridge(cells, place, WEATHER_SERIES_DIRECT_W_M2);
        bridge(cells, place, WEATHER_SERIES_DIFFUSE_W_M2);
    }
    for (size_t i = 0; i < cells->count; i++) {
        derived here = {0};
        complete_light(&cells->cell[i], cells, place, &here);
        if (!is_needed(cells, i, first_s)) continue;
        count->split += here.split;
        count->closed += here.closed;
    }
}

static void tell(const weather_series *series, const derived *count)
{
    const double hours = series->span_s / HOUR_S;

    if (count->dew_point > 0)
        status_warn("%s: the dew point of %.4g hours follows from the relative humidity",
                    series->path, (double)count->dew_point * hours);
    if (count->wet > 0)
        status_warn("%s: the dew point of %.4g hours lies above the air's temperature, which is "
                    "taken for it",
                    series->path, (double)count->wet * hours);
    if (count->split > 0)
        status_warn(
            "%s: direct and diffuse light of %.4g hours follow from the global irradiance, by "
            "the diffuse fraction of Erbs (1982)",
            series->path, (double)count->split * hours);
    if (count->closed > 0)
        status_warn(
            "%s: direct or diffuse light of %.4g hours is what the other leaves of the global "
            "irradiance",
            series->path, (double)count->closed * hours);
    if (count->pressure > 0)
        status_warn("%s: the pressure of %.4g hours is that of the standard atmosphere at %.4g m: "
                    "%.4g hPa",
                    series->path, (double)count->pressure * hours, series->elevation_m,
                    0.01 * pressure_at(series->elevation_m));
}

status weather_cells_make(weather_cells *out, const weather_series *series, const site *place,
                          double first_s)
{
    status rc = STATUS_OK;
    derived count = {0};

    *out = (weather_cells){0};
    TRY(allocate(out, series, first_s));
    take_samples(out, series);
    fill_outside(out, series, first_s);
    TRY(fill_humidity(out, series, first_s, &count));
    fill_light(out, series, place, first_s, &count);
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++) bridge(out, place, q);
    for (size_t i = 0; i < out->count; i++) {
        double *pressure_pa = &out->cell[i].value[WEATHER_SERIES_PRESSURE_PA];
        if (!isnan(*pressure_pa) || isnan(series->elevation_m)) continue;
        *pressure_pa = pressure_at(series->elevation_m);
        count.pressure += is_needed(out, i, first_s);
    }
    tell(series, &count);
out:
    return rc;
}

void weather_cells_free(weather_cells *cells)
{
    free(cells->cell);
    *cells = (weather_cells){0};
}
