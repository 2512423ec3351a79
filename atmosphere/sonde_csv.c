#include "sonde_layout.h"

#include "base/number.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ZERO_C_K 273.15
#define LONGEST_S (3 * 3600.0) /* between two rows of one ascent */

enum { COLUMN_LIMIT = 64, FIELD_SIZE = 64 };

/* What else than a quantity a column holds. */
typedef enum column_kind {
    COLUMN_OTHER,
    COLUMN_QUANTITY,
    COLUMN_TIME,
    COLUMN_STATION,
    COLUMN_LATITUDE,
    COLUMN_LONGITUDE
} column_kind;

typedef struct column {
    column_kind kind;
    sonde_unit unit;
} column;

typedef struct csv_head {
    char separator;
    int count;
    column at[COLUMN_LIMIT];
} csv_head;

static const struct {
    sonde_quantity quantity;
    const char *names; /* with a blank on both sides of each */
} quantities[] = {
    {SONDE_PRESSURE, " pressure pres p air_pressure press "},
    {SONDE_ALTITUDE, " altitude alt height hght geopotential_height geopotential_altitude gph "
                     "height_msl altitude_msl "},
    {SONDE_TEMPERATURE, " temperature temp t air_temperature tmp "},
    {SONDE_DEW_POINT,
     " dew_point dewpoint dew_point_temperature dewpoint_temperature dwpt td dewp dwp "},
    {SONDE_HUMIDITY, " relative_humidity rh relh "},
    {SONDE_DEPRESSION, " dew_point_depression dewpoint_depression dpdp "},
};

static const struct {
    sonde_quantity quantity;
    const char *name;
    double scale, shift;
} units[] = {
    {SONDE_PRESSURE, "hpa", 1.0, 0.0},       {SONDE_PRESSURE, "mb", 1.0, 0.0},
    {SONDE_PRESSURE, "mbar", 1.0, 0.0},      {SONDE_PRESSURE, "pa", .01, 0.0},
    {SONDE_PRESSURE, "kpa", 10.0, 0.0},      {SONDE_ALTITUDE, "m", 1.0, 0.0},
    {SONDE_ALTITUDE, "gpm", 1.0, 0.0},       {SONDE_ALTITUDE, "km", 1000.0, 0.0},
    {SONDE_TEMPERATURE, "c", 1.0, ZERO_C_K}, {SONDE_TEMPERATURE, "k", 1.0, 0.0},
    {SONDE_DEW_POINT, "c", 1.0, ZERO_C_K},   {SONDE_DEW_POINT, "k", 1.0, 0.0},
    {SONDE_HUMIDITY, "percent", .01, 0.0},   {SONDE_HUMIDITY, "share", 1.0, 0.0},
    {SONDE_DEPRESSION, "c", 1.0, 0.0},       {SONDE_DEPRESSION, "k", 1.0, 0.0},
};

static const char expected[] =
    "pressure_hpa, altitude_m or altitude_km, temperature_c or temperature_k, and dew_point_c, "
    "dew_point_k, relative_humidity_percent or none";

/* Takes the next field off a row, without quotes and blanks around it; NULL behind the last. */
static const char *take_field(const char *row, char separator, char out[FIELD_SIZE])
{
    const char *end = strchr(row, separator);
    size_t length = end ? (size_t)(end - row) : strlen(row);

    while (length && strchr(" \t\"", row[length - 1])) length--;
    while (length && strchr(" \t\"", *row)) {
        row++;
        length--;
    }
    snprintf(out, FIELD_SIZE, "%.*s", (int)length, row);
    return end ? end + 1 : NULL;
}

/* Makes `Temperature [°C]` and `temperature_C` the same: small letters, one underscore between words. */
static void plain_name(char *name, size_t size)
{
    char plain[2 * FIELD_SIZE] = "";
    size_t used = 0;

    for (const unsigned char *c = (const unsigned char *)name; *c; c++) {
        const bool is_word = isalnum(*c) || *c == '%';
        if (is_word && used > 0 && *c == '%' && plain[used - 1] != '_') plain[used++] = '_';
        if (*c == '%')
            used += (size_t)snprintf(plain + used, sizeof plain - used, "percent");
        else if (is_word)
            plain[used++] = (char)tolower(*c);
        else if (*c < 128 && used > 0 && plain[used - 1] != '_')
            plain[used++] = '_'; /* bytes beyond are those of a degree sign */
        if (used + 10 > sizeof plain) break;
    }
    while (used > 0 && plain[used - 1] == '_') used--;
    snprintf(name, size, "%.*s", (int)used, plain);
}

