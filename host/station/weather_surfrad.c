#include "station/weather_surfrad.h"

#include "base/number.h"
#include "files/column.h"
#include "files/record_file.h"
#include "station/nearest_place.h"
#include "station/weather_series.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <time.h>

enum { NUMBERS = 48, SOLRAD_NUMBERS = 22, MADISON_NUMBERS = 31, BAD = 1 };

/* The flag of a value stands behind it. */
static const column columns[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_GLOBAL_W_M2] = {"global irradiance", "W/m2", 8, -50, 1800, false},
    [WEATHER_SERIES_DIRECT_W_M2] = {"direct sun", "W/m2", 12, -50, 1500, false},
    [WEATHER_SERIES_DIFFUSE_W_M2] = {"diffuse light", "W/m2", 14, -50, 1500, false},
    [WEATHER_SERIES_LONGWAVE_W_M2] = {"longwave", "W/m2", 16, 10, 1000, false},
    [WEATHER_SERIES_LONGWAVE_UP_W_M2] = {"longwave from the ground", "W/m2", 22, 10, 1500, false},
    [WEATHER_SERIES_AIR_K] = {"air temperature", "C", 38, -90, 60, false},
    [WEATHER_SERIES_HUMIDITY] = {"relative humidity", "%", 40, 0, 110, false},
    [WEATHER_SERIES_WIND_M_S] = {"wind speed", "m/s", 42, 0, 100, false},
    [WEATHER_SERIES_PRESSURE_PA] = {"pressure", "mbar", 46, 300, 1100, false},
};

typedef struct surfrad {
    weather_series series;
    size_t room;
    record_file *file;
    column_place place[WEATHER_SERIES_COUNT];
    column_gaps gaps;
    nearest_place nearest;
    bool has_row; /* of any station */
    bool is_kept; /* the rows behind the last heading */
} surfrad;

/* A station's name, then latitude, longitude, elevation. */
static status read_heading(surfrad *s)
{
    status rc = STATUS_OK;
    static const char expected[] = "latitude, longitude and elevation of the station";
    double where[3]; /* latitude, longitude, elevation */
    char name[sizeof s->series.name];
    const char *text;

    TRY(record_file_text(s->file, &text, "a station's name"));
    snprintf(name, sizeof name, "%s", text);
    TRY(record_file_text(s->file, &text, expected));
    const char *end = text;
    for (int i = 0; end && i < 3; i++) end = number_take(end + strspn(end, " \t"), &where[i]);
    if (!end || (*end && !isspace((unsigned char)*end)) || fabs(where[0]) > 90.0 ||
        fabs(where[1]) > 180.0)
        TRY(record_file_reject(s->file, "%s", expected));
    /* All stations are in America. */
    s->is_kept = nearest_place_take(&s->nearest, &s->series, where[0], -fabs(where[1]));
    if (!s->is_kept) goto out;
    s->series.elevation_m = where[2];
    memcpy(s->series.name, name, sizeof name);
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

static void take_values(surfrad *s, const double number[NUMBERS], weather_sample *out)
{
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++) {
        const column_place *p = &s->place[q];
        out->value[q] = NAN;
        if (!p->column || number[p->field + 1] == BAD) continue;
        out->value[q] = column_value(p, number[p->field], s->file, &s->gaps);
    }
}

static status read_row(surfrad *s)
{
    status rc = STATUS_OK;
    double number[NUMBERS];
    weather_sample sample = {0};
    const char *text;

    TRY(record_file_text(s->file, &text, "a row of a day"));
    const int found = record_numbers(text, NUMBERS, number);
    NEED(s->has_row || (found != SOLRAD_NUMBERS && found != MADISON_NUMBERS), STATUS_FORMAT,
         "%s: is a day of SOLRAD, which measures light alone: expected air temperature, humidity "
         "and wind too, as days of SURFRAD have them",
         s->series.path);
    if (found != NUMBERS)
        TRY(record_file_reject(s->file, "48 numbers: a time, then values and flags"));
    s->has_row = true;
    if (!s->is_kept) return STATUS_OK;
    TRY(take_time(s, number, &sample.end_s));
    take_values(s, number, &sample);
    TRY(weather_series_add(&s->series, &s->room, &sample));
out:
    return rc;
}

/* The shortest step between two samples. */
static double least_step_s(const weather_series *series)
{
    double least_s = INFINITY;

    for (size_t i = 1; i < series->count; i++)
        least_s = fmin(least_s, series->sample[i].end_s - series->sample[i - 1].end_s);
    return least_s;
}

/* A row begins with its year, a heading with the station's name. */
static bool is_row(record_file *file)
{
    const char *next = record_file_peek(file);

    return next && isdigit((unsigned char)next[strspn(next, " \t\r\n")]);
}

status weather_surfrad_samples(weather_series *out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    surfrad s = {.series = {.path = path, .utc_offset_h = NAN}, .nearest = nearest_place_of(place)};

    column_places(s.place, columns, WEATHER_SERIES_COUNT);
    TRY(record_file_open(&s.file, path));
    do {
        TRY(read_heading(&s));
        do TRY(read_row(&s));
        while (is_row(s.file));
    } while (!record_file_at_end(s.file));
    NEED(s.series.count > 1, STATUS_FORMAT, "%s: holds one sample, expected a day", path);
    s.series.span_s = least_step_s(&s.series);
    NEED(s.series.span_s <= 900.0, STATUS_FORMAT,
         "%s: samples are %g minutes apart, expected 15 at most", path, s.series.span_s / 60.0);
    column_gaps_tell(&s.gaps, path);
    nearest_place_tell(&s.nearest, &s.series);
    *out = s.series;
    s.series = (weather_series){0};
out:
    weather_series_free(&s.series);
    record_file_free(s.file);
    return rc;
}

status weather_surfrad_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    weather_series series = {0};

    TRY(weather_surfrad_samples(&series, path, place));
    TRY(weather_series_history(out, &series, place));
out:
    weather_series_free(&series);
    return rc;
}
