#include "weather/weather_table.h"

#include "base/array.h"
#include "files/column.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "files/record_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { FIELD_SIZE = 64, LONGEST_TABLE = 1000000 };

enum {
    TIME,
    AIR,
    PRESSURE,
    WIND,
    HUMIDITY,
    DEW_POINT,
    DIRECT,
    DIFFUSE,
    GLOBAL,
    LONGWAVE_DOWN,
    LONGWAVE_UP,
    SURFACE,
    RAIN,
    TABLE_COLUMNS
};

/* Net radiometers read a little below 0 at night. No range has a flag in it that is not also a value. */
static const column columns[TABLE_COLUMNS] = {
    [TIME] = {"time", "h", -1, -1e6, 1e6, false},
    [AIR] = {"air_temperature", "C", -1, -95, 70, false},
    [PRESSURE] = {"pressure", "hPa", -1, 300, 1100, false},
    [WIND] = {"wind", "m/s", -1, 0, 100, false},
    [HUMIDITY] = {"relative_humidity", "%", -1, 0, 110, false},
    [DEW_POINT] = {"dew_point", "C", -1, -95, 70, false},
    [DIRECT] = {"direct", "W/m2", -1, -50, 1500, false},
    [DIFFUSE] = {"diffuse", "W/m2", -1, -50, 1500, false},
    [GLOBAL] = {"global", "W/m2", -1, -50, 1800, false},
    [LONGWAVE_DOWN] = {"longwave_down", "W/m2", -1, 1, 1000, false},
    [LONGWAVE_UP] = {"longwave_up", "W/m2", -1, 1, 2000, false},
    [SURFACE] = {"surface_temperature", "C", -1, -95, 127, false},
    [RAIN] = {"rain", "mm/h", -1, 0, 1000, false},
};

typedef struct row {
    int line;
    double value[TABLE_COLUMNS];
} row;

typedef struct reader {
    const char *path;
    record_file *file;
    csv_row fields;
    char separator;
    size_t names;
    column_place place[TABLE_COLUMNS]; /* by column */
    column_gaps gaps;
    size_t count;
    row *row; /* shape (count) */
    double interval_h;
} reader;

static int find_column(const char *name)
{
    for (int i = 0; i < TABLE_COLUMNS; i++)
        if (!strcasecmp(columns[i].name, name)) return i;
    return -1;
}

/* Takes `name [unit]`. */
static status add_field(reader *r, size_t field)
{
    status rc = STATUS_OK;
    const char *text = r->fields.field[field];
    char name[FIELD_SIZE], unit_text[FIELD_SIZE];

    if (!heading_split(text, FIELD_SIZE, name, unit_text) || !*unit_text)
        TRY(record_file_reject(r->file, "columns as name [unit], not '%.60s'", text));
    const int c = find_column(name);
    if (c < 0)
        TRY(record_file_reject(r->file, "known columns, not '%s': see docs/file-formats.md", name));
    if (r->place[c].column) TRY(record_file_reject(r->file, "one column '%s', not two", name));
    const unit *here = unit_find(unit_text, unit_find(columns[c].unit, NULL)->quantity);
    if (!here)
        TRY(record_file_reject(r->file, "another unit of %s, as [%s], not [%s]", name,
                               columns[c].unit, unit_text));
    r->place[c] = column_place_at(&columns[c], here, field);
out:
    return rc;
}

static bool has(const reader *r, int c)
{
    return r->place[c].column;
}

static status check_columns(const reader *r)
{
    status rc = STATUS_OK;
    const int needed[] = {TIME, AIR, PRESSURE, WIND};

    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        if (!has(r, needed[i]))
            TRY(record_file_reject(r->file, "a column '%s [%s]'", columns[needed[i]].name,
                                   columns[needed[i]].unit));
    if (!has(r, HUMIDITY) && !has(r, DEW_POINT))
        TRY(record_file_reject(r->file, "a column 'relative_humidity [%%]' or 'dew_point [C]'"));
    if (!has(r, GLOBAL) && !(has(r, DIRECT) && has(r, DIFFUSE)))
        TRY(record_file_reject(r->file,
                               "columns 'direct [W/m2]' and 'diffuse [W/m2]', or 'global [W/m2]'"));
out:
    return rc;
}

