#include "station/weather_year.h"

#include "base/number.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <time.h>

#define HOUR_S 3600.0
#define DAY_S 86400.0
#define AROUND_S (15.0 * DAY_S)

weather_year weather_year_around(const site *place, double utc_offset_h)
{
    const double midnight_s = site_midnight_s(place);

    return (weather_year){.place = place,
                          .utc_offset_h = utc_offset_h,
                          .first_s = midnight_s - AROUND_S,
                          .last_s = midnight_s + AROUND_S};
}

int weather_month_days(int month)
{
    return month == 2 ? 29 : month == 4 || month == 6 || month == 9 || month == 11 ? 30 : 31;
}

/* A field's whole number; 0 where the place is below 0. */
static status take_whole(int *out, const csv_row *row, int place, const record_file *file,
                         const char *name, int low, int high)
{
    const char *text = place < 0 ? "0" : csv_row_field(row, (size_t)place);
    double value;

    if (!number_read(text, &value) || value < low || value > high || value != floor(value))
        return record_file_reject(file, "%s from %d to %d, not '%.40s'", name, low, high, text);
    *out = (int)value;
    return STATUS_OK;
}

status weather_date_take(weather_date *out, const csv_row *row, const int place[5],
                         const record_file *file)
{
    status rc = STATUS_OK;
    int hour, minute;

    TRY(take_whole(&out->year, row, place[0], file, "a year", 1800, 2200));
    TRY(take_whole(&out->month, row, place[1], file, "a month", 1, 12));
    TRY(take_whole(&out->day, row, place[2], file, "a day of the month", 1,
                   weather_month_days(out->month)));
    TRY(take_whole(&hour, row, place[3], file, "an hour", 0, 24));
    TRY(take_whole(&minute, row, place[4], file, "a minute", 0, 60));
    out->hour = hour + minute / 60.0;
out:
    return rc;
}

/* The year of a time by the scene's clock. */
static int year_at(const weather_year *y, double time_s)
{
    const time_t clock_s = (time_t)floor(time_s + 60.0 * y->place->utc_offset_min);
    struct tm date;

    gmtime_r(&clock_s, &date);
    return date.tm_year + 1900;
}

/* Infinite where none of the years around has such a day. */
static double nearest_time_s(const weather_year *y, int month, int day, double hour)
{
    const double middle_s = 0.5 * (y->first_s + y->last_s);
    double nearest_s = INFINITY;

    for (int k = -1; k <= 1; k++) {
        struct tm date = {
            .tm_year = year_at(y, middle_s) + k - 1900, .tm_mon = month - 1, .tm_mday = day};
        const double time_s = (double)timegm(&date) + HOUR_S * (hour - y->utc_offset_h);
        if (date.tm_mday != day) continue;
        if (fabs(time_s - middle_s) < fabs(nearest_s - middle_s)) nearest_s = time_s;
    }
    return nearest_s;
}

bool weather_year_take(weather_year *y, const weather_date *date, double *out_s)
{
    int i = 0;

    while (i < y->count && y->year[i] != date->year) i++;
    if (i == y->count && y->count < WEATHER_YEARS) y->year[y->count++] = date->year;
    y->has_leap_day |= date->month == 2 && date->day == 29;
    *out_s = nearest_time_s(y, date->month, date->day, date->hour);
    return *out_s >= y->first_s && *out_s <= y->last_s;
}

static int by_time(const void *a, const void *b)
{
    const double x = ((const weather_sample *)a)->end_s, y = ((const weather_sample *)b)->end_s;

    return (x > y) - (x < y);
}

/* Refuses two rows of one time that differ. */
static status check_twins(const weather_year *y, const weather_series *series)
{
    status rc = STATUS_OK;
    char when[SITE_TIME_SIZE];

    for (size_t i = 1; i < series->count; i++) {
        const weather_sample *a = &series->sample[i - 1], *b = &series->sample[i];
        if (b->end_s - a->end_s >= 1.0 || !memcmp(a->value, b->value, sizeof a->value)) continue;
        site_format_time(b->end_s, y->place->utc_offset_min, when);
        TRY(status_set(STATUS_FORMAT, "%s: has two rows for %s which differ, expected one",
                       series->path, when));
    }
out:
    return rc;
}

static bool has_twins(const weather_series *series)
{
    for (size_t i = 1; i < series->count; i++)
        if (series->sample[i].end_s - series->sample[i - 1].end_s < 1.0 &&
            series->sample[i].year != series->sample[i - 1].year)
            return true;
    return false;
}

static int by_number(const void *a, const void *b)
{
    return *(const int *)a - *(const int *)b;
}

static status refuse_years(const weather_year *y, const weather_series *series)
{
    char list[6 * WEATHER_YEARS + 1] = "";
    int year[WEATHER_YEARS] = {0};
    size_t length = 0;

    for (int i = 0; i < y->count; i++) year[i] = y->year[i];
    qsort(year, (size_t)y->count, sizeof *year, by_number);
    for (int i = 0; i < y->count; i++)
        length += (size_t)snprintf(list + length, sizeof list - length, " %d", year[i] % 100000);
    return status_set(STATUS_FORMAT,
                      "%s: has several years of the scene's day, expected a scene's time in one of "
                      "them:%s",
                      series->path, list);
}

/* Keeps the rows whose year is that of their time. */
static status choose_year(const weather_year *y, weather_series *series)
{
    status rc = STATUS_OK;
    size_t kept = 0;

    if (!has_twins(series)) return STATUS_OK;
    for (size_t i = 0; i < series->count; i++) {
        /* by the file's clock; the last hour of a year ends in the next */
        const double inside_s = series->sample[i].end_s - 1.0 + HOUR_S * y->utc_offset_h -
                                60.0 * y->place->utc_offset_min;
        if (series->sample[i].year == year_at(y, inside_s))
            series->sample[kept++] = series->sample[i];
    }
    if (kept == 0) TRY(refuse_years(y, series));
    series->count = kept;
out:
    return rc;
}

/* 28 February stands for a 29th within the scene's days. */
static status add_leap_day(const weather_year *y, weather_series *series, size_t *room)
{
    status rc = STATUS_OK;
    const double first_s = site_midnight_s(y->place) - DAY_S;
    const double end_s = nearest_time_s(y, 2, 29, 24.0), begin_s = end_s - DAY_S;
    const size_t count = series->count;

    if (y->has_leap_day || !isfinite(end_s) || end_s <= first_s || begin_s >= first_s + 2.0 * DAY_S)
        goto out;
    for (size_t i = 0; i < count; i++) {
        weather_sample sample = series->sample[i];
        if (sample.end_s <= begin_s - DAY_S + 1.0 || sample.end_s > begin_s + 1.0) continue;
        sample.end_s += DAY_S;
        TRY(weather_series_add(series, room, &sample));
    }
    if (series->count > count)
        status_warn("%s: has no 29 February: 28 February stands for it", series->path);
out:
    return rc;
}

static void sort(weather_series *series)
{
    if (series->count > 0) qsort(series->sample, series->count, sizeof *series->sample, by_time);
}

status weather_year_fit(const weather_year *y, weather_series *series, size_t *room)
{
    status rc = STATUS_OK;
    const int scene_year = year_at(y, site_midnight_s(y->place));

    sort(series);
    TRY(choose_year(y, series));
    TRY(check_twins(y, series));
    TRY(add_leap_day(y, series, room));
    sort(series);
    if (y->count == 1 && y->year[0] != scene_year)
        status_warn("%s: is the weather of %d, the scene's year is %d", series->path, y->year[0],
                    scene_year);
out:
    return rc;
}
