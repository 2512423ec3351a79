#include "sky/atmosphere_container.h"

#include "base/interrupt.h"
#include "files/json_text.h"
#include "files/output_file.h"
#include "kernels/records.h"
#include "meshio/cancel.h"
#include "meshio/input_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char magic[] = "RADSIG ATMOSPHERE 1\n";

#define RADIANCE_LIMIT 1e4 /* W m-2 sr-1 um-1, as in the text file */

enum { COUNT_LIMIT = 1000000, REQUIRED_KEYS = 14, NUMBER_KEYS = 16, ARRAYS = 21 };

/* A key of the JSON object, a number: in the struct a double, or an int. */
typedef struct number_key {
    const char *name;
    double *number;
    int *count;
    double low, high;
} number_key;

/* An array of the file, with the range of its values. */
typedef struct block {
    double **at;
    size_t size;
    double low, high;
} block;

/* What is left to read of the file. */
typedef struct contents {
    const char *next, *end;
} contents;

static const char arrays_text[] =
    "solar_irradiance (n), tau1 (n), path_range_m (m), tau2 (m, n), path_emitted (m, n), "
    "path_scattered (m, n), sky_emitted (n), sky_scattered (n), sky_emitted_direction (zenith, "
    "azimuth, n), sky_scattered_direction (zenith, azimuth, n), level_altitude_m (level), "
    "level_temperature_k (level); n = point_count, ascending wavelength, m = path_count";
static const char target_text[] = "; then target_altitude_m (target), target_range_m (target, m), "
                                  "target_tau (target, m, n), target_emitted, target_scattered";
static const char range_text[] =
    "; then range_m (range), range_tau (range, n), range_emitted, range_scattered";

static void list_numbers(atmosphere *a, number_key out[NUMBER_KEYS])
{
    const number_key keys[NUMBER_KEYS] = {
        {"sensor_altitude_m", &a->sensor_altitude_m, NULL, 0.0, 1e6},
        {"wavenumber_min_cm1", &a->wavenumber_min_cm1, NULL, 100.0, 50000.0},
        {"wavenumber_max_cm1", &a->wavenumber_max_cm1, NULL, 100.0, 50000.0},
        {"wavenumber_step_cm1", &a->wavenumber_step_cm1, NULL, 1e-3, 50000.0},
        {"point_count", NULL, &a->point_count, 1.0, COUNT_LIMIT},
        {"path_zenith_first_deg", &a->path_zenith_first_deg, NULL, 0.0, 90.0},
        {"path_zenith_step_deg", &a->path_zenith_step_deg, NULL, 1e-6, 90.0},
        {"path_zenith_meaningful_deg", &a->path_zenith_meaningful_deg, NULL, 0.0, 90.0},
        {"path_count", NULL, &a->path_count, 1.0, COUNT_LIMIT},
        {"zenith_step_deg", &a->zenith_step_deg, NULL, 1e-6, 90.0},
        {"zenith_count", NULL, &a->zenith_count, 1.0, COUNT_LIMIT},
        {"azimuth_step_deg", &a->azimuth_step_deg, NULL, 0.0, 360.0},
        {"azimuth_count", NULL, &a->azimuth_count, 1.0, COUNT_LIMIT},
        {"level_count", NULL, &a->level_count, 1.0, COUNT_LIMIT},
        {"target_count", NULL, &a->target_count, 1.0, COUNT_LIMIT},
        {"range_count", NULL, &a->range_count, 1.0, COUNT_LIMIT}};

    memcpy(out, keys, sizeof keys);
}

