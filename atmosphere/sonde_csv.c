#include "sonde_layout.h"

#include "base/number.h"
#include "files/column.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "files/unit.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LONGEST_S (3 * 3600.0) /* between two rows of one ascent */

enum { NAME_SIZE = 128 };

/* Where a quantity stands; field -1: nowhere. */
typedef struct csv_place {
    int field;
    sonde_unit unit;
} csv_place;

typedef struct csv_head {
    char separator;
    size_t names;
    csv_place place[SONDE_QUANTITIES];
    int time, station, latitude, longitude; /* fields; -1: none */
    bool lacks_unit;                        /* of a quantity */
    char head[2][NAME_SIZE];                /* above the pressure: its name, and its unit or "" */
} csv_head;

static const struct {
    const char *names, *quantity; /* of its units */
    double scale, shift;          /* from SI */
} quantities[SONDE_QUANTITIES] = {
    [SONDE_PRESSURE] = {"|pressure|pres|p|air_pressure|press|", "pressure", .01, 0.0},
    [SONDE_ALTITUDE] = {"|altitude|alt|height|hght|geopotential_height|geopotential_altitude|gph|"
                        "height_msl|altitude_msl|",
                        "length", 1.0, 0.0},
    [SONDE_TEMPERATURE] = {"|temperature|temp|t|air_temperature|tmp|", "temperature", 1.0, 0.0},
    [SONDE_DEW_POINT] = {"|dew_point|dew_point_temperature|dwpt|td|dewp|dwp|", "temperature", 1.0,
                         0.0},
    [SONDE_HUMIDITY] = {"|relative_humidity|rh|relh|", "fraction", 1.0, 0.0},
    [SONDE_DEPRESSION] = {"|dew_point_depression|dpdp|", "temperature", 1.0, 0.0},
};

static const char expected[] =
    "pressure_hpa, altitude_m or altitude_km, temperature_c or temperature_k, and dew_point_c, "
    "dew_point_k, relative_humidity_percent or none";

/* Splits `name [unit]`, `name_unit`, `name unit`, and tmpc and dwpc. */
static void split_name(const char *field, char name[NAME_SIZE], char unit_text[NAME_SIZE])
{
    *name = *unit_text = '\0';
    if (!heading_split(field, NAME_SIZE, name, unit_text) || *unit_text) return;
    char *unit_at = strpbrk(name, "_ ");
    while (unit_at && !unit_find(unit_at + 1, NULL)) unit_at = strpbrk(unit_at + 1, "_ ");
    if (heading_is_named(name, "|tmpc|dwpc|")) {
        strcpy(unit_text, "c");
        name[strlen(name) - 1] = '\0';
    } else if (unit_at) {
        strcpy(unit_text, unit_at + 1);
        *unit_at = '\0';
    }
}

static void take_quantity(csv_head *out, int field, const char *name, const char *unit_text)
{
    for (int q = 0; q < SONDE_QUANTITIES; q++) {
        csv_place *place = &out->place[q];
        if (!heading_is_named(name, quantities[q].names)) continue;
        const unit *u = unit_find(unit_text, quantities[q].quantity);
        out->lacks_unit |= !u;
        if (!u || place->field >= 0) return;
        place->field = field;
        place->unit = (sonde_unit){(sonde_quantity)q, quantities[q].scale * u->scale,
                                   q == SONDE_DEPRESSION ? 0.0 : u->offset};
    }
}

/* Reads the names, and their units where they stand in a line of their own. */
static void read_names(csv_head *out, const csv_row *row, const csv_row *units)
{
    char name[NAME_SIZE], unit_text[NAME_SIZE];

    out->names = row->count;
    out->time = out->station = out->latitude = out->longitude = -1;
    out->lacks_unit = false;
    for (int q = 0; q < SONDE_QUANTITIES; q++) out->place[q].field = -1;
    for (int i = 0; i < (int)row->count; i++) {
        split_name(row->field[i], name, unit_text);
        const char *below = csv_row_field(units, (size_t)i);
        take_quantity(out, i, name, *unit_text ? unit_text : below);
        if (heading_is_named(row->field[i],
                             "|time|date time|datetime|valid_utc|time_utc|time (UTC)|"))
            out->time = i;
        if (heading_is_named(name, "|station|station_number|station_id|wmo_id|")) out->station = i;
        if (heading_is_named(name, "|latitude|latitude_deg|lat|")) out->latitude = i;
        if (heading_is_named(name, "|longitude|longitude_deg|lon|")) out->longitude = i;
    }
}

static bool has(const csv_head *head, sonde_quantity q)
{
    return head->place[q].field >= 0;
}

