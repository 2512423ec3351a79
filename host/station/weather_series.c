#include "station/weather_series.h"

#include "base/array.h"
#include "sky/sun.h"
#include "station/light_course.h"
#include "station/weather_cells.h"
#include "weather/weather_clock.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

enum { CLOUD_TYPE = 4, LONGEST = 10000000 };

#define FAR_KM 50.0
#define EARTH_KM 6371.0
#define RADIAN (M_PI / 180.0)
#define MOST_OFFSET_H 3.5 /* from the sun's time: China's west is 3 h off */
#define MOST_NIGHT 0.01

const char *const weather_series_names[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = "air temperature",
    [WEATHER_SERIES_DEW_POINT_K] = "humidity",
    [WEATHER_SERIES_PRESSURE_PA] = "pressure",
    [WEATHER_SERIES_WIND_M_S] = "wind",
    [WEATHER_SERIES_DIRECT_W_M2] = "direct sun",
    [WEATHER_SERIES_DIFFUSE_W_M2] = "diffuse light",
    [WEATHER_SERIES_LONGWAVE_W_M2] = "longwave",
    [WEATHER_SERIES_COVER] = "cloud cover",
    [WEATHER_SERIES_RAIN_M_S] = "rain",
    [WEATHER_SERIES_HUMIDITY] = "relative humidity",
    [WEATHER_SERIES_GLOBAL_W_M2] = "global irradiance",
    [WEATHER_SERIES_LONGWAVE_UP_W_M2] = "longwave from the ground",
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

/* What a record is made of: values that may be missing. */
typedef struct making {
    const weather_series *series;
    const site *place;
    double first_s;
    weather_cells cells;
    double value[WEATHER_RECORDS][WEATHER_SERIES_COUNT];
} making;

static bool is_up(const site *place, double time_s)
{
    return sun_at(time_s, place->latitude_deg, place->longitude_deg).zenith_rad < 0.5 * M_PI;
}

static double time_of(const making *m, int record)
{
    return m->first_s + (double)record * WEATHER_INTERVAL_S;
}

/* Means of the short spans whose middles lie around a record; of the beam those alone with the sun up or down as
 * at the record, if there are any. */
static void set_means(making *m, int record)
{
    const int beam = WEATHER_SERIES_DIRECT_W_M2;
    const double time_s = time_of(m, record), half_s = 0.5 * WEATHER_INTERVAL_S;
    int count[WEATHER_SERIES_COUNT] = {0};
    double sum[WEATHER_SERIES_COUNT] = {0}, other_w_m2 = (double)NAN;

    for (size_t i = 0; i < m->cells.count; i++) {
        const double middle_s = m->cells.cell[i].end_s - 0.5 * m->cells.span_s;
        if (middle_s < time_s - half_s || middle_s >= time_s + half_s) continue;
        const bool is_day = is_up(m->place, middle_s) == is_up(m->place, time_s);
        for (int q = 0; q < WEATHER_SERIES_COUNT; q++) {
            const double value = m->cells.cell[i].value[q];
            if (q == beam && !is_day) other_w_m2 = value;
            if (isnan(value) || (q == beam && !is_day)) continue;
            sum[q] += value;
            count[q]++;
        }
    }
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
        m->value[record][q] = count[q] ? sum[q] / count[q] : (double)NAN;
    if (!count[beam]) m->value[record][beam] = other_w_m2;
}

/* The air between the ends of two long spans. */
static void set_between(making *m, int record)
{
    const weather_cells *cells = &m->cells;
    const double at =
        (time_of(m, record) + m->series->air_before_s - cells->begin_s) / cells->span_s - 1.0;
    const size_t a = (size_t)fmax(0.0, floor(at + 1e-6));
    const double fraction = fmax(0.0, at - (double)a);

    for (int q = 0; q < WEATHER_SERIES_COUNT; q++) {
        const double low = cells->cell[a].value[q], high = cells->cell[a + 1].value[q];
        m->value[record][q] = fraction < 1e-6 ? low : low + fraction * (high - low);
    }
}

static status set_light(making *m, int quantity)
{
    status rc = STATUS_OK;
    double light[WEATHER_RECORDS];

    TRY(light_course(light, &m->cells, m->place, quantity, m->first_s));
    for (int i = 0; i < WEATHER_RECORDS; i++) m->value[i][quantity] = light[i];
out:
    return rc;
}

/* A quantity's first gap: from `from` to before the value that is returned. */
static int end_of_gap(const making *m, int quantity, int from)
{
    while (from < WEATHER_RECORDS && isnan(m->value[from][quantity])) from++;
    return from;
}

static status check_complete(const making *m)
{
    status rc = STATUS_OK;
    const double step_h = WEATHER_INTERVAL_S / 3600.0;

    for (int q = 0; q <= WEATHER_SERIES_DIFFUSE_W_M2; q++)
        for (int i = 0; i < WEATHER_RECORDS; i++)
            NEED(!isnan(m->value[i][q]), STATUS_FORMAT,
                 "%s: no %s at %.2f h of the two days that end with the scene's, until %.2f h: "
                 "expected both days, gaps of an hour at most",
                 m->series->path, weather_series_names[q], i * step_h,
                 (end_of_gap(m, q, i) - 1) * step_h);
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
        .time_h = (double)i * WEATHER_INTERVAL_S / 3600.0,
        .air_temperature_k = air_k,
        .pressure_pa = v[WEATHER_SERIES_PRESSURE_PA],
        .relative_humidity = weather_saturation_pa(dew_point_k) / weather_saturation_pa(air_k),
        .dew_point_k = dew_point_k,
        .wind_m_s = v[WEATHER_SERIES_WIND_M_S],
        .direct_w_m2 = is_up(m->place, m->first_s + (double)i * WEATHER_INTERVAL_S)
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

static double first_of(const weather_series *series)
{
    return series->sample[0].end_s - series->span_s;
}

/* Light of all samples at a regular step, which the caller frees; NULL without memory. */
static double *light_of(const weather_series *series, size_t *out_count)
{
    const double first_s = series->sample[0].end_s;
    const double last_s = series->sample[series->count - 1].end_s;
    const size_t count = 1 + (size_t)lround((last_s - first_s) / series->span_s);
    double *light = count <= LONGEST ? malloc(count * sizeof *light) : NULL;

    for (size_t i = 0; light && i < count; i++) light[i] = NAN;
    for (size_t i = 0; light && i < series->count; i++) {
        const double *v = series->sample[i].value;
        const double both = v[WEATHER_SERIES_DIRECT_W_M2] + v[WEATHER_SERIES_DIFFUSE_W_M2];
        light[lround((series->sample[i].end_s - first_s) / series->span_s)] =
            isnan(both) ? v[WEATHER_SERIES_GLOBAL_W_M2] : both;
    }
    *out_count = count;
    return light;
}

/* Offset from UTC against the longitude; the sun is not asked. */
static void check_offset(const weather_series *series)
{
    const double sun_h = series->longitude_deg / 15.0;

    if (!(fabs(remainder(series->utc_offset_h - sun_h, 24.0)) > MOST_OFFSET_H)) return;
    status_warn(
        "%s: states %+.4g h from UTC, at longitude %.4g the sun's time is %+.2g h from it: is the "
        "time zone right?",
        series->path, series->utc_offset_h, series->longitude_deg, sun_h);
}

static void warn_of_shift(const weather_series *series, const weather_clock *clock)
{
    const char *turn = clock->shift_h > 0.0 ? "later" : "earlier";
    char night[64] = "", fit[96] = "", zone[64] = "";

    if (clock->night_share > MOST_NIGHT)
        snprintf(night, sizeof night, ", %.0f %% of it falls by night", 100.0 * clock->night_share);
    if (clock->shift_h != 0.0)
        snprintf(fit, sizeof fit, ": times %.4g h %s would fit", fabs(clock->shift_h), turn);
    if (clock->shift_h != 0.0 && !isnan(series->utc_offset_h))
        snprintf(zone, sizeof zone, ", or %+.4g h from UTC where it states %+.4g",
                 remainder(series->utc_offset_h - clock->shift_h, 24.0), series->utc_offset_h);
    status_warn("%s: its light does not fit the sun at latitude %.4g, longitude %.4g%s%s%s",
                series->path, series->latitude_deg, series->longitude_deg, night, fit, zone);
}

static status check_clock(const weather_series *series)
{
    status rc = STATUS_OK;
    const site station = {.latitude_deg = series->latitude_deg,
                          .longitude_deg = series->longitude_deg};
    weather_clock clock;
    size_t count;
    double *light = light_of(series, &count);

    if (!light) return STATUS_OK;
    TRY(weather_clock_compare(&clock, light, count, series->sample[0].end_s - 0.5 * series->span_s,
                              series->span_s, &station));
    if (clock.shift_h != 0.0 || clock.night_share > MOST_NIGHT)
        warn_of_shift(series, &clock);
    else if (clock.days == 0.0)
        check_offset(series);
out:
    free(light);
    return rc;
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
    const bool is_long = m->series->span_s > WEATHER_INTERVAL_S;

    TRY(weather_cells_make(&m->cells, m->series, m->place, m->first_s));
    for (int i = 0; i < WEATHER_RECORDS; i++) {
        if (is_long)
            set_between(m, i);
        else
            set_means(m, i);
    }
    if (is_long) TRY(set_light(m, WEATHER_SERIES_DIRECT_W_M2));
    if (is_long) TRY(set_light(m, WEATHER_SERIES_DIFFUSE_W_M2));
    TRY(check_complete(m));
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
    TRY(check_clock(series));
    TRY(fill(m));
    TRY(weather_allocate(&w, WEATHER_RECORDS, WEATHER_INTERVAL_S));
    for (int i = 0; i < WEATHER_RECORDS; i++) w->record[i] = record_of(m, i);
    *out = w;
    w = NULL;
out:
    weather_free(w);
    if (m) weather_cells_free(&m->cells);
    free(m);
    return rc;
}
