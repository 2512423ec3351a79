#include "weather/weather_epw.h"

#include "base/number.h"

#include "files/record_file.h"
#include "kernels/constants.h"
#include "weather/weather_series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define KELVIN ((double)ZERO_CELSIUS_K)
#define HOUR_S 3600.0

enum { LOCATION_FIELDS = 10, NEEDED_FIELDS = 24, FIELDS = 36, HEADER_LINES = 20 };

/* Columns that are read; a value at `missing` or above is none. */
static const struct {
    int field;
    const char *name;
    double low, high, missing;
    double scale, offset; /* SI = scale x value + offset */
} columns[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = {6, "a dry bulb temperature in C", -90, 70, 99.9, 1, KELVIN},
    [WEATHER_SERIES_DEW_POINT_K] = {7, "a dew point in C", -90, 70, 99.9, 1, KELVIN},
    [WEATHER_SERIES_PRESSURE_PA] = {9, "a pressure in Pa", 31000, 120000, 999999, 1, 0},
    [WEATHER_SERIES_WIND_M_S] = {21, "a wind speed in m/s", 0, 40, 999, 1, 0},
    [WEATHER_SERIES_DIRECT_W_M2] = {14, "direct radiation in Wh/m2", 0, 1500, 9999, 1, 0},
    [WEATHER_SERIES_DIFFUSE_W_M2] = {15, "diffuse radiation in Wh/m2", 0, 1500, 9999, 1, 0},
    [WEATHER_SERIES_LONGWAVE_W_M2] = {12, "infrared radiation in Wh/m2", 0, 900, 9999, 1, 0},
    [WEATHER_SERIES_COVER] = {23, "an opaque sky cover in tenths", 0, 10, 99, 0.1, 0},
    [WEATHER_SERIES_RAIN_M_S] = {33, "a precipitation in mm", 0, 500, 999, 1e-3 / HOUR_S, 0},
};

typedef struct epw {
    weather_series series;
    size_t room;
    record_file *file;
    double utc_offset_h;
    double first_s, last_s; /* what is kept */
    int year;               /* of the site's day */
    int stated_year;        /* of all rows; 0: none yet, -1: they differ */
} epw;

/* Cuts a line at its commas. Returns the number of fields, at most `limit`. */
static int split(char *line, int limit, char **out)
{
    int count = 0;

    for (char *at = line; at && count < limit;) {
        char *comma = strchr(at, ',');
        out[count++] = at;
        if (comma) *comma = '\0';
        at = comma ? comma + 1 : NULL;
    }
    return count;
}

static bool take_number(const char *text, double *out)
{
    return number_read_list(text, 1, out);
}

static status take_line(epw *e, char line[2048], const char *expected)
{
    status rc = STATUS_OK;
    const char *text;

    TRY(record_file_text(e->file, &text, expected));
    if (strlen(text) >= 2048) TRY(record_file_reject(e->file, "%s", expected));
    strcpy(line, text);
out:
    return rc;
}

static status read_location(epw *e)
{
    status rc = STATUS_OK;
    static const char expected[] = "LOCATION,city,state,country,source,WMO,latitude,longitude,"
                                   "hours ahead of UTC,elevation";
    char line[2048], *field[LOCATION_FIELDS];

    TRY(take_line(e, line, expected));
    if (split(line, LOCATION_FIELDS, field) < LOCATION_FIELDS || strcmp(field[0], "LOCATION") ||
        !take_number(field[6], &e->series.latitude_deg) ||
        !take_number(field[7], &e->series.longitude_deg) ||
        !take_number(field[8], &e->utc_offset_h))
        TRY(record_file_reject(e->file, "%s", expected));
    if (fabs(e->series.latitude_deg) > 90.0 || fabs(e->series.longitude_deg) > 180.0 ||
        fabs(e->utc_offset_h) > 14.0)
        TRY(record_file_reject(e->file, "a latitude, a longitude and hours ahead of UTC"));
    snprintf(e->series.name, sizeof e->series.name, "%s", field[1]);
out:
    return rc;
}

/* Goes on to the line before the data. */
static status read_periods(epw *e)
{
    status rc = STATUS_OK;
    static const char expected[] = "DATA PERIODS,1,1,... : one record an hour";
    char line[2048], *field[3] = {""};
    double an_hour = 0.0;
    int count = 0;

    for (int i = 0; i < HEADER_LINES && strcmp(field[0], "DATA PERIODS"); i++) {
        TRY(take_line(e, line, expected));
        count = split(line, 3, field);
    }
    if (count < 3 || strcmp(field[0], "DATA PERIODS") || !take_number(field[2], &an_hour) ||
        an_hour != 1.0)
        TRY(record_file_reject(e->file, "%s", expected));
out:
    return rc;
}