/* Takes the line of names and, where it holds their units, the line below it. */
static status read_head(csv_head *out, record_file *file)
{
    status rc = STATUS_OK;
    const char *next;
    csv_row names = {0}, units = {0};

    TRY(csv_row_names(&names, file, &out->separator, "the names of the columns"));
    read_names(out, &names, &units);
    next = out->lacks_unit ? record_file_peek(file) : NULL;
    if (next && !isdigit((unsigned char)next[strspn(next, " \t\"-+.,;")])) {
        TRY(csv_row_take(&units, file, out->separator, "the units of the columns"));
        read_names(out, &names, &units);
    }
    if (out->lacks_unit || (!has(out, SONDE_PRESSURE) && !has(out, SONDE_TEMPERATURE)))
        TRY(record_file_reject(file, "columns with units: %s", expected));
    if (!has(out, SONDE_PRESSURE) || !has(out, SONDE_ALTITUDE) || !has(out, SONDE_TEMPERATURE))
        TRY(record_file_reject(file, "all of the columns %s", expected));
    const size_t pressure = (size_t)out->place[SONDE_PRESSURE].field;
    snprintf(out->head[0], NAME_SIZE, "%s", csv_row_field(&names, pressure));
    snprintf(out->head[1], NAME_SIZE, "%s", csv_row_field(&units, pressure));
out:
    csv_row_free(&names);
    csv_row_free(&units);
    return rc;
}

static double time_of(const char *text)
{
    int date[3], hour = 0, minute = 0;

    if (sscanf(text, "%d-%d-%d%*[ T]%d:%d", &date[0], &date[1], &date[2], &hour, &minute) < 3)
        return (double)NAN;
    return sonde_time_s(date[0], date[1], date[2], hour, minute);
}

/* What a row says of the sounding that it belongs to; fields at -1 are empty. */
static sonde_part part_of(const csv_head *head, const csv_row *row)
{
    sonde_part p = {"", (double)NAN, (double)NAN, (double)NAN, 0, 0};

    p.time_s = time_of(csv_row_field(row, (size_t)head->time));
    snprintf(p.station, sizeof p.station, "%s", csv_row_field(row, (size_t)head->station));
    number_read(csv_row_field(row, (size_t)head->latitude), &p.latitude_deg);
    number_read(csv_row_field(row, (size_t)head->longitude), &p.longitude_deg);
    return p;
}

static bool is_head(const csv_head *head, const csv_row *row)
{
    const char *text = csv_row_field(row, (size_t)head->place[SONDE_PRESSURE].field);

    return *text && (!strcmp(text, head->head[0]) || !strcmp(text, head->head[1]));
}

static bool is_same(const sonde_part *a, const sonde_part *b)
{
    return !strcmp(a->station, b->station) && !(fabs(a->time_s - b->time_s) > LONGEST_S);
}

/* Appends a row's sounding, unless it is of the one before. */
static status take_part(sonde_parts *parts, const sonde_part *p, bool begins)
{
    status rc = STATUS_OK;

    if (!begins) parts->part[parts->count - 1].end = p->line;
    TRY(sonde_parts_add(parts, p->line));
    parts->part[parts->count - 1] = *p;
out:
    return rc;
}

/* A row that repeats the head begins a sounding, as does one of another station or hour. */
static status list(sonde_parts *parts, record_file *file)
{
    status rc = STATUS_OK;
    csv_head head;
    csv_row row = {0};
    sonde_part last = {0};
    bool begins = true;

    TRY(read_head(&head, file));
    while (!record_file_at_end(file)) {
        TRY(csv_row_take(&row, file, head.separator, "a level"));
        if (is_head(&head, &row)) {
            if (!begins) parts->part[parts->count - 1].end = record_file_line(file);
            begins = true;
            continue;
        }
        sonde_part p = part_of(&head, &row);
        p.line = record_file_line(file);
        if (begins || !is_same(&p, &last)) TRY(take_part(parts, &p, begins));
        last = p;
        begins = false;
    }
out:
    csv_row_free(&row);
    return rc;
}

static status read_row(sonde_builder *builder, const csv_head *head, const csv_row *row,
                       const record_file *file)
{
    status rc = STATUS_OK;
    double value[SONDE_QUANTITIES], number;

    TRY(csv_row_check(row, head->names, file));
    for (int q = 0; q < SONDE_QUANTITIES; q++) {
        const char *text = csv_row_field(row, (size_t)head->place[q].field);
        value[q] = (double)NAN;
        if (column_is_blank(text)) continue;
        if (!number_read(text, &number))
            TRY(record_file_reject(file, "a number, or nothing, in each column, not '%.40s'",
                                   text));
        value[q] = sonde_value(builder, &head->place[q].unit, number);
    }
    TRY(sonde_add(builder, value, file));
out:
    return rc;
}

static status read(sonde_builder *builder, record_file *file, const sonde_part *part)
{
    status rc = STATUS_OK;
    csv_head head;
    csv_row row = {0};

    TRY(read_head(&head, file));
    while (!record_file_at_end(file)) {
        TRY(csv_row_take(&row, file, head.separator, "a level"));
        if (part->end > 0 && record_file_line(file) >= part->end) break;
        if (record_file_line(file) >= part->line) TRY(read_row(builder, &head, &row, file));
    }
out:
    csv_row_free(&row);
    return rc;
}

const sonde_layout sonde_csv = {list, read};
