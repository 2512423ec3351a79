#include "sonde.h"

#include "files/record_file.h"
#include "weather/weather.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ZERO_C_K 273.15
#define SUPERSATURATED_K 1.0 /* soundings report some percent more than 100 */

enum { WIDTH = 7, COLUMN_LIMIT = 16 };

/* What a column of a CSV file holds: value = scale * number + offset, into a field. */
typedef struct column {
    const char *name;
    size_t offset; /* of the field */
    double scale, shift;
} column;

#define AT(member) offsetof(sonde_level, member)
#define HUMIDITY AT(dew_point_k)

static const column columns[] = {
    {"pressure_hpa", AT(pressure_hpa), 1.0, 0.0},
    {"altitude_m", AT(altitude_m), 1.0, 0.0},
    {"altitude_km", AT(altitude_m), 1000.0, 0.0},
    {"temperature_c", AT(temperature_k), 1.0, ZERO_C_K},
    {"temperature_k", AT(temperature_k), 1.0, 0.0},
    {"dew_point_c", HUMIDITY, 1.0, ZERO_C_K},
    {"dew_point_k", HUMIDITY, 1.0, 0.0},
    {"relative_humidity_percent", HUMIDITY, .01, 0.0}, /* a fraction until the row is whole */
};

enum { COLUMN_COUNT = sizeof columns / sizeof *columns };

static status add_level(sonde *s, const sonde_level *level, const record_file *file)
{
    sonde_level *larger;
    const sonde_level *last = s->count ? &s->level[s->count - 1] : NULL;

    if (level->altitude_m < -500.0 || level->altitude_m > 60000.0 || level->pressure_hpa <= 0.0 ||
        level->pressure_hpa > 1100.0 || level->temperature_k < 150.0 ||
        level->temperature_k > 350.0)
        return record_file_reject(file, "a level within -500 to 60000 m, up to 1100 hPa and 150 to "
                                        "350 K");
    if (level->dew_point_k > level->temperature_k + SUPERSATURATED_K)
        return record_file_reject(file, "a dew point up to the temperature, a relative humidity up "
                                        "to 100");
    if (last &&
        (level->altitude_m <= last->altitude_m || level->pressure_hpa >= last->pressure_hpa))
        return record_file_reject(file, "a level above the one before, with less pressure");
    larger = realloc(s->level, (s->count + 1) * sizeof *larger);
    if (!larger) return status_set(STATUS_MEMORY, "no memory for a radiosonde's levels");
    s->level = larger;
    s->level[s->count++] = *level;
    return STATUS_OK;
}

static status read_csv_head(const column **out, int *out_count, record_file *file)
{
    status rc = STATUS_OK;
    const char *text, *expected = "pressure_hpa, altitude_m or altitude_km, temperature_c or "
                                  "temperature_k, and dew_point_c, dew_point_k, "
                                  "relative_humidity_percent or none";
    bool has_pressure = false, has_altitude = false, has_temperature = false;

    TRY(record_file_text(file, &text, "the names of the columns"));
    *out_count = 0;
    for (const char *name = text; *name && *out_count < COLUMN_LIMIT;) {
        const size_t length = strcspn(name, ",");
        const column *found = NULL;
        for (int i = 0; i < COLUMN_COUNT; i++)
            if (strlen(columns[i].name) == length && !strncmp(columns[i].name, name, length))
                found = &columns[i];
        if (!found) {
            rc = record_file_reject(file, "columns with units: %s", expected);
            goto out;
        }
        has_pressure |= found->offset == AT(pressure_hpa);
        has_altitude |= found->offset == AT(altitude_m);
        has_temperature |= found->offset == AT(temperature_k);
        out[(*out_count)++] = found;
        name += length + (name[length] == ',');
    }
    if (!has_pressure || !has_altitude || !has_temperature)
        rc = record_file_reject(file, "all of the columns %s", expected);
out:
    return rc;
}