static void list_blocks(atmosphere *a, block out[ARRAYS])
{
    const size_t n = (size_t)a->point_count, m = (size_t)a->path_count;
    const size_t sky = (size_t)a->zenith_count * (size_t)a->azimuth_count * n;
    const size_t levels = (size_t)a->level_count, targets = (size_t)a->target_count;
    const size_t ranges = (size_t)a->range_count;
    const double most = RADIANCE_LIMIT;
    const block blocks[ARRAYS] = {{&a->solar_irradiance, n, 0.0, most},
                                  {&a->tau1, n, 0.0, 1.0},
                                  {&a->path_range_m, m, 0.0, 1e8},
                                  {&a->tau2, m * n, 0.0, 1.0},
                                  {&a->path_emitted, m * n, 0.0, most},
                                  {&a->path_scattered, m * n, 0.0, most},
                                  {&a->sky_emitted, n, 0.0, most},
                                  {&a->sky_scattered, n, 0.0, most},
                                  {&a->sky_emitted_direction, sky, 0.0, most},
                                  {&a->sky_scattered_direction, sky, 0.0, most},
                                  {&a->level_altitude_m, levels, -1e3, 1e6},
                                  {&a->level_temperature_k, levels, 100.0, 1000.0},
                                  {&a->target_altitude_m, targets, -1e3, 1e6},
                                  {&a->target_range_m, targets * m, 0.0, 1e8},
                                  {&a->target_tau, targets * m * n, 0.0, 1.0},
                                  {&a->target_emitted, targets * m * n, 0.0, most},
                                  {&a->target_scattered, targets * m * n, 0.0, most},
                                  {&a->range_m, ranges, 0.0, 1e8},
                                  {&a->range_tau, ranges * n, 0.0, 1.0},
                                  {&a->range_emitted, ranges * n, 0.0, most},
                                  {&a->range_scattered, ranges * n, 0.0, most}};

    memcpy(out, blocks, sizeof blocks);
}

bool atmosphere_container_is(const char *path)
{
    char start[sizeof magic] = "", message[1024];
    FILE *file = NULL;
    const bool is = !input_file_open(&file, NULL, path, SIZE_MAX, message, sizeof message) &&
                    fread(start, 1, sizeof magic - 1, file) == sizeof magic - 1 &&
                    !strcmp(start, magic);

    if (file) fclose(file);
    return is;
}

static status take_number(const number_key *key, double value, const char *path)
{
    status rc = STATUS_OK;

    NEED(value >= key->low && value <= key->high && (key->number || value == floor(value)),
         STATUS_FORMAT, "%s: %s is %g, expected a %snumber from %g to %g", path, key->name, value,
         key->number ? "" : "whole ", key->low, key->high);
    if (key->number)
        *key->number = value;
    else
        *key->count = (int)value;
out:
    return rc;
}

/* The comment lines that came with the database, as one text. */
static status read_header(char **out, const json_t *lines, const char *path)
{
    status rc = STATUS_OK;
    size_t length, i;
    const json_t *line;
    FILE *header = open_memstream(out, &length);

    NEED(header, STATUS_MEMORY, "%s: no memory to read it", path);
    NEED(!lines || json_is_array(lines), STATUS_FORMAT, "%s: header: expected a list of strings",
         path);
    json_array_foreach(lines, i, line)
    {
        NEED(json_is_string(line), STATUS_FORMAT, "%s: header: expected a list of strings", path);
        fprintf(header, "%s\n", json_string_value(line));
    }
out:
    if (header) fclose(header);
    return rc;
}

/* Reads the object and the line end behind it: the number keys in any order, the header. */
static status read_object(atmosphere *a, contents *file, const char *path)
{
    status rc = STATUS_OK;
    json_error_t error;
    number_key keys[NUMBER_KEYS];
    json_t *object = json_loadb(file->next, (size_t)(file->end - file->next),
                                JSON_REJECT_DUPLICATES | JSON_DISABLE_EOF_CHECK, &error);

    NEED(object, STATUS_FORMAT, "%s:%d: %s, expected a JSON object", path, 1 + error.line,
         error.text);
    file->next += error.position;
    NEED(*file->next == '\n', STATUS_FORMAT, "%s: expected a line end behind the JSON object",
         path);
    file->next++;
    list_numbers(a, keys);
    for (int i = 0; i < NUMBER_KEYS; i++) {
        const json_t *value = json_object_get(object, keys[i].name);
        NEED(value || i >= REQUIRED_KEYS, STATUS_FORMAT, "%s: the key %s is missing", path,
             keys[i].name);
        if (!value) continue;
        NEED(json_is_number(value), STATUS_FORMAT, "%s: %s: expected a number", path, keys[i].name);
        TRY(take_number(&keys[i], json_number_value(value), path));
    }
    TRY(read_header(&a->header, json_object_get(object, "header"), path));
out:
    json_decref(object);
    return rc;
}

/* The file's size tells whether the counts can be true before anything is allocated. */
static status check_size(const block *blocks, const contents *file, const char *path)
{
    status rc = STATUS_OK;
    const size_t bytes = (size_t)(file->end - file->next);
    double expected = 0.0;

    for (int i = 0; i < ARRAYS; i++) expected += (double)(blocks[i].size * sizeof(float));
    NEED((double)bytes == expected, STATUS_FORMAT,
         "%s: found %zu bytes of numbers, expected %.0f by the counts", path, bytes, expected);
out:
    return rc;
}

