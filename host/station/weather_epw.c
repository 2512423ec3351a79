#include "station/weather_epw.h"

#include "base/number.h"
#include "files/column.h"
#include "files/csv_row.h"
#include "files/record_file.h"
#include "kernels/constants.h"
#include "station/weather_series.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define KELVIN ((double)ZERO_CELSIUS_K)
#define HOUR_S 3600.0
#define DAY_S 86400.0
#define AROUND_S (15.0 * DAY_S) /* light of so many days tells whether the clock fits */

enum { LOCATION_FIELDS = 9, NEEDED_FIELDS = 22, HEADER_LINES = 20 };

static const column columns[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = {"dry bulb temperature", "C", 6, -90, 70, 1, KELVIN, false},
    [WEATHER_SERIES_DEW_POINT_K] = {"dew point", "C", 7, -90, 70, 1, KELVIN, false},
    [WEATHER_SERIES_HUMIDITY] = {"relative humidity", "%", 8, 0, 110, 0.01, 0, false},
    [WEATHER_SERIES_PRESSURE_PA] = {"pressure", "Pa", 9, 31000, 120000, 1, 0, false},
    [WEATHER_SERIES_LONGWAVE_W_M2] = {"infrared radiation", "Wh/m2", 12, 0, 900, 1, 0, true},
    [WEATHER_SERIES_GLOBAL_W_M2] = {"global radiation", "Wh/m2", 13, 0, 1800, 1, 0, false},
    [WEATHER_SERIES_DIRECT_W_M2] = {"direct radiation", "Wh/m2", 14, 0, 1500, 1, 0, false},
    [WEATHER_SERIES_DIFFUSE_W_M2] = {"diffuse radiation", "Wh/m2", 15, 0, 1500, 1, 0, false},
    [WEATHER_SERIES_WIND_M_S] = {"wind speed", "m/s", 21, 0, 100, 1, 0, false},
    [WEATHER_SERIES_COVER] = {"opaque sky cover", "tenths", 23, 0, 10, 0.1, 0, false},
    [WEATHER_SERIES_RAIN_M_S] = {"precipitation", "mm", 33, 0, 500, 1e-3 / HOUR_S, 0, false},
};

typedef struct epw {
    weather_series series;
    size_t room;
    record_file *file;
    csv_row row;
    column_gaps gaps;
    double first_s, last_s; /* what is kept: around the scene's day */
    int year;               /* of the site's day */
    int stated_year;        /* of all rows; 0: none yet, -1: they differ */
    bool has_leap_day;      /* a row of 29 February */
} epw;

static status read_location(epw *e)
{
    status rc = STATUS_OK;
    static const char expected[] = "LOCATION,city,state,country,source,WMO,latitude,longitude,"
                                   "hours ahead of UTC,elevation";
    weather_series *series = &e->series;

    TRY(csv_row_take(&e->row, e->file, ',', expected));
    if (e->row.count < LOCATION_FIELDS || strcmp(e->row.field[0], "LOCATION") ||
        !number_read(e->row.field[6], &series->latitude_deg) ||
        !number_read(e->row.field[7], &series->longitude_deg) ||
        !number_read(e->row.field[8], &e->series.utc_offset_h))
        TRY(record_file_reject(e->file, "%s", expected));
    if (fabs(series->latitude_deg) > 90.0 || fabs(series->longitude_deg) > 180.0 ||
        fabs(e->series.utc_offset_h) > 14.0)
        TRY(record_file_reject(e->file, "a latitude, a longitude and hours ahead of UTC"));
    if (!number_read(csv_row_field(&e->row, 9), &series->elevation_m) ||
        !(series->elevation_m >= -500.0 && series->elevation_m <= 9000.0))
        series->elevation_m = NAN;
    snprintf(series->name, sizeof series->name, "%s", e->row.field[1]);
out:
    return rc;
}

/* Goes on to the line before the data. */
static status read_periods(epw *e)
{
    status rc = STATUS_OK;
    static const char expected[] = "DATA PERIODS,1,1,... : one record an hour";
    double an_hour = 0.0;
    int line = 0;

    do TRY(csv_row_take(&e->row, e->file, ',', expected));
    while (++line < HEADER_LINES && strcmp(csv_row_field(&e->row, 0), "DATA PERIODS"));
    if (strcmp(csv_row_field(&e->row, 0), "DATA PERIODS") ||
        !number_read(csv_row_field(&e->row, 2), &an_hour) || an_hour != 1.0)
        TRY(record_file_reject(e->file, "%s", expected));
out:
    return rc;
}