static status read_header(reader *r)
{
    status rc = STATUS_OK;
    static const char expected[] = "a header: time [h],air_temperature [C],...";

    TRY(csv_row_names(&r->fields, r->file, &r->separator, expected));
    r->names = r->fields.count;
    for (size_t i = 0; i < r->names; i++) TRY(add_field(r, i));
    TRY(check_columns(r));
out:
    return rc;
}

static status read_row(reader *r)
{
    status rc = STATUS_OK;
    row *now;

    if (r->count == LONGEST_TABLE)
        TRY(record_file_reject(r->file, "at most %d records", LONGEST_TABLE));
    NEED(array_add(&r->row, r->count, sizeof *r->row), STATUS_MEMORY,
         "no memory for %zu weather records", r->count + 1);
    now = &r->row[r->count];
    TRY(csv_row_take(&r->fields, r->file, r->separator, "a record"));
    TRY(csv_row_check(&r->fields, r->names, r->file));
    now->line = record_file_line(r->file);
    for (int c = 0; c < TABLE_COLUMNS; c++)
        TRY(column_read(&now->value[c], &r->place[c], csv_row_field(&r->fields, r->place[c].field),
                        r->file, &r->gaps));
    if (isnan(now->value[TIME])) TRY(record_file_reject(r->file, "a time"));
    if (r->count > 0 && !(now->value[TIME] > now[-1].value[TIME]))
        TRY(record_file_reject(r->file, "a time after %.4g h", now[-1].value[TIME]));
    r->count++;
out:
    return rc;
}

/* The mean of the steps that are no gaps: times may be rounded. */
static status find_interval(reader *r)
{
    status rc = STATUS_OK;
    double least_h = INFINITY, sum_h = 0.0, number = 0.0;

    for (size_t i = 1; i < r->count; i++)
        least_h = fmin(least_h, r->row[i].value[TIME] - r->row[i - 1].value[TIME]);
    for (size_t i = 1; i < r->count; i++) {
        const double step_h = r->row[i].value[TIME] - r->row[i - 1].value[TIME];
        if (step_h > 1.25 * least_h) continue;
        sum_h += step_h;
        number += 1.0;
    }
    const double steps = round(number / sum_h);
    NEED(steps >= 1.0 && steps <= 3600.0 && fabs(sum_h / number * steps - 1.0) <= 0.01,
         STATUS_FORMAT,
         "%s:%d: found times %.4g h apart, expected an interval that divides an hour", r->path,
         r->row[1].line, least_h);
    r->interval_h = 1.0 / steps;
out:
    return rc;
}

/* Where a row stands in the series of even steps. */
static status place_row(const reader *r, size_t i, size_t *out)
{
    status rc = STATUS_OK;
    const double hours = r->row[i].value[TIME] - r->row[0].value[TIME];
    const double at = round(hours / r->interval_h);

    NEED(fabs(hours - at * r->interval_h) <= fmin(0.0051, 0.3 * r->interval_h), STATUS_FORMAT,
         "%s:%d: found the time %.6g h, expected %.4g h, as its interval of %.4g h has it", r->path,
         r->row[i].line, r->row[i].value[TIME], r->row[0].value[TIME] + at * r->interval_h,
         r->interval_h);
    NEED(at < LONGEST_TABLE, STATUS_FORMAT, "%s:%d: expected at most %d records", r->path,
         r->row[i].line, LONGEST_TABLE);
    *out = (size_t)at;
out:
    return rc;
}

