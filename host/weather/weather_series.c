#include "weather/weather_series.h"

#include "sky/sun.h"
#include "weather/clear_sky.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { RECORDS = 193, INTERVAL_S = 900, DAY_RECORDS = 96, BRIDGE = 4, CLOUD_TYPE = 4 };

#define FAR_KM 50.0
#define EARTH_KM 6371.0
#define RADIAN (M_PI / 180.0)
#define BRIGHTEST_W_M2 1400.0

/* The air that the course of a clear sky is taken from. */
static const clear_sky_air common_air = {101325.0, 1.5, CLEAR_SKY_AEROSOL};

static const char *const quantity_names[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = "air temperature",  [WEATHER_SERIES_DEW_POINT_K] = "humidity",
    [WEATHER_SERIES_PRESSURE_PA] = "pressure",   [WEATHER_SERIES_WIND_M_S] = "wind",
    [WEATHER_SERIES_DIRECT_W_M2] = "direct sun", [WEATHER_SERIES_DIFFUSE_W_M2] = "diffuse light",
    [WEATHER_SERIES_LONGWAVE_W_M2] = "longwave", [WEATHER_SERIES_COVER] = "cloud cover",
    [WEATHER_SERIES_RAIN_M_S] = "rain",
};

status weather_series_add(weather_series *series, size_t *room, const weather_sample *sample)
{
    status rc = STATUS_OK;

    if (series->count == *room) {
        const size_t more = *room ? 2 * *room : 256;
        weather_sample *grown = realloc(series->sample, more * sizeof *grown);
        NEED(grown, STATUS_MEMORY, "%s: no memory for %zu samples", series->path, more);
        series->sample = grown;
        *room = more;
    }
    series->sample[series->count++] = *sample;
out:
    return rc;
}

void weather_series_free(weather_series *series)
{
    free(series->sample);
    series->sample = NULL;
    series->count = 0;
}

/* What a record is made of: the sun at it, and values that may be missing. */
typedef struct making {
    const weather_series *series;
    const site *place;
    double first_s;
    double value[RECORDS][WEATHER_SERIES_COUNT];
} making;

static bool is_up(const site *place, double time_s)
{
    return sun_at(time_s, place->latitude_deg, place->longitude_deg).zenith_rad < 0.5 * M_PI;
}

/* Light of the clear sky. */
static double clear_light(const site *place, double time_s, int quantity)
{
    const sun_position sun = sun_at(time_s, place->latitude_deg, place->longitude_deg);
    double direct_w_m2, diffuse_w_m2;

    clear_sky_irradiance(&common_air, sun.zenith_rad, sun.distance_au, &direct_w_m2, &diffuse_w_m2);
    return quantity == WEATHER_SERIES_DIRECT_W_M2 ? direct_w_m2 : diffuse_w_m2;
}

/* What a sample's light is of the clear sky's in its span. */
static double share_of_clear(const making *m, const weather_sample *s, int quantity)
{
    const int parts = 60;
    double sum = 0.0;

    for (int i = 0; i < parts; i++)
        sum += clear_light(m->place, s->end_s - m->series->span_s * (i + 0.5) / parts, quantity);
    return sum > parts ? s->value[quantity] * parts / sum : 0.0;
}

static bool is_light(int quantity)
{
    return quantity == WEATHER_SERIES_DIRECT_W_M2 || quantity == WEATHER_SERIES_DIFFUSE_W_M2;
}

/* Light at a time between long spans: on their border the mean of both. */
static double light_between(const making *m, double time_s, int quantity)
{
    const weather_series *series = m->series;
    double sum = 0.0;
    int count = 0;

    for (size_t i = 0; i < series->count; i++) {
        const weather_sample *s = &series->sample[i];
        if (time_s < s->end_s - series->span_s - 1.0 || time_s > s->end_s + 1.0) continue;
        sum += share_of_clear(m, s, quantity);
        count++;
    }
    return count ? fmin(BRIGHTEST_W_M2, sum / count * clear_light(m->place, time_s, quantity))
                 : (double)NAN;
}

