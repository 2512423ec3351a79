#include "sky/site.h"

#include "files/record_file.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>

enum { DAY_S = 86400, HOUR_S = 3600, MINUTE_S = 60 };

static bool is_leap(int year)
{
    return (year % 4 == 0 && year % 100 != 0) || year % 400 == 0;
}

static int days_in_month(int year, int month)
{
    static const int days[] = {31, 28, 31, 30, 31, 30, 31, 31, 30, 31, 30, 31};

    return days[month - 1] + (month == 2 && is_leap(year));
}

/* Days from 1970-01-01; years are counted from March so that leap days come last. */
static long days_from_date(int year, int month, int day)
{
    const long y = month > 2 ? year : year - 1;
    const long era = (y >= 0 ? y : y - 399) / 400, year_of_era = y - era * 400;
    const long day_of_year = (153 * (month > 2 ? month - 3 : month + 9) + 2) / 5 + day - 1;

    return era * 146097 + year_of_era * 365 + year_of_era / 4 - year_of_era / 100 + day_of_year -
           719468;
}

static void date_from_days(long days, int *year, int *month, int *day)
{
    *year = (int)(1970 + floor((double)days / 365.2425));
    while (days_from_date(*year, 1, 1) > days) --*year;
    while (days_from_date(*year + 1, 1, 1) <= days) ++*year;
    *month = 12;
    while (days_from_date(*year, *month, 1) > days) --*month;
    *day = (int)(days - days_from_date(*year, *month, 1)) + 1;
}

/* Takes exactly `count` digits whose value lies from low to high. */
static bool take_digits(const char **text, int count, int low, int high, int *out)
{
    *out = 0;
    for (int i = 0; i < count; i++, ++*text) {
        if (!isdigit((unsigned char)**text)) return false;
        *out = *out * 10 + (**text - '0');
    }
    return *out >= low && *out <= high;
}

static bool take(const char **text, const char *any_of)
{
    for (; *any_of; any_of++)
        if (**text == *any_of) return ++*text;
    return false;
}

static bool take_date(const char **text, long *days)
{
    int year, month, day;

    if (!take_digits(text, 4, 1600, 9999, &year) || !take(text, "-")) return false;
    if (!take_digits(text, 2, 1, 12, &month) || !take(text, "-")) return false;
    if (!take_digits(text, 2, 1, days_in_month(year, month), &day)) return false;
    *days = days_from_date(year, month, day);
    return true;
}

static bool take_clock(const char **text, double *seconds)
{
    int hour, minute, second = 0;
    double fraction = 0.0;

    if (!take_digits(text, 2, 0, 23, &hour) || !take(text, ":")) return false;
    if (!take_digits(text, 2, 0, 59, &minute)) return false;
    if (take(text, ":")) {
        if (!take_digits(text, 2, 0, 59, &second)) return false;
        if (take(text, ".,")) {
            if (!isdigit((unsigned char)**text)) return false;
            for (double weight = 0.1; isdigit((unsigned char)**text); ++*text, weight *= 0.1)
                fraction += weight * (**text - '0');
        }
    }
    *seconds = hour * HOUR_S + minute * MINUTE_S + second + fraction;
    return true;
}

static bool take_offset(const char **text, int *minutes)
{
    int hour, minute;
    const bool west = **text == '-';

    *minutes = 0;
    if (take(text, "Zz")) return true;
    if (!take(text, "+-") || !take_digits(text, 2, 0, 14, &hour)) return false;
    take(text, ":");
    if (!take_digits(text, 2, 0, 59, &minute)) return false;
    *minutes = (west ? -1 : 1) * (hour * 60 + minute);
    return true;
}

status site_parse_time(const char *iso, double *time_s, int *utc_offset_min)
{
    status rc = STATUS_OK;
    const char *text = iso;
    long days;
    double seconds;

    NEED(take_date(&text, &days) && take(&text, "Tt ") && take_clock(&text, &seconds) &&
             take_offset(&text, utc_offset_min) && *text == '\0',
         STATUS_ARGUMENT,
         "time: found '%.60s', expected one from 1600 to 9999 such as 1987-06-24T10:00:00-05:00",
         iso);
    *time_s = (double)days * DAY_S + seconds - *utc_offset_min * MINUTE_S;
out:
    return rc;
}

double site_midnight_s(const site *place)
{
    const double offset_s = 60.0 * place->utc_offset_min;

    return 86400.0 * floor((place->time_s + offset_s) / 86400.0) - offset_s;
}

