#include "weather/weather_table.h"

#include "files/record_file.h"
#include "kernels/constants.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { TABLE_COLUMNS = 13, FIELD_SIZE = 64, LONGEST_TABLE = 1000000, UNITS = 4 };

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
    RAIN
};

typedef struct table_unit {
    const char *name;
    double scale, offset; /* SI = scale x value + offset */
} table_unit;

#define KELVIN ((double)ZERO_CELSIUS_K)
#define CELSIUS_OR_KELVIN                                                                          \
    {                                                                                              \
        {"C", 1.0, KELVIN},                                                                        \
        {                                                                                          \
            "K", 1.0, 0.0                                                                          \
        }                                                                                          \
    }
#define FLUX                                                                                       \
    {                                                                                              \
        {                                                                                          \
            "W/m2", 1.0, 0.0                                                                       \
        }                                                                                          \
    }

/* Ranges in SI; net radiometers read a little below 0 at night. */
static const struct {
    const char *name;
    double low, high;
    table_unit unit[UNITS];
} columns[TABLE_COLUMNS] = {
    [TIME] = {"time", -1e6, 1e6, {{"h", 1.0, 0.0}}},
    [AIR] = {"air_temperature", 173.0, 343.0, CELSIUS_OR_KELVIN},
    [PRESSURE] = {"pressure",
                  3e4,
                  1.1e5,
                  {{"Pa", 1.0, 0.0}, {"hPa", 100.0, 0.0}, {"mbar", 100.0, 0.0}, {"kPa", 1e3, 0.0}}},
    [WIND] = {"wind", 0.0, 100.0, {{"m/s", 1.0, 0.0}}},
    [HUMIDITY] = {"relative_humidity", 0.0, 1.1, {{"%", 0.01, 0.0}, {"1", 1.0, 0.0}}},
    [DEW_POINT] = {"dew_point", 153.0, 343.0, CELSIUS_OR_KELVIN},
    [DIRECT] = {"direct", -50.0, 1500.0, FLUX},
    [DIFFUSE] = {"diffuse", -50.0, 1500.0, FLUX},
    [GLOBAL] = {"global", -50.0, 1800.0, FLUX},
    [LONGWAVE_DOWN] = {"longwave_down", 1.0, 1000.0, FLUX},
    [LONGWAVE_UP] = {"longwave_up", 1.0, 2000.0, FLUX},
    [SURFACE] = {"surface_temperature", 150.0, 400.0, CELSIUS_OR_KELVIN},
    [RAIN] = {"rain", 0.0, 1000.0, {{"mm/h", 1e-3 / 3600.0, 0.0}}},
};

/* Where the columns stand in the file. */
typedef struct layout {
    size_t count;
    int column[TABLE_COLUMNS];
    const table_unit *unit[TABLE_COLUMNS]; /* by column; NULL: absent */
} layout;

static int find_column(const char *name)
{
    for (int i = 0; i < TABLE_COLUMNS; i++)
        if (!strcmp(columns[i].name, name)) return i;
    return -1;
}

static const table_unit *find_unit(int column, const char *name)
{
    for (int i = 0; i < UNITS && columns[column].unit[i].name; i++)
        if (!strcmp(columns[column].unit[i].name, name)) return &columns[column].unit[i];
    return NULL;
}

/* Takes `name [unit]`. */
static status add_field(layout *l, const record_file *file, const char *field)
{
    status rc = STATUS_OK;
    char name[FIELD_SIZE], unit[FIELD_SIZE];
    int end = 0;

    if (sscanf(field, " %63[a-z_] [%63[^]]] %n", name, unit, &end) < 2 || field[end])
        TRY(record_file_reject(file, "columns as name [unit], not '%s'", field));
    const int column = find_column(name);
    if (column < 0)
        TRY(record_file_reject(file, "known columns, not '%s': see docs/file-formats.md", name));
    if (l->unit[column]) TRY(record_file_reject(file, "one column '%s', not two", name));
    l->unit[column] = find_unit(column, unit);
    if (!l->unit[column])
        TRY(record_file_reject(file, "another unit of %s, as [%s], not [%s]", name,
                               columns[column].unit[0].name, unit));
    l->column[l->count++] = column;
out:
    return rc;
}

