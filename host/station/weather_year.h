/* Weather year: rows of a file's years, typical ones among them, as the weather of a scene's days. */
#ifndef WEATHER_YEAR_H
#define WEATHER_YEAR_H

#include "files/csv_row.h"
#include "sky/site.h"
#include "station/weather_series.h"

#include <stdbool.h>

typedef struct weather_date {
    int year, month, day;
    double hour; /* from the day's midnight; up to 24 */
} weather_date;

enum { WEATHER_YEARS = 64 };

typedef struct weather_year {
    const site *place;
    double utc_offset_h; /* of the file's clock */
    double first_s,
        last_s;        /* what is kept: 15 days to both sides, by whose light the clock is judged */
    bool has_leap_day; /* a row of 29 February */
    int count;
    int year[WEATHER_YEARS]; /* shape (count): those of the rows, the first of them */
} weather_year;

weather_year weather_year_around(const site *place, double utc_offset_h);

/* The most days that a month has in any year. */
int weather_month_days(int month);

/* Takes a date from a row's fields.
 *   place   of year, month, day, hour, minute; of the last two below 0: 0
 * Fails with STATUS_FORMAT, at the row's line, where one is no whole number or out of its range. */
status weather_date_take(weather_date *out, const csv_row *row, const int place[5],
                         const record_file *file);

/* Takes note of a row's date, and sets its time in the year in which it is nearest to the scene's days, by
 * month and day. Returns whether it is kept. */
bool weather_year_take(weather_year *y, const weather_date *date, double *out_s);

/* Sorts the samples, of which each has the year that its row states, and makes them fit the scene's days:
 *   rows of several years for one time    those of the scene's year alone; refused with the list of
 *                                         the years where it is none of them
 *   two rows for one time that differ     refused
 *   29 February that the file lacks       28 February, with a warning
 * Warns where all rows are of one year that is not the scene's. */
status weather_year_fit(const weather_year *y, weather_series *series, size_t *room);

#endif
