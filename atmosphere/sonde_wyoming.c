#include "sonde_layout.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

#define ZERO_C_K 273.15

enum { WIDTH = 7, WORD_SIZE = 8 };

static const sonde_unit columns[] = {{SONDE_PRESSURE, 1.0, 0.0},
                                     {SONDE_ALTITUDE, 1.0, 0.0},
                                     {SONDE_TEMPERATURE, 1.0, ZERO_C_K},
                                     {SONDE_DEW_POINT, 1.0, ZERO_C_K}};

enum { COLUMNS = sizeof columns / sizeof *columns };

static bool begins_with(const char *line, const char *const words[COLUMNS])
{
    char word[COLUMNS][WORD_SIZE];

    if (sscanf(line, "%7s %7s %7s %7s", word[0], word[1], word[2], word[3]) != COLUMNS)
        return false;
    for (int i = 0; i < COLUMNS; i++)
        if (strcmp(word[i], words[i]) != 0) return false;
    return true;
}

bool sonde_wyoming_is_head(const char *line)
{
    static const char *const names[COLUMNS] = {"PRES", "HGHT", "TEMP", "DWPT"};

    return begins_with(line, names);
}

/* The number in a column of seven; false where it is blank. */
static bool take_field(const char *text, size_t start, int number, double *out)
{
    char field[WIDTH + 1] = "";
    const size_t from = (size_t)(number * WIDTH), length = start + strlen(text);

    for (size_t i = 0; i < WIDTH && from + i < length; i++)
        field[i] = from + i < start ? ' ' : text[from + i - start];
    return record_numbers(field, 1, out) == 1;
}

/* Takes station, place and hour from a page's other lines: `72426 ILN Wilmington Observations at 12Z 24
 * Jun 1987` stands above its table, `Station latitude: 39.42` below. */
static void read_title(const char *line, sonde_part *above, sonde_part *below)
{
    static const char months[] = "JanFebMarAprMayJunJulAugSepOctNovDec";
    const char *at = strstr(line, "Observations at ");
    char month[4] = "";
    int hour, day, year;

    if (at && sscanf(at, "Observations at %dZ %d %3s %d", &hour, &day, month, &year) == 4) {
        const char *known = strstr(months, month);
        const int number = known && strlen(month) == 3 ? (int)(known - months) / 3 + 1 : 0;
        while (*line == ' ' || *line == '<') line += *line == '<' ? strcspn(line, ">") + 1 : 1;
        snprintf(above->station, sizeof above->station, "%.*s", (int)strcspn(line, " "), line);
        above->time_s = sonde_time_s(year, number, day, hour, 0);
    }
    if (!below) return;
    if ((at = strstr(line, "Station latitude:"))) sscanf(at + 17, "%lf", &below->latitude_deg);
    if ((at = strstr(line, "Station longitude:"))) sscanf(at + 18, "%lf", &below->longitude_deg);
}

static status list(sonde_parts *parts, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    sonde_part title = {.time_s = (double)NAN};

    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "the head PRES HGHT TEMP DWPT"));
        sonde_part *last = parts->count ? &parts->part[parts->count - 1] : NULL;
        read_title(text, &title, last);
        if (!sonde_wyoming_is_head(text)) continue;
        if (last) last->end = record_file_line(file);
        TRY(sonde_parts_add(parts, record_file_line(file)));
        last = &parts->part[parts->count - 1];
        snprintf(last->station, sizeof last->station, "%s", title.station);
        last->time_s = title.time_s;
        title = (sonde_part){.time_s = (double)NAN};
    }
out:
    return rc;
}

/* Text after the levels (station indices) ends them. */
static status read(sonde_builder *builder, record_file *file, const sonde_part *part)
{
    static const char *const units[COLUMNS] = {"hPa", "m", "C", "C"};
    status rc = STATUS_OK;
    const char *text = "";
    double number;

    while (record_file_line(file) < part->line) TRY(record_file_text(file, &text, "a head"));
    TRY(record_file_text(file, &text, "the units hPa m C C"));
    if (!begins_with(text, units)) {
        rc = record_file_reject(file, "the units hPa m C C");
        goto out;
    }
    while (!record_file_at_end(file)) {
        double value[SONDE_QUANTITIES];
        TRY(record_file_text(file, &text, "a level"));
        const size_t start = record_file_column(file);
        if (*text == '-' && text[1] == '-') continue;
        if (record_numbers(text, 0, NULL) < 0) break;
        if (strchr(text, '\t'))
            TRY(record_file_reject(file, "columns of seven characters, without tabs"));
        for (int q = 0; q < SONDE_QUANTITIES; q++) value[q] = (double)NAN;
        for (int i = 0; i < COLUMNS; i++)
            if (take_field(text, start, i, &number))
                value[columns[i].quantity] = sonde_value(builder, &columns[i], number);
        TRY(sonde_add(builder, value, file));
    }
out:
    return rc;
}

const sonde_layout sonde_wyoming = {list, read};
