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

enum { LOCATION_FIELDS = 9, NEEDED_FIELDS = 22, HEADER_LINES = 20 };

static const column columns[WEATHER_SERIES_COUNT] = {
    [WEATHER_SERIES_AIR_K] = {"dry bulb temperature", "C", 6, -90, 70, false},
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

static status read_row(epw *e)
{
    static const int date_fields[] = {0, 1, 2, 3, -1};
    status rc = STATUS_OK;
    weather_sample sample = {0};
    weather_date d;

    TRY(csv_row_take(&e->row, e->file, ',', "an hour of weather"));
    if (e->row.count < NEEDED_FIELDS)
        TRY(record_file_reject(e->file, "an hour of %d fields or more with commas between",
                               NEEDED_FIELDS));
    TRY(weather_date_take(&d, &e->row, date_fields, e->file));
    for (int q = 0; q < WEATHER_SERIES_COUNT; q++)
        TRY(column_read(&sample.value[q], &e->place[q], csv_row_field(&e->row, e->place[q].field),
                        e->file, &e->gaps));
    sample.year = d.year;
    if (weather_year_take(&e->year, &d, &sample.end_s))
        TRY(weather_series_add(&e->series, &e->room, &sample));
out:
    return rc;
}

status weather_epw_read(weather **out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    epw e = {.series = {.path = path, .span_s = HOUR_S}};

    column_places(e.place, columns, WEATHER_SERIES_COUNT);
    TRY(record_file_open(&e.file, path));
    TRY(read_location(&e));
    TRY(read_periods(&e));
    e.year = weather_year_around(place, e.series.utc_offset_h);
    while (!record_file_at_end(e.file)) TRY(read_row(&e));
    TRY(weather_year_fit(&e.year, &e.series, &e.room));
    column_gaps_tell(&e.gaps, path);
    TRY(weather_series_history(out, &e.series, place));
out:
    weather_series_free(&e.series);
    csv_row_free(&e.row);
    record_file_free(e.file);
    return rc;
}