static double air_between(const weather_series *series, double time_s, int quantity)
{
    for (size_t i = 0; i + 1 < series->count; i++) {
        const weather_sample *a = &series->sample[i], *b = a + 1;
        if (time_s < a->end_s - 1.0 || time_s > b->end_s + 1.0) continue;
        if (b->end_s - a->end_s > 1.5 * series->span_s) return NAN;
        const double fraction = (time_s - a->end_s) / (b->end_s - a->end_s);
        return a->value[quantity] + fraction * (b->value[quantity] - a->value[quantity]);
    }
    return NAN;
}

/* Means of the short spans whose middles lie around a record. */
static void set_means(making *m, int record)
{
    const weather_series *series = m->series;
    const double time_s = m->first_s + (double)record * INTERVAL_S;
    int count[WEATHER_SERIES_COUNT] = {0};
    double sum[WEATHER_SERIES_COUNT] = {0};

    for (size_t i = 0; i < series->count; i++) {
        const double middle_s = series->sample[i].end_s - 0.5 * series->span_s;
        if (middle_s < time_s - 0.5 * INTERVAL_S || middle_s >= time_s + 0.5 * INTERVAL_S) continue;
        const bool is_day = is_up(m->place, middle_s) == is_up(m->place, time_s);
        for (int q = 0; q < WEATHER_SERIES_COUNT; q++) {
            const double value = series->sample[i].value[q];
            if (isnan(value) || (q == WEATHER_SERIES_DIRECT_W_M2 && !is_day)) continue;
            sum[q] += value;
            count[q]++;
        }
    }
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
        m->value[record][q] = count[q] ? sum[q] / count[q] : (double)NAN;
}

static void set_between(making *m, int record)
{
    const double time_s = m->first_s + (double)record * INTERVAL_S;

    for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
        m->value[record][q] =
            is_light(q) ? light_between(m, time_s, q) : air_between(m->series, time_s, q);
}

static double first_of(const weather_series *series)
{
    return series->sample[0].end_s - series->span_s;
}

/* Records outside the series take those of the other day. Returns how many. */
static int fill_outside(making *m)
{
    const weather_series *series = m->series;
    int filled = 0;

    for (int i = 0; i < RECORDS; i++) {
        const double time_s = m->first_s + (double)i * INTERVAL_S;
        const bool before = time_s < first_of(series) - 1.0;
        const bool after = time_s > series->sample[series->count - 1].end_s + 1.0;
        const int other = before ? i + DAY_RECORDS : i - DAY_RECORDS;
        if (!(before || after) || other < 0 || other >= RECORDS) continue;
        memcpy(m->value[i], m->value[other], sizeof m->value[i]);
        filled++;
    }
    return filled;
}

/* Bridges what is missing between two records that have it, at most BRIDGE records. */
static void bridge(making *m, int quantity)
{
    int last = -1;

    for (int i = 0; i < RECORDS; i++) {
        if (isnan(m->value[i][quantity])) continue;
        for (int k = last + 1; last >= 0 && i - last <= BRIDGE + 1 && k < i; k++) {
            const double fraction = (double)(k - last) / (double)(i - last);
            m->value[k][quantity] = m->value[last][quantity] +
                                    fraction * (m->value[i][quantity] - m->value[last][quantity]);
        }
        /* Ends of the series: half a step has no sample on one side. */
        if (last < 0 && i == 1) m->value[0][quantity] = m->value[1][quantity];
        last = i;
    }
    if (last == RECORDS - 2) m->value[RECORDS - 1][quantity] = m->value[last][quantity];
}

static status check_complete(const making *m)
{
    status rc = STATUS_OK;

    for (int q = 0; q <= WEATHER_SERIES_DIFFUSE_W_M2; q++)
        for (int i = 0; i < RECORDS; i++)
            NEED(!isnan(m->value[i][q]), STATUS_FORMAT,
                 "%s: no %s at %.2f h of the two days that end with the scene's: expected both "
                 "days, "
                 "gaps of an hour at most",
                 m->series->path, quantity_names[q], (double)i * INTERVAL_S / 3600.0);
out:
    return rc;
}