void site_format_time(double time_s, int utc_offset_min, char out[SITE_TIME_SIZE])
{
    const long long total_ms = llround((time_s + utc_offset_min * MINUTE_S) * 1000.0);
    const long long day_ms = DAY_S * 1000LL;
    const long days = (long)((total_ms - ((total_ms % day_ms) + day_ms) % day_ms) / day_ms);
    const int ms = (int)(total_ms - days * day_ms), seconds = ms / 1000;
    const int away = utc_offset_min < 0 ? -utc_offset_min : utc_offset_min;
    int year, month, day, length;

    date_from_days(days, &year, &month, &day);
    length = snprintf(out, SITE_TIME_SIZE, "%04d-%02d-%02dT%02d:%02d:%02d", year, month, day,
                      seconds / HOUR_S, seconds / MINUTE_S % 60, seconds % 60);
    if (ms % 1000)
        length += snprintf(out + length, (size_t)(SITE_TIME_SIZE - length), ".%03d", ms % 1000);
    if (away)
        snprintf(out + length, (size_t)(SITE_TIME_SIZE - length), "%c%02d:%02d",
                 utc_offset_min < 0 ? '-' : '+', away / 60, away % 60);
    else
        snprintf(out + length, (size_t)(SITE_TIME_SIZE - length), "Z");
}

/* Takes minimum, maximum and increment; the increment divides the range. */
static status read_range(record_file *file, double limit, const char *name, double *low,
                         double *high, double *step)
{
    status rc = STATUS_OK;
    char expected[80];

    snprintf(expected, sizeof expected, "the minimum %s", name);
    TRY(record_file_number(file, 0.0, limit, low, expected));
    snprintf(expected, sizeof expected, "the maximum %s", name);
    TRY(record_file_number(file, *low, limit, high, expected));
    snprintf(expected, sizeof expected, "the increment of the %s", name);
    TRY(record_file_number(file, 1e-6, limit, step, expected));
    const double steps = (*high - *low) / *step;
    if (fabs(steps - round(steps)) > 1e-6)
        rc = record_file_reject(file, "%s, dividing %g to %g", expected, *low, *high);
out:
    return rc;
}

static status read_date(record_file *file, double *time_s)
{
    status rc = STATUS_OK;
    long month, day, year;
    int day_line;

    TRY(record_file_count(file, 1, 12, &month, "the month"));
    TRY(record_file_count(file, 1, 31, &day, "the day of the month"));
    day_line = record_file_line(file);
    TRY(record_file_count(file, 0, 2100, &year, "the year, as 87 or 1987,"));
    if (year < 100) year += 1900;
    if (year < 1900)
        rc = record_file_reject(file, "the year, two digits or four");
    else if (day > days_in_month((int)year, (int)month))
        rc = record_file_reject(file, "a year whose month %ld has the day %ld of line %d", month,
                                day, day_line);
    *time_s = (double)days_from_date((int)year, (int)month, (int)day) * DAY_S;
out:
    return rc;
}

status site_read_node(site_node *out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    site_node node = {0};
    double altitude_km, hour, longitude_west_deg;

    TRY(record_file_open(&file, path));
    TRY(record_file_number(file, 0.0, 1000.0, &altitude_km, "the sensor altitude in km"));
    TRY(read_range(file, 90.0, "zenith angle in degrees", &node.path_zenith_min_deg,
                   &node.path_zenith_max_deg, &node.path_zenith_step_deg));
    TRY(read_range(file, 50000.0, "wavenumber in cm-1", &node.wavenumber_min_cm1,
                   &node.wavenumber_max_cm1, &node.wavenumber_step_cm1));
    TRY(read_date(file, &node.where.time_s));
    TRY(record_file_number(file, 0.0, 24.0, &hour, "the hour in GMT"));
    TRY(record_file_number(file, -90.0, 90.0, &node.where.latitude_deg, "the latitude in degrees"));
    TRY(record_file_number(file, -180.0, 360.0, &longitude_west_deg,
                           "the west-positive longitude in degrees"));
    TRY(record_file_finish(file));
    node.sensor_altitude_m = altitude_km * 1000.0;
    node.where.time_s += hour * HOUR_S;
    node.where.longitude_deg = -remainder(longitude_west_deg, 360.0);
    *out = node;
out:
    record_file_free(file);
    return rc;
}
