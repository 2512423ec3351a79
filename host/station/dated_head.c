#include "station/dated_head.h"

#include "base/number.h"
#include "files/heading.h"
#include "station/date_text.h"

#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

enum { NAME_SIZE = 64, PVGIS_LINES = 64 };

static const char pvgis_begin[] = "Latitude (decimal degrees)";
static const char stamp_names[] = "|valid_time|time(UTC)|timestamp|datetime|date time|period_end|";

/* The field with one of the names, as a whole or before its unit; -1: none. */
static int field_named(const csv_row *row, const char *names)
{
    char name[NAME_SIZE], unit_text[NAME_SIZE];

    for (size_t i = 0; i < row->count; i++) {
        if (heading_is_named(row->field[i], names)) return (int)i;
        if (heading_split(row->field[i], NAME_SIZE, name, unit_text) &&
            heading_is_named(name, names))
            return (int)i;
    }
    return -1;
}

static dated_fields find_fields(const csv_row *row)
{
    dated_fields f = {
        .year = field_named(row, "|Year|YYYY|"),
        .month = field_named(row, "|Month|MM|MO|"),
        .day = field_named(row, "|Day|DD|DY|"),
        .hour = field_named(row, "|Hour|HH|HR|"),
        .minute = field_named(row, "|Minute|MI|"),
        .date = field_named(row, "|Date|"),
        .time = field_named(row, "|Time|"),
        .stamp = field_named(row, stamp_names),
        .latitude = field_named(row, "|latitude|lat|"),
        .longitude = field_named(row, "|longitude|lon|"),
    };

    if (f.month < 0 || f.day < 0) f.year = -1;
    if (f.stamp < 0 && f.date >= 0 && f.time < 0) f.stamp = f.date;
    if (f.stamp < 0 && f.time >= 0 && f.date < 0) f.stamp = f.time;
    if (f.stamp < 0 && row->count > 0 && !*row->field[0]) f.stamp = 0; /* an index without a name */
    return f;
}

/* Whether a name alone tells of dates; `time` may be hours. */
static bool is_named_date(const dated_fields *f, const csv_row *first)
{
    return f->year >= 0 || f->date >= 0 || field_named(first, stamp_names) >= 0;
}

/* Whether a row's date can be read by those fields. */
static bool has_date(const dated_fields *f, const csv_row *row)
{
    weather_date date;
    double number, offset_h;

    if (f->year >= 0) return number_read(csv_row_field(row, (size_t)f->year), &number);
    const int field = f->date >= 0 && f->time >= 0 ? f->date : f->stamp;
    return field >= 0 && date_text_read(csv_row_field(row, (size_t)field), &date, &offset_h);
}

/* The kind by the first two lines; the second one alone is taken apart. */
static dated_kind kind_of(const csv_row *first, const char *second, dated_fields *fields,
                          const csv_row *second_row)
{
    const char *begin = csv_row_field(first, 0);

    if (!strncasecmp(begin, pvgis_begin, sizeof pvgis_begin - 1)) return DATED_PVGIS;
    if (!strcasecmp(begin, "Source") && field_named(first, "|Latitude|") >= 0) return DATED_NSRDB;
    if (!strncasecmp(second + (*second == '"'), "Date (MM/DD/YYYY)", 17)) return DATED_TMY3;
    *fields = find_fields(first);
    if (!is_named_date(fields, first) && !has_date(fields, second_row)) return DATED_NONE;
    return field_named(first, "|valid_time|") >= 0 ? DATED_ERA5 : DATED_OTHER;
}

/* Reads a number of the head, which may be absent. */
static status take_number(const csv_row *row, int field, double low, double high, double *out,
                          const record_file *file)
{
    status rc = STATUS_OK;
    const char *text = field < 0 ? "" : csv_row_field(row, (size_t)field);

    if (column_is_blank(text)) return STATUS_OK;
    if (!number_read(text, out) || !(*out >= low && *out <= high))
        TRY(record_file_reject(file, "a number from %g to %g for the place, not '%.40s'", low, high,
                               text));
out:
    return rc;
}

typedef struct place_fields {
    int name, latitude, longitude, elevation, offset;
} place_fields;

static status take_place(dated_head *h, const csv_row *row, place_fields f, const record_file *file)
{
    status rc = STATUS_OK;

    if (f.name >= 0) snprintf(h->name, sizeof h->name, "%s", csv_row_field(row, (size_t)f.name));
    TRY(take_number(row, f.latitude, -90.0, 90.0, &h->latitude_deg, file));
    TRY(take_number(row, f.longitude, -180.0, 180.0, &h->longitude_deg, file));
    TRY(take_number(row, f.elevation, -500.0, 9000.0, &h->elevation_m, file));
    TRY(take_number(row, f.offset, -14.0, 14.0, &h->utc_offset_h, file));
out:
    return rc;
}