static status read_block(const block *b, int number, contents *file, const char *path)
{
    status rc = STATUS_OK;

    if (!b->size) goto out;
    TRY(interrupt_check());
    *b->at = malloc(b->size * sizeof **b->at);
    NEED(*b->at, STATUS_MEMORY, "%s: no memory to read it", path);
    for (size_t i = 0; i < b->size; i++, file->next += sizeof(float)) {
        float value;
        memcpy(&value, file->next, sizeof value);
        NEED((double)value >= b->low && (double)value <= b->high, STATUS_FORMAT,
             "%s: value %zu of array %d is %g, expected %g to %g", path, i + 1, number + 1,
             (double)value, b->low, b->high);
        (*b->at)[i] = (double)value;
    }
out:
    return rc;
}

/* Whether the grids are those of a database, and the spectral one written out. */
static status set_grids(atmosphere *a, const char *path)
{
    status rc = STATUS_OK;
    const size_t n = (size_t)a->point_count;
    const double last = a->path_zenith_first_deg + (a->path_count - 1) * a->path_zenith_step_deg;

    NEED(a->wavenumber_min_cm1 >= 100.0 && a->wavenumber_max_cm1 <= 50000.0 &&
             fabs(a->wavenumber_max_cm1 - a->wavenumber_min_cm1 -
                  (a->point_count - 1) * a->wavenumber_step_cm1) < .01,
         STATUS_FORMAT, "%s: wavenumber_min_cm1, _max_cm1, _step_cm1 and point_count do not fit",
         path);
    NEED(a->path_zenith_first_deg >= 0.0 && a->path_zenith_step_deg > 0.0 && last <= 90.0,
         STATUS_FORMAT, "%s: the path's zenith angles leave 0 to 90", path);
    NEED(a->path_zenith_meaningful_deg >= a->path_zenith_first_deg, STATUS_FORMAT,
         "%s: path_zenith_meaningful_deg is %g, expected it from path_zenith_first_deg, %g", path,
         a->path_zenith_meaningful_deg, a->path_zenith_first_deg);
    NEED(a->zenith_count > 1 && fabs((a->zenith_count - 1) * a->zenith_step_deg - 90.0) < 1e-3 &&
             (a->azimuth_count == 1 ||
              fabs((a->azimuth_count - 1) * a->azimuth_step_deg - 360.0) < 1e-3),
         STATUS_FORMAT, "%s: the sky's angles do not fill 0 to 90 and 0 to 360", path);
    a->wavelength_min_um = 1e4 / a->wavenumber_max_cm1;
    a->wavelength_max_um = 1e4 / a->wavenumber_min_cm1;
    a->wavelength_um = malloc(n * sizeof(double));
    a->wavenumber_cm1 = malloc(n * sizeof(double));
    NEED(a->wavelength_um && a->wavenumber_cm1, STATUS_MEMORY, "%s: no memory to read it", path);
    for (int i = 0; i < a->point_count; i++) {
        a->wavenumber_cm1[i] = a->wavenumber_max_cm1 - i * a->wavenumber_step_cm1;
        a->wavelength_um[i] = 1e4 / a->wavenumber_cm1[i];
    }
out:
    return rc;
}

/* Whether the grids of targets fit what renders hold, and lie between ground and sensor. */
static status check_targets(const atmosphere *a, const char *path)
{
    status rc = STATUS_OK;
    const int most = (int)AIR_STEPS - 2, last = a->target_count - 1;

    NEED(a->target_count <= most && a->range_count <= most, STATUS_FORMAT,
         "%s: target_count is %d and range_count %d, expected %d or fewer", path, a->target_count,
         a->range_count, most);
    NEED(last < 0 || (a->target_altitude_m[0] > a->level_altitude_m[0] &&
                      a->target_altitude_m[last] < a->sensor_altitude_m),
         STATUS_FORMAT, "%s: target_altitude_m is %g to %g m, expected between ground and sensor",
         path, last < 0 ? 0.0 : a->target_altitude_m[0],
         last < 0 ? 0.0 : a->target_altitude_m[last]);
    NEED(a->range_count == 0 || a->range_m[0] > 0.0, STATUS_FORMAT,
         "%s: range_m begins at %g, expected above 0", path, a->range_count ? a->range_m[0] : 0.0);
out:
    return rc;
}

