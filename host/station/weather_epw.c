#include "station/weather_epw.h"

#include "base/number.h"
#include "files/column.h"
#include "files/csv_row.h"
#include "files/record_file.h"
#include "station/weather_series.h"
#include "station/weather_year.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define HOUR_S 3600.0
#define FAINT_W_M2 130.0 /* of a month's warmest sky: less is a sum of a part of an hour */

enum { LOCATION_FIELDS = 9, NEEDED_FIELDS = 22, HEADER_LINES = 20 };

static const column columns[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = {"dry bulb temperature", "C", 6, -90, 60, false},
    [WEATHER_SERIES_DEW_POINT_K] = {"dew point", "C", 7, -90, 70, false},
    [WEATHER_SERIES_HUMIDITY] = {"relative humidity", "%", 8, 0, 110, false},
    [WEATHER_SERIES_PRESSURE_PA] = {"pressure", "Pa", 9, 31000, 120000, false},
    [WEATHER_SERIES_LONGWAVE_W_M2] = {"infrared radiation", "Wh/m2", 12, 0, 900, true},
    [WEATHER_SERIES_GLOBAL_W_M2] = {"global radiation", "Wh/m2", 13, 0, 1800, false},
    [WEATHER_SERIES_DIRECT_W_M2] = {"direct radiation", "Wh/m2", 14, 0, 1500, false},
    [WEATHER_SERIES_DIFFUSE_W_M2] = {"diffuse radiation", "Wh/m2", 15, 0, 1500, false},
    [WEATHER_SERIES_WIND_M_S] = {"wind speed", "m/s", 21, 0, 100, false},
    [WEATHER_SERIES_COVER] = {"opaque sky cover", "tenths", 23, 0, 10, false},
    [WEATHER_SERIES_RAIN_M_S] = {"precipitation", "mm", 33, 0, 500, false},
};

typedef struct epw {
    weather_series series;
    size_t room;
    record_file *file;
    int an_hour;    /* records */
    bool has_parts; /* of hours */
    csv_row row;
    column_place place[WEATHER_SERIES_COUNT];
    column_gaps gaps;
    weather_year year;
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
    static const char expected[] = "DATA PERIODS,1,1,... : records an hour that divide 60";
    double an_hour = 0.0;
    int line = 0;

    do TRY(csv_row_take(&e->row, e->file, ',', expected));
    while (++line < HEADER_LINES && strcmp(csv_row_field(&e->row, 0), "DATA PERIODS"));
    if (strcmp(csv_row_field(&e->row, 0), "DATA PERIODS") ||
        !number_read(csv_row_field(&e->row, 2), &an_hour) || !(an_hour >= 1.0 && an_hour <= 60.0) ||
        fmod(60.0, an_hour) != 0.0)
        TRY(record_file_reject(e->file, "%s", expected));
    e->an_hour = (int)an_hour;
    e->series.span_s = HOUR_S / an_hour;
out:
    return rc;
}

/* The end of a row's span: of an hour, whose minute says nothing, or a part of it that ends at that minute. */
static status read_date(epw *e, weather_date *out)
{
    const bool has_parts = e->an_hour > 1;
    const int step_min = 60 / e->an_hour, date_fields[] = {0, 1, 2, 3, has_parts ? 4 : -1};
    status rc = STATUS_OK;

    TRY(weather_date_take(out, &e->row, date_fields, e->file));
    if (has_parts) {
        double minute = 0.0; /* a whole number, as weather_date_take found */
        number_read(csv_row_field(&e->row, 4), &minute);
        if (out->hour < 1.0 || minute < step_min || fmod(minute, step_min) != 0.0)
            TRY(record_file_reject(e->file,
                                   "hours 1 to 24, and minutes %d to 60 by %d at which records end",
                                   step_min, step_min));
        out->hour -= 1.0;
        e->has_parts |= minute < 60.0;
    }
out:
    return rc;
}

static status read_row(epw *e)
{
    status rc = STATUS_OK;
    weather_sample sample = {0};
    weather_date d;

    TRY(csv_row_take(&e->row, e->file, ',', "an hour of weather"));
    if (e->row.count < NEEDED_FIELDS)
        TRY(record_file_reject(e->file, "an hour of %d fields or more with commas between",
                               NEEDED_FIELDS));
    TRY(read_date(e, &d));
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
        TRY(column_read(&sample.value[q], &e->place[q], csv_row_field(&e->row, e->place[q].field),
                        e->file, &e->gaps));
    sample.year = d.year;
    if (weather_year_take(&e->year, &d, &sample.end_s))
        TRY(weather_series_add(&e->series, &e->room, &sample));
out:
    return rc;
}

/* Of parts of hours light and infrared are taken as EnergyPlus takes them: W/m2. */
static status check_parts(const epw *e)
{
    status rc = STATUS_OK;
    const char *path = e->series.path;
    double most = NAN;

    if (e->an_hour == 1) return STATUS_OK;
    NEED(e->has_parts, STATUS_FORMAT, "%s: states %d records an hour, and has one", path,
         e->an_hour);
    for (size_t i = 0; i < e->series.count; i++)
        most = fmax(most, e->series.sample[i].value[WEATHER_SERIES_LONGWAVE_W_M2]);
    NEED(!(most < FAINT_W_M2), STATUS_FORMAT,
         "%s: its infrared radiation is at most %g: expected means in W/m2 of several records an "
         "hour, as EnergyPlus takes them, not sums in Wh/m2",
         path, most);
out:
    return rc;
}

status weather_epw_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    epw e = {.series = {.path = path}};

    column_places(e.place, columns, WEATHER_SERIES_COUNT);
    TRY(record_file_open(&e.file, path));
    TRY(read_location(&e));
    TRY(read_periods(&e));
    e.year = weather_year_around(place, e.series.utc_offset_h);
    while (!record_file_at_end(e.file)) TRY(read_row(&e));
    TRY(check_parts(&e));
    TRY(weather_year_fit(&e.year, &e.series, &e.room));
    column_gaps_tell(&e.gaps, path);
    TRY(weather_series_history(out, &e.series, place));
out:
    weather_series_free(&e.series);
    csv_row_free(&e.row);
    record_file_free(e.file);
    return rc;
}
