#include "weather/weather.h"

#include "files/file_name.h"
#include "files/output_file.h"
#include "files/record_file.h"
#include "kernels/constants.h"
#include "weather/weather_table.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define KELVIN ((double)ZERO_CELSIUS_K)
#define PASCAL_PER_MBAR 100.0
#define LANGLEY_PER_HOUR ((double)LANGLEY_PER_HOUR_W_M2)
#define CM_PER_HOUR (0.01 / 3600.0) /* m/s */
#define NO_DEW_POINT (-1.0)

enum { COLUMNS = 13, LONGEST = 1000000 };

/* Columns of a .wth record in the file's units. */
enum {
    TIME,
    AIR_TEMPERATURE,
    PRESSURE,
    HUMIDITY,
    DEW_POINT,
    WIND,
    DIRECT,
    DIFFUSE,
    EXPOSURE,
    CLOUD,
    RAIN_TYPE,
    RAIN_RATE,
    RAIN_TEMPERATURE
};

static const struct {
    const char *name;
    double low, high;
    int is_code;
} columns[COLUMNS] = {
    [TIME] = {"a time in h", -1e6, 1e6, 0},
    [AIR_TEMPERATURE] = {"an air temperature in C", -100.0, 70.0, 0},
    [PRESSURE] = {"a pressure in mbar", 300.0, 1100.0, 0},
    [HUMIDITY] = {"a relative humidity", 0.0, 1.0, 0},
    [DEW_POINT] = {"a dew point in C", -120.0, 70.0, 0},
    [WIND] = {"a wind speed in m/s", 0.0, 100.0, 0},
    [DIRECT] = {"direct insolation in ly/h", 0.0, 150.0, 0},
    [DIFFUSE] = {"diffuse insolation in ly/h", 0.0, 150.0, 0},
    [EXPOSURE] = {"a sky exposure", 0.0, 1.0, 0},
    [CLOUD] = {"a cloud type", 0.0, WEATHER_CLOUD_TYPES - 1, 1},
    [RAIN_TYPE] = {"a precipitation type", 0.0, 9.0, 1},
    [RAIN_RATE] = {"a precipitation rate in cm/h", 0.0, 100.0, 0},
    [RAIN_TEMPERATURE] = {"a precipitation temperature in C", -100.0, 70.0, 0},
};

double weather_saturation_pa(double temperature_k)
{
    const double celsius = temperature_k - KELVIN;

    return 611.2 * exp(17.62 * celsius / (243.12 + celsius));
}

double weather_dew_point_k(double air_temperature_k, double relative_humidity)
{
    const double celsius = air_temperature_k - KELVIN;
    const double exponent =
        log(fmax(relative_humidity, 1e-4)) + 17.62 * celsius / (243.12 + celsius);

    return KELVIN + 243.12 * exponent / (17.62 - exponent);
}

double weather_specific_humidity(const weather_record *r)
{
    const double vapour_pa = weather_saturation_pa(r->dew_point_k);

    return 0.622 * vapour_pa / (r->pressure_pa - 0.378 * vapour_pa);
}

double weather_day_start_h(const weather *w)
{
    const double end_h = w->record[w->count - 1].time_h + w->interval_s / 3600.0;

    return fmax(0.0, 24.0 * (floor(end_h / 24.0 + 1e-9) - 1.0));
}

double weather_origin_s(const weather *w, const site *place)
{
    return site_midnight_s(place) - 3600.0 * weather_day_start_h(w);
}

status weather_allocate(weather **out, size_t count, double interval_s)
{
    status rc = STATUS_OK;
    weather *w = calloc(1, sizeof *w);

    NEED(w, STATUS_MEMORY, "no memory for the weather");
    w->count = count;
    w->interval_s = interval_s;
    w->record = calloc(count, sizeof *w->record);
    NEED(w->record, STATUS_MEMORY, "no memory for %zu weather records", count);
    *out = w;
    w = NULL;
out:
    weather_free(w);
    return rc;
}

void weather_free(weather *w)
{
    if (!w) return;
    free(w->record);
    free(w);
}

/* Flags of missing values that lie in the ranges of temperatures. */
static bool is_flag(double celsius)
{
    return celsius == -99.0 || celsius == -99.9 || celsius == -99.99;
}

static status check_ranges(const record_file *file, const double value[COLUMNS])
{
    for (int i = 0; i < COLUMNS; i++) {
        if (value[i] < columns[i].low || value[i] > columns[i].high)
            return record_file_reject(file, "%s from %g to %g in column %d, not %g",
                                      columns[i].name, columns[i].low, columns[i].high, i + 1,
                                      value[i]);
        if ((i == AIR_TEMPERATURE || i == DEW_POINT) && is_flag(value[i]))
            return record_file_reject(file, "%s in column %d, not %g, a flag of missing values",
                                      columns[i].name, i + 1, value[i]);
        if (columns[i].is_code && value[i] != floor(value[i]))
            return record_file_reject(file, "%s in column %d, a whole number, not %g",
                                      columns[i].name, i + 1, value[i]);
    }
    return STATUS_OK;
}