static status check_rises(const double *values, int count, const char *name, const char *path)
{
    for (int i = 1; i < count; i++)
        if (values[i] <= values[i - 1])
            return status_set(STATUS_FORMAT, "%s: value %d of %s does not rise", path, i + 1, name);
    return STATUS_OK;
}

status atmosphere_container_read(atmosphere **out, const char *path)
{
    status rc = STATUS_OK;
    block blocks[ARRAYS];
    char message[1024], *text = NULL;
    size_t size;
    atmosphere *a = calloc(1, sizeof *a);

    NEED(a, STATUS_MEMORY, "%s: no memory to read it", path);
    cancel_ask(interrupt_is_set);
    NEED(!input_file_read(&text, &size, path, SIZE_MAX - 1, message, sizeof message), STATUS_FILE,
         "%s", message);
    NEED(!strncmp(text, magic, strlen(magic)), STATUS_FORMAT, "%s: expected a container", path);
    contents file = {text + strlen(magic), text + size};
    TRY(read_object(a, &file, path));
    list_blocks(a, blocks);
    TRY(check_size(blocks, &file, path));
    TRY(set_grids(a, path));
    for (int i = 0; i < ARRAYS; i++) TRY(read_block(&blocks[i], i, &file, path));
    TRY(check_rises(a->level_altitude_m, a->level_count, "level_altitude_m", path));
    TRY(check_rises(a->target_altitude_m, a->target_count, "target_altitude_m", path));
    TRY(check_rises(a->range_m, a->range_count, "range_m", path));
    TRY(check_targets(a, path));
    *out = a;
    a = NULL;
out:
    free(text);
    atmosphere_free(a);
    return rc;
}

/* Writes a value by itself and lets it go; false if there is none. */
static bool put(FILE *stream, json_t *value)
{
    if (!value) return false;
    json_dumpf(value, stream, JSON_ENCODE_ANY | JSON_REAL_PRECISION(10));
    json_decref(value);
    return true;
}

/* The lines of a text as a list, a string a line. */
static status write_header(FILE *stream, const char *header)
{
    status rc = STATUS_OK;
    char *line = NULL;

    fputs("\"header\": [\n", stream);
    while (*header) {
        const size_t length = strcspn(header, "\n");
        free(line);
        line = strndup(header, length);
        NEED(line && put(stream, json_text(line)), STATUS_MEMORY, "no memory for a header");
        header += length + (header[length] == '\n');
        fputs(*header ? ",\n" : "\n", stream);
    }
    fputs("]\n}\n", stream);
out:
    free(line);
    return rc;
}

static status write_object(FILE *stream, atmosphere *a)
{
    status rc = STATUS_OK;
    number_key keys[NUMBER_KEYS];

    list_numbers(a, keys);
    fputs(magic, stream);
    fputs("{\n\"units\": \"W m-2 sr-1 um-1, W m-2 um-1\",\n", stream);
    for (int i = 0; i < NUMBER_KEYS; i++) {
        const double value = keys[i].number ? *keys[i].number : (double)*keys[i].count;
        if (i >= REQUIRED_KEYS && value == 0.0) continue;
        fprintf(stream, "\"%s\": ", keys[i].name);
        NEED(put(stream, json_text_number(value, NULL)), STATUS_MEMORY, "no memory for a header");
        fputs(",\n", stream);
    }
    fprintf(stream, "\"arrays\": \"float32, little-endian: %s%s%s\",\n", arrays_text,
            a->target_count ? target_text : "", a->range_count ? range_text : "");
    TRY(write_header(stream, a->header));
out:
    return rc;
}

status atmosphere_container_write(const atmosphere *a, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;
    block blocks[ARRAYS];
    atmosphere copy = *a; /* the lists point into it; nothing is changed */

    TRY(output_file_open(&file, path));
    TRY(write_object(output_file_stream(file), &copy));
    list_blocks(&copy, blocks);
    for (int i = 0; i < ARRAYS; i++)
        for (size_t k = 0; k < blocks[i].size; k++) {
            const float value = (float)(*blocks[i].at)[k];
            fwrite(&value, sizeof value, 1, output_file_stream(file));
        }
    TRY(atmosphere_check_file(file));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}