/* The most days of a month in any year. */
static int most_days(int month)
{
    return month == 2 ? 29 : month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

static status take_whole(const epw *e, const char *text, const char *name, int low, int high,
                         int *out)
{
    status rc = STATUS_OK;
    double value;

    if (!take_number(text, &value) || value < low || value > high || value != floor(value))
        TRY(record_file_reject(e->file, "%s from %d to %d, not '%s'", name, low, high, text));
    *out = (int)value;
out:
    return rc;
}

/* The end of a row's hour in the year that is nearest to what is kept. */
static status take_time(epw *e, char *const *field, double *out_s)
{
    status rc = STATUS_OK;
    const double middle_s = 0.5 * (e->first_s + e->last_s);
    int year, month, day, hour;

    TRY(take_whole(e, field[0], "a year", 1800, 2200, &year));
    TRY(take_whole(e, field[1], "a month", 1, 12, &month));
    TRY(take_whole(e, field[2], "a day of the month", 1, most_days(month), &day));
    TRY(take_whole(e, field[3], "an hour", 1, 24, &hour));
    e->stated_year = e->stated_year == 0 || e->stated_year == year ? year : -1;
    *out_s = INFINITY;
    for (int k = -1; k <= 1; k++) {
        struct tm date = {.tm_year = e->year + k - 1900, .tm_mon = month - 1, .tm_mday = day};
        const double time_s = (double)timegm(&date) + HOUR_S * (hour - e->utc_offset_h);
        if (date.tm_mday != day) continue; /* the year has no such day */
        if (fabs(time_s - middle_s) < fabs(*out_s - middle_s)) *out_s = time_s;
    }
out:
    return rc;
}

static status take_values(epw *e, char *const *field, int count, weather_sample *out)
{
    status rc = STATUS_OK;

    for (int q = 0; q < WEATHER_SERIES_COUNT; q++) {
        double value = NAN;
        out->value[q] = NAN;
        if (columns[q].field >= count) continue;
        if (!take_number(field[columns[q].field], &value))
            TRY(record_file_reject(e->file, "%s in field %d, not '%s'", columns[q].name,
                                   columns[q].field + 1, field[columns[q].field]));
        if (value >= columns[q].missing) continue;
        if (value < columns[q].low || value > columns[q].high)
            TRY(record_file_reject(e->file, "%s from %g to %g in field %d, not %g", columns[q].name,
                                   columns[q].low, columns[q].high, columns[q].field + 1, value));
        out->value[q] = columns[q].scale * value + columns[q].offset;
    }
    /* 0 is how some files say that it was not measured. */
    if (out->value[WEATHER_SERIES_LONGWAVE_W_M2] == 0.0)
        out->value[WEATHER_SERIES_LONGWAVE_W_M2] = NAN;
out:
    return rc;
}

static status read_row(epw *e)
{
    status rc = STATUS_OK;
    char line[2048], *field[FIELDS];
    weather_sample sample;

    TRY(take_line(e, line, "an hour of weather"));
    const int count = split(line, FIELDS, field);
    if (count < NEEDED_FIELDS)
        TRY(record_file_reject(e->file, "an hour of %d fields or more with commas between",
                               NEEDED_FIELDS));
    TRY(take_time(e, field, &sample.end_s));
    TRY(take_values(e, field, count, &sample));
    if (sample.end_s >= e->first_s && sample.end_s <= e->last_s)
        TRY(weather_series_add(&e->series, &e->room, &sample));
out:
    return rc;
}

static int by_time(const void *a, const void *b)
{
    const double x = ((const weather_sample *)a)->end_s, y = ((const weather_sample *)b)->end_s;

    return (x > y) - (x < y);
}

status weather_epw_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    const double midnight_s = site_midnight_s(place);
    const time_t clock_s = (time_t)(midnight_s + 60.0 * place->utc_offset_min);
    epw e = {.series = {.path = path, .span_s = HOUR_S},
             .first_s = midnight_s - 86400.0 - HOUR_S,
             .last_s = midnight_s + 86400.0 + HOUR_S};
    struct tm date;

    gmtime_r(&clock_s, &date);
    e.year = date.tm_year + 1900;
    TRY(record_file_open(&e.file, path));
    TRY(read_location(&e));
    TRY(read_periods(&e));
    while (!record_file_at_end(e.file)) TRY(read_row(&e));
    if (e.series.count > 0)
        qsort(e.series.sample, e.series.count, sizeof *e.series.sample, by_time);
    if (e.stated_year > 0 && e.stated_year != e.year)
        status_warn("%s: is the weather of %d, the scene's year is %d", path, e.stated_year,
                    e.year);
    TRY(weather_series_history(out, &e.series, place));
out:
    weather_series_free(&e.series);
    record_file_free(e.file);
    return rc;
}