/* `Latitude (decimal degrees): 45.000` and others, up to the line of names, which is left in `row`. */
static status read_pvgis(dated_head *h, csv_row *row, record_file *file)
{
    status rc = STATUS_OK;

    for (int i = 0; i < PVGIS_LINES && strncasecmp(csv_row_field(row, 0), "time", 4); i++) {
        const char *text = csv_row_field(row, 0), *colon = strchr(text, ':');
        double number;
        if (colon && number_read(colon + 1 + strspn(colon + 1, " \t"), &number)) {
            if (!strncasecmp(text, "Latitude", 8)) h->latitude_deg = number;
            if (!strncasecmp(text, "Longitude", 9)) h->longitude_deg = number;
            if (!strncasecmp(text, "Elevation", 9)) h->elevation_m = number;
            if (!strncasecmp(text, "Irradiance Time Offset", 22)) h->light_after_h = number;
        }
        TRY(csv_row_take(row, file, ',', "a line of names: time(UTC),T2m,..."));
    }
    h->utc_offset_h = 0.0;
out:
    return rc;
}

/* The unit that NSRDB's head states for a column: `Wind Speed Units`, m/s. */
static void nsrdb_unit(char out[NAME_SIZE], const char *name, const csv_row *names,
                       const csv_row *values)
{
    char wanted[2 * NAME_SIZE];

    snprintf(wanted, sizeof wanted, "|%.60s Units|", name);
    const int field = field_named(names, wanted);
    if (field >= 0 && unit_find(csv_row_field(values, (size_t)field), NULL))
        snprintf(out, NAME_SIZE, "%s", csv_row_field(values, (size_t)field));
}

static status find_columns(dated_head *h, const csv_row *row, const csv_row *names,
                           const csv_row *values, const record_file *file)
{
    status rc = STATUS_OK;
    char text[NAME_SIZE];

    for (size_t i = 0; i < row->count; i++) {
        const int c = dated_column_find(row->field[i], h->kind == DATED_ERA5, text);
        if (c < 0) continue;
        if (h->place[c].column && !strcmp(row->field[i], row->field[h->place[c].field]))
            TRY(record_file_reject(file, "one column '%s', not two", row->field[i]));
        if (h->place[c].column) continue;
        if (names) nsrdb_unit(text, row->field[i], names, values);
        const unit *usual = unit_find(dated_columns[c].unit, NULL);
        const unit *here = unit_find(text, usual->quantity);
        if (*text && !here)
            TRY(record_file_reject(file, "another unit of %s, as %s, not '%s'",
                                   dated_columns[c].name, dated_columns[c].unit, text));
        h->place[c] = column_place_at(&dated_columns[c], here, i);
        h->is_pressure_open |= c == WEATHER_SERIES_PRESSURE_PA && !*text;
    }
    h->fields = find_fields(row);
    h->names = row->count;
out:
    return rc;
}

/* The kind, by the first line, which is taken, and the second, which is not. */
static status read_kind(dated_head *h, csv_row *first, csv_row *second, record_file *file)
{
    status rc = STATUS_OK;
    const char *next;
    char line[4096];

    TRY(csv_row_names(first, file, &h->separator, "a line of names"));
    next = record_file_peek(file);
    if (!next) return STATUS_OK;
    snprintf(line, sizeof line, "%.*s", (int)strcspn(next, "\n"), next);
    TRY(csv_row_split(second, line, h->separator));
    h->kind = kind_of(first, line, &h->fields, second);
out:
    return rc;
}

status dated_head_read(dated_head *out, record_file *file)
{
    status rc = STATUS_OK;
    static const char expected[] = "a line of names";
    csv_row first = {0}, second = {0}, names = {0};
    dated_head h = {
        .latitude_deg = NAN, .longitude_deg = NAN, .elevation_m = NAN, .utc_offset_h = NAN};

    TRY(read_kind(&h, &first, &second, file));
    if (h.kind == DATED_NSRDB) {
        TRY(csv_row_take(&second, file, h.separator, expected));
        TRY(take_place(&h, &second,
                       (place_fields){-1, field_named(&first, "|Latitude|"),
                                      field_named(&first, "|Longitude|"),
                                      field_named(&first, "|Elevation|"),
                                      field_named(&first, "|Time Zone|")},
                       file));
        TRY(csv_row_take(&names, file, h.separator, expected));
        TRY(find_columns(&h, &names, &first, &second, file));
    } else if (h.kind == DATED_TMY3) {
        TRY(take_place(&h, &first, (place_fields){1, 4, 5, 6, 3}, file));
        TRY(csv_row_take(&names, file, h.separator, expected));
        TRY(find_columns(&h, &names, NULL, NULL, file));
    } else if (h.kind == DATED_PVGIS) {
        h.separator = ',';
        TRY(read_pvgis(&h, &first, file));
        TRY(find_columns(&h, &first, NULL, NULL, file));
    } else if (h.kind != DATED_NONE) {
        TRY(find_columns(&h, &first, NULL, NULL, file));
    }
    *out = h;
out:
    csv_row_free(&first);
    csv_row_free(&second);
    csv_row_free(&names);
    return rc;
}
