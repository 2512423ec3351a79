#include "sonde_layout.h"

#include "base/number.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>

#define ZERO_C_K 273.15

/* Columns of a level, counted from 0, as the archive's format description has them. */
static const struct {
    int begin, width;
    sonde_unit unit;
} fields[] = {{9, 6, {SONDE_PRESSURE, .01, 0.0}},
              {16, 5, {SONDE_ALTITUDE, 1.0, 0.0}},
              {22, 5, {SONDE_TEMPERATURE, .1, ZERO_C_K}},
              {28, 5, {SONDE_HUMIDITY, .001, 0.0}},
              {34, 5, {SONDE_DEPRESSION, .1, 0.0}}};

enum { FIELDS = sizeof fields / sizeof *fields, HEAD_SIZE = 71, LEVEL_SIZE = 39 };

/* The whole number in columns; false where they are blank, or hold something else. */
static bool take(const char *line, int begin, int width, int *out)
{
    char field[16];
    const char *start = field;
    int64_t number;

    if (strlen(line) < (size_t)(begin + width)) return false;
    snprintf(field, sizeof field, "%.*s", width, line + begin);
    while (*start == ' ') start++;
    if (!number_read_whole(start, -99999999, 99999999, &number)) return false;
    *out = (int)number;
    return true;
}

bool sonde_igra_is_head(const char *line)
{
    int year, count;

    return *line == '#' && strlen(line) >= HEAD_SIZE && isalnum((unsigned char)line[1]) &&
           take(line, 13, 4, &year) && take(line, 32, 4, &count);
}

static void read_head(sonde_part *p, const char *line)
{
    int date[4] = {0}, place[2];

    snprintf(p->station, sizeof p->station, "%.11s", line + 1);
    for (int i = 0; i < 4; i++) take(line, 13 + (i ? 2 + 3 * i : 0), i ? 2 : 4, &date[i]);
    if (date[3] != 99) p->time_s = sonde_time_s(date[0], date[1], date[2], date[3], 0);
    if (!take(line, 55, 7, &place[0]) || !take(line, 63, 8, &place[1])) return;
    if (place[0] > 900000 || place[0] < -900000) return;
    p->latitude_deg = 1e-4 * place[0];
    p->longitude_deg = 1e-4 * place[1];
}

static status list(sonde_parts *parts, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;

    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a sounding"));
        if (!sonde_igra_is_head(text)) continue;
        if (parts->count) parts->part[parts->count - 1].end = record_file_line(file);
        TRY(sonde_parts_add(parts, record_file_line(file)));
        read_head(&parts->part[parts->count - 1], text);
    }
out:
    return rc;
}

static status read_level(sonde_builder *builder, const char *text, const record_file *file)
{
    double value[SONDE_QUANTITIES];
    int number;

    /* Two digits tell what kind of level it is; the archive's derived soundings have none. */
    if (text[0] < '1' || text[0] > '3' || !isdigit((unsigned char)text[1]))
        return record_file_reject(file, "a level in the columns of IGRA 2");
    for (int q = 0; q < SONDE_QUANTITIES; q++) value[q] = (double)NAN;
    for (int i = 0; i < FIELDS; i++) {
        if (!take(text, fields[i].begin, fields[i].width, &number))
            return record_file_reject(file, "a level in the columns of IGRA 2");
        if (number > -8888)
            value[fields[i].unit.quantity] = fields[i].unit.scale * number + fields[i].unit.shift;
    }
    return sonde_add(builder, value, file);
}

/* The head states how many levels follow. */
static status read(sonde_builder *builder, record_file *file, const sonde_part *part)
{
    status rc = STATUS_OK;
    const char *text = "";
    int count = 0;

    while (record_file_line(file) < part->line) TRY(record_file_text(file, &text, "a head"));
    take(text, 32, 4, &count);
    for (int i = 0; i < count; i++) {
        TRY(record_file_text(file, &text, "a level"));
        TRY(read_level(builder, text, file));
    }
out:
    return rc;
}

const sonde_layout sonde_igra = {list, read};