static double value_or(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

static weather_record record_of(const making *m, int i)
{
    const double *v = m->value[i];
    const double air_k = v[WEATHER_SERIES_AIR_K];
    const double dew_point_k = fmin(air_k, v[WEATHER_SERIES_DEW_POINT_K]);
    const double cover = value_or(v[WEATHER_SERIES_COVER], 0.0);
    const double rain_m_s = value_or(v[WEATHER_SERIES_RAIN_M_S], 0.0);

    return (weather_record){
        .time_h = (double)i * INTERVAL_S / 3600.0,
        .air_temperature_k = air_k,
        .pressure_pa = v[WEATHER_SERIES_PRESSURE_PA],
        .relative_humidity = weather_saturation_pa(dew_point_k) / weather_saturation_pa(air_k),
        .dew_point_k = dew_point_k,
        .wind_m_s = v[WEATHER_SERIES_WIND_M_S],
        .direct_w_m2 = is_up(m->place, m->first_s + (double)i * INTERVAL_S)
                           ? fmax(0.0, v[WEATHER_SERIES_DIRECT_W_M2])
                           : 0.0,
        .diffuse_w_m2 = fmax(0.0, v[WEATHER_SERIES_DIFFUSE_W_M2]),
        .sky_exposure = 1.0 - cover,
        .cloud_type = cover > 0.0 ? CLOUD_TYPE : 0,
        .precipitation_type = rain_m_s > 0.0,
        .precipitation_m_s = rain_m_s,
        .precipitation_temperature_k = air_k,
        .longwave_w_m2 = value_or(v[WEATHER_SERIES_LONGWAVE_W_M2], 0.0),
    };
}

static void check_place(const weather_series *series, const site *place)
{
    const double north = RADIAN * (series->latitude_deg - place->latitude_deg);
    const double east = RADIAN * remainder(series->longitude_deg - place->longitude_deg, 360.0);
    const double side = sin(0.5 * north) * sin(0.5 * north) +
                        cos(RADIAN * series->latitude_deg) * cos(RADIAN * place->latitude_deg) *
                            sin(0.5 * east) * sin(0.5 * east);
    const double km = 2.0 * EARTH_KM * asin(fmin(1.0, sqrt(side)));

    if (km > FAR_KM)
        status_warn("%s: is the weather of %s at latitude %.4g, longitude %.4g, %.0f km from the "
                    "scene's site",
                    series->path, series->name, series->latitude_deg, series->longitude_deg, km);
}

/* The scene's day must be in the series, at least in part. */
static status check_day(const weather_series *series, double midnight_s)
{
    status rc = STATUS_OK;
    char wanted[SITE_TIME_SIZE], first[SITE_TIME_SIZE], last[SITE_TIME_SIZE];

    NEED(series->count > 1, STATUS_FORMAT, "%s: has no weather of the scene's date", series->path);
    site_format_time(midnight_s, 0, wanted);
    site_format_time(first_of(series), 0, first);
    site_format_time(series->sample[series->count - 1].end_s, 0, last);
    NEED(series->sample[series->count - 1].end_s > midnight_s &&
             first_of(series) < midnight_s + 86400.0,
         STATUS_FORMAT, "%s: goes from %s to %s, the scene's day begins at %s", series->path, first,
         last, wanted);
out:
    return rc;
}

static status fill(making *m)
{
    status rc = STATUS_OK;

    for (int i = 0; i < RECORDS; i++) {
        if (m->series->span_s <= INTERVAL_S)
            set_means(m, i);
        else
            set_between(m, i);
    }
    const int filled = fill_outside(m);
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++) bridge(m, q);
    TRY(check_complete(m));
    if (filled > 0)
        status_warn("%s: covers %.4g of the 48 hours that end with the scene's day: the others are "
                    "those of the same clock time on the other day",
                    m->series->path, (RECORDS - filled) * INTERVAL_S / 3600.0);
out:
    return rc;
}

status weather_series_history(weather **out, const weather_series *series, const site *place)
{
    status rc = STATUS_OK;
    const double midnight_s = site_midnight_s(place);
    making *m = malloc(sizeof *m);
    weather *w = NULL;

    NEED(m, STATUS_MEMORY, "%s: no memory to read it", series->path);
    *m = (making){.series = series, .place = place, .first_s = midnight_s - 86400.0};
    TRY(check_day(series, midnight_s));
    check_place(series, place);
    TRY(fill(m));
    TRY(weather_allocate(&w, RECORDS, INTERVAL_S));
    for (int i = 0; i < RECORDS; i++) w->record[i] = record_of(m, i);
    *out = w;
    w = NULL;
out:
    weather_free(w);
    free(m);
    return rc;
}