static weather_record record_from_columns(const double value[COLUMNS])
{
    const double air_k = value[AIR_TEMPERATURE] + KELVIN;

    return (weather_record){
        .air_temperature_k = air_k,
        .pressure_pa = value[PRESSURE] * PASCAL_PER_MBAR,
        .relative_humidity = value[HUMIDITY],
        .dew_point_k = value[DEW_POINT] == NO_DEW_POINT
                           ? weather_dew_point_k(air_k, value[HUMIDITY])
                           : value[DEW_POINT] + KELVIN,
        .wind_m_s = value[WIND],
        .direct_w_m2 = value[DIRECT] * LANGLEY_PER_HOUR,
        .diffuse_w_m2 = value[DIFFUSE] * LANGLEY_PER_HOUR,
        .sky_exposure = value[EXPOSURE],
        .cloud_type = (int)value[CLOUD],
        .precipitation_type = (int)value[RAIN_TYPE],
        /* assumed: cm per hour; the thesis does not tell the unit. */
        .precipitation_m_s = value[RAIN_RATE] * CM_PER_HOUR,
        .precipitation_temperature_k = value[RAIN_TEMPERATURE] + KELVIN,
    };
}

/* Times are printed with two decimals, so each may be off by half a hundredth of an hour. */
static status read_steps(weather *w, record_file *file)
{
    status rc = STATUS_OK;
    const double interval_h = w->interval_s / 3600.0;
    const double tolerance_h = fmin(0.0051, 0.3 * interval_h);
    double value[COLUMNS], first_h = 0.0;

    for (size_t i = 0; i < w->count; i++) {
        char expected[96];
        snprintf(expected, sizeof expected, "record %zu of %zu: %d numbers", i + 1, w->count,
                 COLUMNS);
        TRY(record_file_numbers(file, COLUMNS, value, expected));
        TRY(check_ranges(file, value));
        if (i == 0) first_h = value[TIME];
        const double time_h = first_h + (double)i * interval_h;
        if (fabs(value[TIME] - time_h) > tolerance_h)
            TRY(record_file_reject(file, "the time %.4g h, one interval after the last", time_h));
        w->record[i] = record_from_columns(value);
        w->record[i].time_h = time_h;
    }
    TRY(record_file_finish(file));
out:
    return rc;
}

static status read_heading(record_file *file, size_t *out_count, double *out_interval_s)
{
    status rc = STATUS_OK;
    double value[2], steps;

    TRY(record_file_numbers(file, 2, value, "the number of records and their interval in h"));
    if (value[0] != floor(value[0]) || value[0] < 2.0 || value[0] > LONGEST)
        TRY(record_file_reject(file, "a number of records from 2 to %d", LONGEST));
    if (value[1] < 1.0 / 3600.0 || value[1] > 1.0)
        TRY(record_file_reject(file, "an interval from a second to an hour, in h"));
    steps = round(1.0 / value[1]);
    if (fabs(value[1] * steps - 1.0) > 1e-3)
        TRY(record_file_reject(file, "an interval in h that divides an hour"));
    *out_count = (size_t)value[0];
    *out_interval_s = 3600.0 / steps;
out:
    return rc;
}

static status read_table(weather **out, const char *path)
{
    status rc = STATUS_OK;
    weather_table table = {0};

    TRY(weather_table_read(&table, path));
    *out = table.history;
    table.history = NULL;
out:
    weather_table_free(&table);
    return rc;
}

status weather_read(weather **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    weather *w = NULL;
    size_t count;
    double interval_s;

    if (file_name_ends(path, ".csv")) return read_table(out, path);
    TRY(record_file_open(&file, path));
    TRY(read_heading(file, &count, &interval_s));
    TRY(weather_allocate(&w, count, interval_s));
    TRY(read_steps(w, file));
    *out = w;
    w = NULL;
out:
    record_file_free(file);
    weather_free(w);
    return rc;
}

static void write_record(FILE *stream, const weather_record *r)
{
    const double dew_point_c = r->dew_point_k - KELVIN;

    fprintf(stream, "%.4f %.3f %.2f %.4f ", r->time_h, r->air_temperature_k - KELVIN,
            r->pressure_pa / PASCAL_PER_MBAR, r->relative_humidity);
    /* A dew point that would be printed as -1 would be read as one to be computed. */
    fprintf(stream, "%.3f ", fabs(dew_point_c - NO_DEW_POINT) < 6e-4 ? -1.001 : dew_point_c);
    fprintf(stream, "%.3f %.4f %.4f %.3f %d %d %.5f %.3f\n", r->wind_m_s,
            r->direct_w_m2 / LANGLEY_PER_HOUR, r->diffuse_w_m2 / LANGLEY_PER_HOUR, r->sky_exposure,
            r->cloud_type, r->precipitation_type, r->precipitation_m_s / CM_PER_HOUR,
            r->precipitation_temperature_k - KELVIN);
}

status weather_write(const weather *w, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    fprintf(output_file_stream(file), "%zu %.8g\n", w->count, w->interval_s / 3600.0);
    for (size_t i = 0; i < w->count; i++) write_record(output_file_stream(file), &w->record[i]);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}