/* The most days of a month in any year. */
static int most_days(int month)
{
    return month == 2 ? 29 : month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

static status take_whole(const epw *e, int field, const char *name, int low, int high, int *out)
{
    status rc = STATUS_OK;
    const char *text = csv_row_field(&e->row, (size_t)field);
    double value;

    if (!number_read(text, &value) || value < low || value > high || value != floor(value))
        TRY(record_file_reject(e->file, "%s from %d to %d, not '%s'", name, low, high, text));
    *out = (int)value;
out:
    return rc;
}

/* The time in the year that is nearest to what is kept; infinite where none of them has such a day. */
static double nearest_time_s(const epw *e, int month, int day, int hour)
{
    const double middle_s = 0.5 * (e->first_s + e->last_s);
    double nearest_s = INFINITY;

    for (int k = -1; k <= 1; k++) {
        struct tm date = {.tm_year = e->year + k - 1900, .tm_mon = month - 1, .tm_mday = day};
        const double time_s = (double)timegm(&date) + HOUR_S * (hour - e->series.utc_offset_h);
        if (date.tm_mday != day) continue;
        if (fabs(time_s - middle_s) < fabs(nearest_s - middle_s)) nearest_s = time_s;
    }
    return nearest_s;
}

typedef struct epw_date {
    int year, month, day, hour;
} epw_date;

static status take_date(epw *e, epw_date *d)
{
    status rc = STATUS_OK;

    TRY(take_whole(e, 0, "a year", 1800, 2200, &d->year));
    TRY(take_whole(e, 1, "a month", 1, 12, &d->month));
    TRY(take_whole(e, 2, "a day of the month", 1, most_days(d->month), &d->day));
    TRY(take_whole(e, 3, "an hour", 0, 24, &d->hour));
    e->stated_year = e->stated_year == 0 || e->stated_year == d->year ? d->year : -1;
    e->has_leap_day |= d->month == 2 && d->day == 29;
out:
    return rc;
}

static status read_row(epw *e)
{
    status rc = STATUS_OK;
    weather_sample sample;
    epw_date d;

    TRY(csv_row_take(&e->row, e->file, ',', "an hour of weather"));
    if (e->row.count < NEEDED_FIELDS)
        TRY(record_file_reject(e->file, "an hour of %d fields or more with commas between",
                               NEEDED_FIELDS));
    TRY(take_date(e, &d));
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
        TRY(column_read(&sample.value[q], &columns[q],
                        csv_row_field(&e->row, (size_t)columns[q].field), e->file, &e->gaps));
    sample.end_s = nearest_time_s(e, d.month, d.day, d.hour);
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

/* Where the scene's days have a 29 February and the file has none, 28 February stands for it. */
static status add_leap_day(epw *e, double first_s)
{
    status rc = STATUS_OK;
    const double day_end_s = nearest_time_s(e, 2, 29, 24), day_begin_s = day_end_s - DAY_S;
    const size_t count = e->series.count;

    if (e->has_leap_day || !isfinite(day_end_s) || day_end_s <= first_s ||
        day_begin_s >= first_s + 2.0 * DAY_S)
        goto out;
    for (size_t i = 0; i < count; i++) {
        weather_sample sample = e->series.sample[i];
        if (sample.end_s <= day_begin_s - DAY_S + 1.0 || sample.end_s > day_begin_s + 1.0) continue;
        sample.end_s += DAY_S;
        TRY(weather_series_add(&e->series, &e->room, &sample));
    }
    if (e->series.count > count)
        status_warn("%s: has no 29 February: 28 February stands for it", e->series.path);
out:
    return rc;
}

status weather_epw_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    const double midnight_s = site_midnight_s(place);
    const time_t clock_s = (time_t)(midnight_s + 60.0 * place->utc_offset_min);
    epw e = {.series = {.path = path, .span_s = HOUR_S},
             .first_s = midnight_s - AROUND_S,
             .last_s = midnight_s + AROUND_S};
    struct tm date;

    gmtime_r(&clock_s, &date);
    e.year = date.tm_year + 1900;
    TRY(record_file_open(&e.file, path));
    TRY(read_location(&e));
    TRY(read_periods(&e));
    while (!record_file_at_end(e.file)) TRY(read_row(&e));
    TRY(add_leap_day(&e, midnight_s - DAY_S));
    if (e.series.count > 0)
        qsort(e.series.sample, e.series.count, sizeof *e.series.sample, by_time);
    column_gaps_tell(&e.gaps, path);
    if (e.stated_year > 0 && e.stated_year != e.year)
        status_warn("%s: is the weather of %d, the scene's year is %d", path, e.stated_year,
                    e.year);
    TRY(weather_series_history(out, &e.series, place));
out:
    weather_series_free(&e.series);
    csv_row_free(&e.row);
    record_file_free(e.file);
    return rc;
}