static bool is_one_of(const char *name, size_t length, const char *list)
{
    for (const char *at = list; (at = strchr(at, ' ')) != NULL && at[1]; at++)
        if (!strncmp(at + 1, name, length) && at[1 + length] == ' ') return true;
    return false;
}

static bool find_unit(const char *name, sonde_quantity quantity, sonde_unit *out)
{
    for (size_t i = 0; i < sizeof units / sizeof *units; i++) {
        if (units[i].quantity != quantity || strcmp(units[i].name, name) != 0) continue;
        *out = (sonde_unit){quantity, units[i].scale, units[i].shift};
        return true;
    }
    return false;
}

/* A name that ends in its unit, with an underscore between or, as in tmpc and dwpc, a letter. */
static size_t quantity_length(const char *name)
{
    const char *last = strrchr(name, '_');

    if (last) return (size_t)(last - name);
    if (!strcmp(name, "tmpc") || !strcmp(name, "dwpc")) return 3;
    return 0;
}

/* What a column holds; *out_lacks_unit is true for a quantity whose unit is not stated. */
static column column_of(const char *name, bool *out_lacks_unit)
{
    const size_t length = quantity_length(name);
    const char *unit = name + length + (name[length] == '_');
    column c = {.kind = COLUMN_OTHER};

    for (size_t i = 0; i < sizeof quantities / sizeof *quantities; i++) {
        const sonde_quantity q = quantities[i].quantity;
        if (is_one_of(name, strlen(name), quantities[i].names)) *out_lacks_unit = true;
        if (!length || !is_one_of(name, length, quantities[i].names)) continue;
        if (find_unit(unit, q, &c.unit))
            c.kind = COLUMN_QUANTITY;
        else
            *out_lacks_unit = true;
    }
    if (is_one_of(name, strlen(name), " time date_time datetime valid_utc validutc time_utc "))
        c.kind = COLUMN_TIME;
    if (is_one_of(name, strlen(name), " station station_number station_id wmo_id "))
        c.kind = COLUMN_STATION;
    if (!strcmp(name, "latitude") || !strcmp(name, "latitude_deg")) c.kind = COLUMN_LATITUDE;
    if (!strcmp(name, "longitude") || !strcmp(name, "longitude_deg")) c.kind = COLUMN_LONGITUDE;
    return c;
}

/* Reads the names, and what stands below them if that is a line of units; `has` tells which quantities
 * there are. Returns whether one lacks its unit. */
static bool read_names(csv_head *out, const char *text, const char *units_text,
                       bool has[SONDE_QUANTITIES])
{
    char name[2 * FIELD_SIZE], unit[FIELD_SIZE];
    bool lacks_unit = false;

    *out = (csv_head){.separator = strchr(text, ',') ? ',' : strchr(text, ';') ? ';' : '\t'};
    for (int q = 0; q < SONDE_QUANTITIES; q++) has[q] = false;
    for (const char *rest = text; rest && out->count < COLUMN_LIMIT; out->count++) {
        rest = take_field(rest, out->separator, name);
        *unit = '\0';
        if (units_text) units_text = take_field(units_text, out->separator, unit);
        if (*unit) snprintf(name + strlen(name), sizeof name - strlen(name), "_%s", unit);
        plain_name(name, sizeof name);
        column c = column_of(name, &lacks_unit);
        if (c.kind == COLUMN_QUANTITY && has[c.unit.quantity]) c.kind = COLUMN_OTHER;
        if (c.kind == COLUMN_QUANTITY) has[c.unit.quantity] = true;
        out->at[out->count] = c;
    }
    return lacks_unit;
}

/* Takes the line below the names too where it holds their units. */
static status read_head(csv_head *out, const char *text, record_file *file)
{
    bool has[SONDE_QUANTITIES];
    bool lacks_unit = read_names(out, text, NULL, has);
    const char *units_text = lacks_unit ? record_file_peek(file) : NULL;

    if (units_text && !isdigit((unsigned char)units_text[strspn(units_text, " \t\"-+.,;")])) {
        const status rc = record_file_text(file, &units_text, "the units of the columns");
        if (rc != STATUS_OK) return rc;
        lacks_unit = read_names(out, text, units_text, has);
    }
    if (lacks_unit || (!has[SONDE_PRESSURE] && !has[SONDE_TEMPERATURE]))
        return record_file_reject(file, "columns with units: %s", expected);
    if (!has[SONDE_PRESSURE] || !has[SONDE_ALTITUDE] || !has[SONDE_TEMPERATURE])
        return record_file_reject(file, "all of the columns %s", expected);
    return STATUS_OK;
}

