#include "station/measured_table.h"

#include "base/array.h"
#include "base/number.h"
#include "files/column.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "kernels/constants.h"
#include "station/date_text.h"
#include "station/weather_surfrad.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define HOUR_S 3600.0
#define DAY_S 86400.0

enum { NAME_SIZE = 256 };

static const column surface = {"surface temperature", "C", -1, -150, 1000, false};

typedef struct reader {
    record_file *file;
    csv_row row;
    char separator;
    size_t names;
    bool has_hours;      /* else dates */
    column_place *place; /* shape (names - 1) */
    column_gaps gaps;
    const site *site;
    measured_table table;
} reader;

static status take_column(reader *r, size_t field)
{
    status rc = STATUS_OK;
    char name[NAME_SIZE] = "", unit_text[NAME_SIZE] = "";
    const size_t i = field - 1;

    const bool is_whole = heading_split(r->row.field[field], NAME_SIZE, name, unit_text);
    const unit *here = is_whole ? unit_find(unit_text, "temperature") : NULL;
    if (!here)
        TRY(record_file_reject(r->file, "columns as name [C], not '%.60s'", r->row.field[field]));
    for (size_t k = 0; k < i; k++)
        if (!strcmp(r->table.name[k], name))
            TRY(record_file_reject(r->file, "one column '%s', not two", name));
    r->place[i] = column_place_at(&surface, here, field);
    r->table.name[i] = strdup(name);
    NEED(r->table.name[i], STATUS_MEMORY, "no memory for the names of a table");
out:
    return rc;
}

static status read_names(reader *r)
{
    static const char expected[] = "a line of names: time, then what was measured, as roof [C]";
    status rc = STATUS_OK;
    char name[NAME_SIZE], unit_text[NAME_SIZE];

    TRY(csv_row_names(&r->row, r->file, &r->separator, expected));
    r->names = r->row.count;
    if (r->names < 2) TRY(record_file_reject(r->file, "%s", expected));
    r->has_hours =
        heading_split(r->row.field[0], NAME_SIZE, name, unit_text) && unit_find(unit_text, "time");
    r->table.column_count = r->names - 1;
    r->table.name = calloc(r->names, sizeof *r->table.name);
    r->place = calloc(r->names, sizeof *r->place);
    NEED(r->table.name && r->place, STATUS_MEMORY, "no memory for the names of a table");
    for (size_t i = 1; i < r->names; i++) TRY(take_column(r, i));
out:
    return rc;
}

/* A date's midnight, UTC; the hours of its day are added. */
static double date_s(const weather_date *d, double offset_h)
{
    char iso[80];
    double time_s = NAN;
    int offset_min;

    snprintf(iso, sizeof iso, "%04d-%02d-%02dT00:00:00Z", d->year, d->month, d->day);
    if (site_parse_time(iso, &time_s, &offset_min) != STATUS_OK) return NAN;
    return time_s + HOUR_S * (d->hour - offset_h);
}

static status take_time(reader *r, double *out_s)
{
    status rc = STATUS_OK;
    const char *text = csv_row_field(&r->row, 0);
    weather_date date;
    double hour = NAN, offset_h = NAN;

    *out_s = NAN;
    if (r->has_hours && number_read(text, &hour)) *out_s = site_midnight_s(r->site) + HOUR_S * hour;
    if (!r->has_hours && date_text_read(text, &date, &offset_h))
        *out_s = date_s(&date, isnan(offset_h) ? r->site->utc_offset_min / 60.0 : offset_h);
    if (isnan(*out_s))
        TRY(record_file_reject(r->file, "%s, not '%.40s'",
                               r->has_hours ? "a time in h"
                                            : "a date and a time such as 2019-01-31T12:30-07:00",
                               text));
    if (r->table.count > 0 && *out_s <= r->table.time_s[r->table.count - 1])
        TRY(record_file_reject(r->file, "a time after the one before"));
out:
    return rc;
}