/* Gives absent rows their place, without values. */
static status even_out(reader *r)
{
    status rc = STATUS_OK;
    size_t last = 0, at;
    row *even = NULL;

    TRY(place_row(r, r->count - 1, &last));
    even = malloc((last + 1) * sizeof *even);
    NEED(even, STATUS_MEMORY, "no memory for %zu weather records", last + 1);
    for (size_t i = 0; i <= last; i++) {
        for (int c = 0; c < TABLE_COLUMNS; c++) even[i].value[c] = NAN;
        even[i].value[TIME] = r->row[0].value[TIME] + (double)i * r->interval_h;
    }
    for (size_t i = 0; i < r->count; i++) {
        TRY(place_row(r, i, &at));
        memcpy(&even[at].value[AIR], &r->row[i].value[AIR],
               (TABLE_COLUMNS - AIR) * sizeof *even[at].value);
    }
    free(r->row);
    r->row = even;
    even = NULL;
    r->count = last + 1;
out:
    free(even);
    return rc;
}

/* Fills rows `from` to before `to` between those that have a value; at an end, with the nearest. */
static void bridge(reader *r, int c, size_t from, size_t to)
{
    const double *before = from > 0 ? &r->row[from - 1].value[c] : &r->row[to].value[c];
    const double *after = to < r->count ? &r->row[to].value[c] : before;
    const double a = *before, b = *after;

    for (size_t i = from; i < to; i++)
        r->row[i].value[c] = a + (b - a) * (double)(i - from + 1) / (double)(to - from + 1);
}

/* What a record cannot be without. */
static bool is_needed(const reader *r, int c)
{
    return has(r, c) && c != LONGWAVE_DOWN && c != RAIN && c != TIME;
}

static status fill_gaps(reader *r, int c)
{
    status rc = STATUS_OK;
    const size_t most = (size_t)floor(1.0 / r->interval_h + 1e-6);

    for (size_t from = 0, to; from < r->count; from = to + 1) {
        for (; from < r->count && !isnan(r->row[from].value[c]); from++) continue;
        for (to = from; to < r->count && isnan(r->row[to].value[c]); to++) continue;
        if (from == to) break;
        if (to - from <= most && to - from < r->count)
            bridge(r, c, from, to);
        else
            NEED(!is_needed(r, c), STATUS_FORMAT,
                 "%s: no %s at %.4g h, until %.4g h: expected gaps of an hour at most", r->path,
                 columns[c].name, r->row[from].value[TIME], r->row[to - 1].value[TIME]);
    }
out:
    return rc;
}

/* Dew points that are missing follow from the relative humidity, unless that is in fractions. */
static status derive(reader *r)
{
    status rc = STATUS_OK;
    double most = NAN;

    for (size_t i = 0; i < r->count; i++) {
        double *v = r->row[i].value;
        if (!isnan(v[DEW_POINT]) || isnan(v[AIR]) || isnan(v[HUMIDITY])) continue;
        v[DEW_POINT] = weather_dew_point_k(v[AIR], fmin(1.0, v[HUMIDITY]));
        most = fmax(most, v[HUMIDITY]);
    }
    NEED(!(most <= WEATHER_DRIEST), STATUS_FORMAT,
         "%s: its relative humidity is at most %.3g %%: expected per cent, not fractions", r->path,
         100.0 * most);
out:
    return rc;
}

static double at_least_0(double value)
{
    return isnan(value) ? 0.0 : fmax(0.0, value);
}

static weather_record record_of(const double v[TABLE_COLUMNS])
{
    const double humidity = weather_saturation_pa(v[DEW_POINT]) / weather_saturation_pa(v[AIR]);
    const bool is_global = isnan(v[DIRECT]) || isnan(v[DIFFUSE]);

    return (weather_record){
        .time_h = v[TIME],
        .air_temperature_k = v[AIR],
        .pressure_pa = v[PRESSURE],
        .relative_humidity = fmin(1.0, humidity),
        .dew_point_k = v[DEW_POINT],
        .wind_m_s = v[WIND],
        .direct_w_m2 = is_global ? 0.0 : at_least_0(v[DIRECT]),
        .diffuse_w_m2 = at_least_0(v[is_global ? GLOBAL : DIFFUSE]),
        .sky_exposure = 1.0,
        .longwave_w_m2 = at_least_0(v[LONGWAVE_DOWN]),
        .precipitation_type = v[RAIN] > 0.0,
        .precipitation_m_s = at_least_0(v[RAIN]),
        .precipitation_temperature_k = v[AIR],
    };
}