static status check_layout(const layout *l, const record_file *file)
{
    status rc = STATUS_OK;
    const int needed[] = {TIME, AIR, PRESSURE, WIND};

    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        if (!l->unit[needed[i]])
            TRY(record_file_reject(file, "a column '%s [%s]'", columns[needed[i]].name,
                                   columns[needed[i]].unit[0].name));
    if (!l->unit[HUMIDITY] == !l->unit[DEW_POINT])
        TRY(record_file_reject(file, "a column 'relative_humidity [%%]' or 'dew_point [C]'"));
    if (!l->unit[DIRECT] != !l->unit[DIFFUSE] || !l->unit[DIRECT] == !l->unit[GLOBAL])
        TRY(record_file_reject(file,
                               "columns 'direct [W/m2]' and 'diffuse [W/m2]', or 'global [W/m2]'"));
out:
    return rc;
}

static status read_header(layout *l, record_file *file)
{
    status rc = STATUS_OK;
    char field[FIELD_SIZE * 2];
    const char *text;

    TRY(record_file_text(file, &text, "a header: time [h],air_temperature [C],..."));
    for (const char *at = text; at;) {
        const size_t length = strcspn(at, ",");
        if (length >= sizeof field || l->count == TABLE_COLUMNS)
            TRY(record_file_reject(file, "columns as name [unit], each once"));
        memcpy(field, at, length);
        field[length] = '\0';
        TRY(add_field(l, file, field));
        at = at[length] ? at + length + 1 : NULL;
    }
    TRY(check_layout(l, file));
out:
    return rc;
}

static weather_record record_of(const layout *l, const double value[TABLE_COLUMNS])
{
    const double air_k = value[AIR];
    const bool has_dew = l->unit[DEW_POINT];
    const double dew_k =
        has_dew ? value[DEW_POINT] : weather_dew_point_k(air_k, fmin(1.0, value[HUMIDITY]));
    const double humidity = weather_saturation_pa(dew_k) / weather_saturation_pa(air_k);

    return (weather_record){
        .time_h = value[TIME],
        .air_temperature_k = air_k,
        .pressure_pa = value[PRESSURE],
        .relative_humidity = fmin(1.0, humidity),
        .dew_point_k = dew_k,
        .wind_m_s = value[WIND],
        .direct_w_m2 = fmax(0.0, value[DIRECT]),
        .diffuse_w_m2 = fmax(0.0, value[DIFFUSE]) + fmax(0.0, value[GLOBAL]),
        .sky_exposure = 1.0,
        .longwave_w_m2 = value[LONGWAVE_DOWN],
        .precipitation_type = value[RAIN] > 0.0,
        .precipitation_m_s = value[RAIN],
        .precipitation_temperature_k = air_k,
    };
}

static status read_row(double value[TABLE_COLUMNS], const layout *l, record_file *file)
{
    status rc = STATUS_OK;
    double found[TABLE_COLUMNS];
    char expected[64];

    snprintf(expected, sizeof expected, "%zu numbers, as the header names", l->count);
    TRY(record_file_numbers(file, l->count, found, expected));
    for (size_t i = 0; i < l->count; i++) {
        const int c = l->column[i];
        value[c] = l->unit[c]->scale * found[i] + l->unit[c]->offset;
        if (!(value[c] >= columns[c].low && value[c] <= columns[c].high))
            TRY(record_file_reject(file,
                                   "%s in [%s] within its range, not %g: leave out or fill "
                                   "what is missing",
                                   columns[c].name, l->unit[c]->name, found[i]));
    }
out:
    return rc;
}