static status read_row(reader *r)
{
    status rc = STATUS_OK;
    measured_table *t = &r->table;
    double time_s;

    TRY(csv_row_take(&r->row, r->file, r->separator, "a row"));
    TRY(csv_row_check(&r->row, r->names, r->file));
    TRY(take_time(r, &time_s));
    NEED(array_add(&t->time_s, t->count, sizeof *t->time_s) &&
             array_add(&t->temperature_k, t->count, t->column_count * sizeof *t->temperature_k),
         STATUS_MEMORY, "no memory for %zu measured rows", t->count + 1);
    t->time_s[t->count] = time_s;
    for (size_t i = 0; i < t->column_count; i++)
        TRY(column_read(&t->temperature_k[t->count * t->column_count + i], &r->place[i],
                        csv_row_field(&r->row, i + 1), r->file, &r->gaps));
    t->count++;
out:
    return rc;
}

status measured_table_read(measured_table *out, const char *path, const site *place)
{
    status rc = STATUS_OK;
    reader r = {.site = place};

    TRY(record_file_open(&r.file, path));
    TRY(read_names(&r));
    while (!record_file_at_end(r.file)) TRY(read_row(&r));
    if (r.table.count == 0) TRY(record_file_reject(r.file, "rows behind the names"));
    column_gaps_tell(&r.gaps, path);
    *out = r.table;
    r.table = (measured_table){0};
out:
    measured_table_free(&r.table);
    free(r.place);
    csv_row_free(&r.row);
    record_file_free(r.file);
    return rc;
}

double measured_table_radiating_k(double up_w_m2, double down_w_m2, double emissivity)
{
    const double emitted_w_m2 = up_w_m2 - (1.0 - emissivity) * down_w_m2;

    return pow(fmax(0.0, emitted_w_m2) / (emissivity * (double)STEFAN_BOLTZMANN), 0.25);
}

/* Behind the last sample of the local day that has sample `first`. */
static size_t end_of_day(const weather_series *series, size_t first, const site *place)
{
    const double offset_s = 60.0 * place->utc_offset_min;
    const double day = floor((series->sample[first].end_s + offset_s) / DAY_S);
    size_t end = first;

    while (end < series->count && floor((series->sample[end].end_s + offset_s) / DAY_S) == day)
        end++;
    return end;
}

static void add_samples(measured_table *t, const weather_series *series, size_t first, size_t end,
                        double emissivity)
{
    for (size_t i = first; i < end; i++, t->count++) {
        const double up = series->sample[i].value[WEATHER_SERIES_LONGWAVE_UP_W_M2];
        const double down = series->sample[i].value[WEATHER_SERIES_LONGWAVE_W_M2];
        t->time_s[t->count] = series->sample[i].end_s;
        t->temperature_k[t->count] =
            isnan(up + down) ? (double)NAN : measured_table_radiating_k(up, down, emissivity);
    }
}

status measured_table_surfrad(measured_table *out, const char *path, const site *place,
                              const char *name, double emissivity)
{
    status rc = STATUS_OK;
    weather_series series = {0};
    measured_table t = {.column_count = 1};

    TRY(weather_surfrad_samples(&series, path, place));
    t.name = calloc(1, sizeof *t.name);
    t.time_s = malloc(series.count * sizeof *t.time_s);
    t.temperature_k = malloc(series.count * sizeof *t.temperature_k);
    NEED(t.name && t.time_s && t.temperature_k && (t.name[0] = strdup(name)), STATUS_MEMORY,
         "no memory for %zu measured rows", series.count);
    for (size_t first = 0, end; first < series.count; first = end) {
        end = end_of_day(&series, first, place);
        const double span_s = series.sample[end - 1].end_s - series.sample[first].end_s;
        if (span_s >= 0.5 * DAY_S) add_samples(&t, &series, first, end, emissivity);
    }
    if (t.count < series.count)
        status_warn(
            "%s: %zu samples are of local days of which less than half is there, and are left "
            "out of the comparison",
            path, series.count - t.count);
    *out = t;
    t = (measured_table){0};
out:
    measured_table_free(&t);
    weather_series_free(&series);
    return rc;
}

void measured_table_free(measured_table *table)
{
    for (size_t i = 0; table->name && i < table->column_count; i++) free(table->name[i]);
    free(table->name);
    free(table->time_s);
    free(table->temperature_k);
    *table = (measured_table){0};
}