/* A field's number; a field that says there is none is NAN. False where it is neither. */
static bool read_field(char *text, char separator, double *out)
{
    static const char *const none[] = {"", "nan", "na", "null", "none", "-", "--", "m", "/", "///"};
    char *comma = separator == ',' ? NULL : strchr(text, ',');

    if (comma) *comma = '.';
    if (number_read(text, out)) return true;
    for (char *c = text; *c; c++) *c = (char)tolower((unsigned char)*c);
    *out = (double)NAN;
    for (size_t i = 0; i < sizeof none / sizeof *none; i++)
        if (!strcmp(text, none[i])) return true;
    return false;
}

static double time_of(const char *text)
{
    int date[3], hour = 0, minute = 0;

    if (sscanf(text, "%d-%d-%d%*[ T]%d:%d", &date[0], &date[1], &date[2], &hour, &minute) < 3)
        return (double)NAN;
    return sonde_time_s(date[0], date[1], date[2], hour, minute);
}

/* What a row says of the sounding that it belongs to. */
static sonde_part part_of(const csv_head *head, const char *row)
{
    sonde_part p = {"", (double)NAN, (double)NAN, (double)NAN, 0, 0};
    char field[FIELD_SIZE];

    for (int i = 0; row && i < head->count; i++) {
        row = take_field(row, head->separator, field);
        const column_kind kind = head->at[i].kind;
        if (kind == COLUMN_TIME) p.time_s = time_of(field);
        if (kind == COLUMN_STATION) snprintf(p.station, sizeof p.station, "%s", field);
        if (kind == COLUMN_LATITUDE) read_field(field, head->separator, &p.latitude_deg);
        if (kind == COLUMN_LONGITUDE) read_field(field, head->separator, &p.longitude_deg);
    }
    return p;
}

static bool is_same(const sonde_part *a, const sonde_part *b)
{
    return !strcmp(a->station, b->station) && !(fabs(a->time_s - b->time_s) > LONGEST_S);
}

/* A row that repeats the head begins a sounding, as does one of another station or hour. */
static status list(sonde_parts *parts, record_file *file)
{
    status rc = STATUS_OK;
    csv_head head;
    const char *text;
    char *first = NULL;
    sonde_part last = {0};
    bool begins = true;

    TRY(record_file_text(file, &text, "the names of the columns"));
    first = strdup(text);
    NEED(first, STATUS_MEMORY, "no memory for a sounding's head");
    TRY(read_head(&head, text, file));
    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a level"));
        const bool is_head = !strcmp(text, first);
        if (is_head && !begins) parts->part[parts->count - 1].end = record_file_line(file);
        begins = begins || is_head;
        if (is_head) continue;
        sonde_part p = part_of(&head, text);
        p.line = record_file_line(file);
        if (begins || !is_same(&p, &last)) {
            if (!begins) parts->part[parts->count - 1].end = p.line;
            TRY(sonde_parts_add(parts, p.line));
            parts->part[parts->count - 1] = p;
        }
        last = p;
        begins = false;
    }
out:
    free(first);
    return rc;
}

static status read_row(sonde_builder *builder, const csv_head *head, const char *text,
                       const record_file *file)
{
    double value[SONDE_QUANTITIES], number;
    char field[FIELD_SIZE];
    int i = 0;

    for (int q = 0; q < SONDE_QUANTITIES; q++) value[q] = (double)NAN;
    for (; text && i < head->count; i++) {
        text = take_field(text, head->separator, field);
        if (head->at[i].kind != COLUMN_QUANTITY) continue;
        if (!read_field(field, head->separator, &number))
            return record_file_reject(file, "a number, or nothing, in each column");
        if (!isnan(number))
            value[head->at[i].unit.quantity] = sonde_value(builder, &head->at[i].unit, number);
    }
    if (i < head->count) return record_file_reject(file, "a number in each column");
    return sonde_add(builder, value, file);
}

static status read(sonde_builder *builder, record_file *file, const sonde_part *part)
{
    status rc = STATUS_OK;
    csv_head head;
    const char *text = NULL;

    TRY(record_file_text(file, &text, "the names of the columns"));
    TRY(read_head(&head, text, file));
    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a level"));
        if (part->end > 0 && record_file_line(file) >= part->end) break;
        if (record_file_line(file) >= part->line) TRY(read_row(builder, &head, text, file));
    }
out:
    return rc;
}

const sonde_layout sonde_csv = {list, read};