static status read_csv(sonde *s, record_file *file)
{
    status rc = STATUS_OK;
    const column *head[COLUMN_LIMIT];
    double values[COLUMN_LIMIT];
    int count;

    TRY(read_csv_head(head, &count, file));
    while (!record_file_at_end(file)) {
        sonde_level level = {.dew_point_k = NAN};
        bool is_share = false;
        TRY(record_file_numbers(file, (size_t)count, values, "a number in each column"));
        for (int i = 0; i < count; i++) {
            *(double *)((char *)&level + head[i]->offset) =
                head[i]->scale * values[i] + head[i]->shift;
            is_share |= head[i]->offset == HUMIDITY && head[i]->scale != 1.0;
        }
        if (is_share)
            level.dew_point_k =
                weather_dew_point_k(level.temperature_k, fmax(1e-4, level.dew_point_k));
        TRY(add_level(s, &level, file));
    }
out:
    return rc;
}

/* The number in a column of seven; false where it is blank. */
static bool wyoming_field(const char *text, size_t start, int number, double *out)
{
    char field[WIDTH + 1] = "";
    const size_t from = (size_t)(number * WIDTH), length = start + strlen(text);

    for (size_t i = 0; i < WIDTH && from + i < length; i++)
        field[i] = from + i < start ? ' ' : text[from + i - start];
    return record_numbers(field, 1, out) == 1;
}

static status find_wyoming_head(record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    char first[8], second[8], third[8], fourth[8];

    do {
        TRY(record_file_text(file, &text,
                             "the head PRES HGHT TEMP DWPT of the University of Wyoming's layout, "
                             "or CSV"));
    } while (sscanf(text, "%7s %7s %7s %7s", first, second, third, fourth) != 4 ||
             strcmp(first, "PRES") != 0 || strcmp(second, "HGHT") != 0 ||
             strcmp(third, "TEMP") != 0 || strcmp(fourth, "DWPT") != 0);
    TRY(record_file_text(file, &text, "the units hPa m C C"));
    if (sscanf(text, "%7s %7s %7s %7s", first, second, third, fourth) != 4 ||
        strcmp(first, "hPa") != 0 || strcmp(second, "m") != 0 || strcmp(third, "C") != 0 ||
        strcmp(fourth, "C") != 0)
        rc = record_file_reject(file, "the units hPa m C C");
out:
    return rc;
}

/* Text after the levels (station indices) ends them. */
static status read_wyoming(sonde *s, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;

    TRY(find_wyoming_head(file));
    while (!record_file_at_end(file)) {
        sonde_level level;
        double height, celsius, dew_point;
        TRY(record_file_text(file, &text, "a level"));
        const size_t start = record_file_column(file);
        if (*text == '-') continue;
        if (record_numbers(text, 0, NULL) < 0) break;
        if (!wyoming_field(text, start, 0, &level.pressure_hpa)) break;
        if (!wyoming_field(text, start, 1, &height) || !wyoming_field(text, start, 2, &celsius))
            continue;
        level.altitude_m = height;
        level.temperature_k = celsius + ZERO_C_K;
        level.dew_point_k =
            wyoming_field(text, start, 3, &dew_point) ? dew_point + ZERO_C_K : (double)NAN;
        TRY(add_level(s, &level, file));
    }
out:
    return rc;
}

status sonde_read(sonde **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    sonde *s = calloc(1, sizeof *s);

    NEED(s, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    const char *first = record_file_peek(file);
    TRY(first && strchr(first, ',') ? read_csv(s, file) : read_wyoming(s, file));
    if (s->count < 2) {
        rc = record_file_reject(file, "at least two levels with height and temperature");
        goto out;
    }
    *out = s;
    s = NULL;
out:
    record_file_free(file);
    sonde_free(s);
    return rc;
}

void sonde_free(sonde *s)
{
    if (!s) return;
    free(s->level);
    free(s);
}

sonde_level sonde_at(const sonde *s, double altitude_m)
{
    size_t i = 1;

    while (i + 1 < s->count && s->level[i].altitude_m < altitude_m) i++;
    const sonde_level *a = &s->level[i - 1], *b = &s->level[i];
    const double fraction = (altitude_m - a->altitude_m) / (b->altitude_m - a->altitude_m);
    return (sonde_level){altitude_m,
                         a->pressure_hpa * pow(b->pressure_hpa / a->pressure_hpa, fraction),
                         a->temperature_k + fraction * (b->temperature_k - a->temperature_k),
                         a->dew_point_k + fraction * (b->dew_point_k - a->dew_point_k)};
}