static status allocate(weather_table *t, const reader *r, size_t count)
{
    status rc = STATUS_OK;

    TRY(weather_allocate(&t->history, count, 3600.0 * r->interval_h));
    t->is_global = calloc(count, sizeof *t->is_global);
    NEED(t->is_global, STATUS_MEMORY, "no memory for %zu weather records", count);
    t->surface_k = has(r, SURFACE) ? malloc(count * sizeof *t->surface_k) : NULL;
    t->longwave_up_w_m2 = has(r, LONGWAVE_UP) ? malloc(count * sizeof *t->longwave_up_w_m2) : NULL;
    NEED((t->surface_k || !has(r, SURFACE)) && (t->longwave_up_w_m2 || !has(r, LONGWAVE_UP)),
         STATUS_MEMORY, "no memory for %zu weather records", count);
out:
    return rc;
}

/* A single day, with or without the midnight that ends it, stands twice. */
static status make_records(weather_table *t, const reader *r)
{
    status rc = STATUS_OK;
    const size_t day = (size_t)lround(24.0 / r->interval_h);
    const size_t more = r->count == day || r->count == day + 1 ? day : 0;

    TRY(allocate(t, r, r->count + more));
    for (size_t i = 0; i < t->history->count; i++) {
        const double *v = r->row[i < more ? i : i - more].value;
        t->history->record[i] = record_of(v);
        t->history->record[i].time_h = r->row[0].value[TIME] + (double)i * r->interval_h;
        t->is_global[i] = isnan(v[DIRECT]) || isnan(v[DIFFUSE]);
        if (t->surface_k) t->surface_k[i] = v[SURFACE];
        if (t->longwave_up_w_m2) t->longwave_up_w_m2[i] = v[LONGWAVE_UP];
    }
out:
    return rc;
}

/* Light is complete if global is, or both others. */
static status fill_light(reader *r)
{
    status rc = STATUS_OK;
    bool is_whole = has(r, DIRECT) && has(r, DIFFUSE);

    for (size_t i = 0; i < r->count && has(r, GLOBAL); i++)
        is_whole = is_whole && !isnan(r->row[i].value[DIRECT]) && !isnan(r->row[i].value[DIFFUSE]);
    if (is_whole || !has(r, GLOBAL)) {
        TRY(fill_gaps(r, DIRECT));
        TRY(fill_gaps(r, DIFFUSE));
    } else {
        TRY(fill_gaps(r, GLOBAL));
    }
out:
    return rc;
}

static status read_rows(reader *r)
{
    status rc = STATUS_OK;
    static const int whole[] = {AIR, PRESSURE, WIND, DEW_POINT, LONGWAVE_DOWN, RAIN};

    while (!record_file_at_end(r->file)) TRY(read_row(r));
    if (r->count < 2) TRY(record_file_reject(r->file, "two records or more"));
    column_gaps_tell(&r->gaps, r->path);
    TRY(find_interval(r));
    TRY(even_out(r));
    TRY(derive(r));
    if (!has(r, DEW_POINT)) r->place[DEW_POINT] = column_place_at(&columns[DEW_POINT], NULL, 0);
    for (size_t k = 0; k < sizeof whole / sizeof *whole; k++) TRY(fill_gaps(r, whole[k]));
    TRY(fill_light(r));
out:
    return rc;
}

status weather_table_read(weather_table *out, const char *path)
{
    status rc = STATUS_OK;
    reader r = {.path = path};
    weather_table t = {0};

    TRY(record_file_open(&r.file, path));
    TRY(read_header(&r));
    TRY(read_rows(&r));
    TRY(make_records(&t, &r));
    *out = t;
    t = (weather_table){0};
out:
    weather_table_free(&t);
    csv_row_free(&r.fields);
    free(r.row);
    record_file_free(r.file);
    return rc;
}

void weather_table_free(weather_table *table)
{
    weather_free(table->history);
    free(table->surface_k);
    free(table->longwave_up_w_m2);
    free(table->is_global);
    *table = (weather_table){0};
}
