#include "weather/weather_surfrad.h"

#include "base/number.h"
#include "files/record_file.h"
#include "kernels/constants.h"
#include "weather/weather_series.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

#define KELVIN ((double)ZERO_CELSIUS_K)
#define MISSING (-9999.0)

enum { NUMBERS = 48, HUMIDITY = 40, BAD = 1 };

/* Columns that are read; the flag stands behind each. */
static const struct {
    int column;
    const char *name;
    double low, high;
    double scale, offset; /* SI = scale x value + offset */
} columns[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = {38, "an air temperature in C", -90, 60, 1, KELVIN},
    [WEATHER_SERIES_DEW_POINT_K] = {HUMIDITY, "a relative humidity in %", 0, 110, 0.01, 0},
    [WEATHER_SERIES_PRESSURE_PA] = {46, "a pressure in mbar", 300, 1100, 100, 0},
    [WEATHER_SERIES_WIND_M_S] = {42, "a wind speed in m/s", 0, 100, 1, 0},
    [WEATHER_SERIES_DIRECT_W_M2] = {12, "direct sun in W/m2", -50, 1500, 1, 0},
    [WEATHER_SERIES_DIFFUSE_W_M2] = {14, "diffuse light in W/m2", -50, 1500, 1, 0},
    [WEATHER_SERIES_LONGWAVE_W_M2] = {16, "longwave in W/m2", 10, 1000, 1, 0},
};

typedef struct surfrad {
    weather_series series;
    size_t room;
    record_file *file;
} surfrad;

/* A station's name, then latitude, longitude, elevation. */
static status read_heading(surfrad *s)
{
    status rc = STATUS_OK;
    static const char expected[] = "latitude, longitude and elevation of the station";
    double where[3]; /* latitude, longitude, elevation */
    const char *text;

    TRY(record_file_text(s->file, &text, "a station's name"));
    snprintf(s->series.name, sizeof s->series.name, "%s", text);
    TRY(record_file_text(s->file, &text, expected));
    const char *end = text;
    for (int i = 0; end && i < 3; i++) end = number_take(end + strspn(end, " \t"), &where[i]);
    if (!end || (*end && !isspace((unsigned char)*end)) || fabs(where[0]) > 90.0 ||
        fabs(where[1]) > 180.0)
        TRY(record_file_reject(s->file, "%s", expected));
    const double latitude_deg = where[0];
    const double longitude_deg = -fabs(where[1]); /* all stations are in America */
    if (s->series.count > 0 &&
        (latitude_deg != s->series.latitude_deg || longitude_deg != s->series.longitude_deg))
        TRY(record_file_reject(s->file, "the station of the days before"));
    s->series.latitude_deg = latitude_deg;
    s->series.longitude_deg = longitude_deg;
out:
    return rc;
}

/* Whether year, month, day, hour and minute are those of a date; the third number is the day of the
 * year. */
static bool is_time(const double number[NUMBERS], struct tm *out)
{
    static const struct {
        double low, high;
    } range[] = {{1990, 2200}, {1, 366}, {1, 12}, {1, 31}, {0, 23}, {0, 59}};
    struct tm when;

    for (size_t i = 0; i < sizeof range / sizeof *range; i++)
        if (!(number[i] >= range[i].low && number[i] <= range[i].high) ||
            number[i] != floor(number[i]))
            return false;
    when = (struct tm){.tm_year = (int)number[0] - 1900,
                       .tm_mon = (int)number[2] - 1,
                       .tm_mday = (int)number[3],
                       .tm_hour = (int)number[4],
                       .tm_min = (int)number[5]};
    *out = when;
    timegm(&when);
    return when.tm_mday == out->tm_mday; /* the month has such a day */
}

static status take_time(const surfrad *s, const double number[NUMBERS], double *out_s)
{
    status rc = STATUS_OK;
    const weather_series *series = &s->series;
    struct tm when;

    if (!is_time(number, &when))
        TRY(record_file_reject(s->file, "year, day of the year, month, day, hour, minute"));
    *out_s = (double)timegm(&when);
    if (series->count > 0 && *out_s <= series->sample[series->count - 1].end_s)
        TRY(record_file_reject(s->file, "a time after the one before"));
out:
    return rc;
}

static status take_values(const surfrad *s, const double number[NUMBERS], weather_sample *out)
{
    status rc = STATUS_OK;

    for (int q = 0; q < WEATHER_SERIES_COUNT; q++) {
        const int c = columns[q].column;
        out->value[q] = NAN;
        if (!columns[q].name || number[c] <= MISSING || number[c + 1] == BAD) continue;
        if (number[c] < columns[q].low || number[c] > columns[q].high)
            TRY(record_file_reject(s->file, "%s from %g to %g in column %d, not %g",
                                   columns[q].name, columns[q].low, columns[q].high, c + 1,
                                   number[c]));
        out->value[q] = columns[q].scale * number[c] + columns[q].offset;
    }
    const double humidity = fmin(1.0, out->value[WEATHER_SERIES_DEW_POINT_K]);
    if (isnan(out->value[WEATHER_SERIES_DEW_POINT_K]) || isnan(out->value[WEATHER_SERIES_AIR_K]))
        out->value[WEATHER_SERIES_DEW_POINT_K] = NAN;
    else
        out->value[WEATHER_SERIES_DEW_POINT_K] =
            weather_dew_point_k(out->value[WEATHER_SERIES_AIR_K], humidity);
out:
    return rc;
}

static status read_row(surfrad *s)
{
    status rc = STATUS_OK;
    double number[NUMBERS];
    weather_sample sample;

    TRY(record_file_numbers(s->file, NUMBERS, number, "48 numbers: a time, then values and flags"));
    TRY(take_time(s, number, &sample.end_s));
    TRY(take_values(s, number, &sample));
    TRY(weather_series_add(&s->series, &s->room, &sample));
out:
    return rc;
}

/* A row begins with its year, a heading with the station's name. */
static bool is_row(record_file *file)
{
    const char *next = record_file_peek(file);

    return next && isdigit((unsigned char)next[strspn(next, " \t\r\n")]);
}

status weather_surfrad_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    surfrad s = {.series = {.path = path}};

    TRY(record_file_open(&s.file, path));
    do {
        TRY(read_heading(&s));
        do TRY(read_row(&s));
        while (is_row(s.file));
    } while (!record_file_at_end(s.file));
    NEED(s.series.count > 1, STATUS_FORMAT, "%s: holds one sample, expected a day", path);
    s.series.span_s = s.series.sample[1].end_s - s.series.sample[0].end_s;
    NEED(s.series.span_s <= 900.0, STATUS_FORMAT,
         "%s: samples are %g minutes apart, expected 15 at most", path, s.series.span_s / 60.0);
    TRY(weather_series_history(out, &s.series, place));
out:
    weather_series_free(&s.series);
    record_file_free(s.file);
    return rc;
}