/* Grows by doubling: the length is not stated. */
static status make_room(weather_table *t, size_t *room)
{
    status rc = STATUS_OK;
    const size_t more = *room ? 2 * *room : 128;
    weather_record *record = realloc(t->history->record, more * sizeof *record);

    NEED(record, STATUS_MEMORY, "no memory for %zu weather records", more);
    t->history->record = record;
    double *surface_k = realloc(t->surface_k, more * sizeof *surface_k);
    NEED(surface_k, STATUS_MEMORY, "no memory for %zu weather records", more);
    t->surface_k = surface_k;
    double *up = realloc(t->longwave_up_w_m2, more * sizeof *up);
    NEED(up, STATUS_MEMORY, "no memory for %zu weather records", more);
    t->longwave_up_w_m2 = up;
    *room = more;
out:
    return rc;
}

/* Takes the interval from the first two records, and holds the others to it. */
static status check_time(weather *w, size_t i, const record_file *file)
{
    status rc = STATUS_OK;
    const double first_h = w->record[0].time_h;

    if (i == 1) {
        const double step_h = w->record[1].time_h - first_h;
        const double steps = step_h > 0.0 ? round(1.0 / step_h) : 0.0;
        if (steps < 1.0 || steps > 3600.0 || fabs(step_h * steps - 1.0) > 2e-3)
            TRY(record_file_reject(file, "a time that divides an hour after the last"));
        w->interval_s = 3600.0 / steps;
    }
    const double time_h = first_h + (double)i * w->interval_s / 3600.0;
    if (fabs(w->record[i].time_h - time_h) > fmin(0.0051, 0.3 * w->interval_s / 3600.0))
        TRY(record_file_reject(file, "the time %.4g h, one interval after the last", time_h));
    w->record[i].time_h = time_h;
out:
    return rc;
}

static status read_rows(weather_table *t, const layout *l, record_file *file)
{
    status rc = STATUS_OK;
    weather *w = t->history;
    size_t room = 0;

    w->count = 0;
    while (!record_file_at_end(file)) {
        double value[TABLE_COLUMNS] = {0};
        if (w->count == LONGEST_TABLE)
            TRY(record_file_reject(file, "at most %d records", LONGEST_TABLE));
        /* Twice: a single day is repeated. */
        if (2 * w->count + 2 > room) TRY(make_room(t, &room));
        TRY(read_row(value, l, file));
        w->record[w->count] = record_of(l, value);
        t->surface_k[w->count] = value[SURFACE];
        t->longwave_up_w_m2[w->count] = value[LONGWAVE_UP];
        TRY(check_time(w, w->count, file));
        w->count++;
    }
    if (w->count < 2) TRY(record_file_reject(file, "two records or more"));
out:
    return rc;
}

static void repeat_day(weather_table *t)
{
    weather *w = t->history;
    const size_t day = (size_t)lround(86400.0 / w->interval_s);

    if (w->count != day) return;
    for (size_t i = 0; i < day; i++) {
        w->record[day + i] = w->record[i];
        w->record[day + i].time_h += 24.0;
        t->surface_k[day + i] = t->surface_k[i];
        t->longwave_up_w_m2[day + i] = t->longwave_up_w_m2[i];
    }
    w->count = 2 * day;
}

status weather_table_read(weather_table *out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    weather_table t = {0};
    layout l = {0};

    TRY(record_file_open(&file, path));
    TRY(read_header(&l, file));
    TRY(weather_allocate(&t.history, 1, 3600.0));
    TRY(read_rows(&t, &l, file));
    repeat_day(&t);
    if (!l.unit[SURFACE]) {
        free(t.surface_k);
        t.surface_k = NULL;
    }
    if (!l.unit[LONGWAVE_UP]) {
        free(t.longwave_up_w_m2);
        t.longwave_up_w_m2 = NULL;
    }
    *out = t;
    t = (weather_table){0};
out:
    weather_table_free(&t);
    record_file_free(file);
    return rc;
}

void weather_table_free(weather_table *table)
{
    weather_free(table->history);
    free(table->surface_k);
    free(table->longwave_up_w_m2);
    *table = (weather_table){0};
}
