#include "base/number.h"
#include "base/spelling.h"
#include "files/wavelength_column.h"
#include "meshio/input_file.h"
#include "spectrum/spectral_file.h"
#include "spectrum/spectral_series.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

enum { NAME_SIZE = 256, KEY_SIZE = 64 };

/* What the header states. */
typedef struct envi_header {
    char *path; /* of the header */
    int64_t channel_count, record_count, offset, data_type, byte_order;
    double scale; /* values are divided by it */
    const unit *unit;
    double *wavelength; /* shape (channel_count) */
    char *names;        /* of the records, with commas between; NULL: none */
    int names_line;
} envi_header;

static void free_header(envi_header *h)
{
    free(h->path);
    free(h->wavelength);
    free(h->names);
}

/* Takes the lines of a value in braces up to the closing one; the caller frees it. */
static status take_braces(char **out, const char *begin, record_file *file)
{
    status rc = STATUS_OK;
    char *text = strdup(begin);
    const char *line;

    NEED(text, STATUS_MEMORY, "no memory for a header");
    while (!strchr(text, '}')) {
        TRY(record_file_text(file, &line, "a closing brace"));
        char *longer = realloc(text, strlen(text) + strlen(line) + 2);
        NEED(longer, STATUS_MEMORY, "no memory for a header");
        text = longer;
        strcat(text, line);
    }
    *strchr(text, '}') = '\0';
    *out = text;
    text = NULL;
out:
    free(text);
    return rc;
}

static status take_wavelengths(envi_header *h, const char *text, const record_file *file)
{
    status rc = STATUS_OK;

    h->wavelength = malloc((size_t)h->channel_count * sizeof *h->wavelength + 1);
    NEED(h->wavelength, STATUS_MEMORY, "no memory for a header");
    if (record_numbers(text, (size_t)h->channel_count, h->wavelength) != (int)h->channel_count)
        rc = record_file_reject(file, "%d wavelengths, as many as samples before them",
                                (int)h->channel_count);
out:
    return rc;
}

static status take_whole(int64_t *out, const char *text, int64_t low, int64_t high,
                         const record_file *file)
{
    if (number_read_whole(text, low, high, out)) return STATUS_OK;
    return record_file_reject(file, "a whole number from %d to %d", (int)low, (int)high);
}

static status take_unit(envi_header *h, const char *text, const record_file *file)
{
    h->unit = !strcasecmp(text, "wavenumber") ? unit_find("cm-1", "wavenumber")
                                              : unit_find(text, "wavelength");
    return h->unit ? STATUS_OK : record_file_reject(file, "Micrometers, Nanometers or Wavenumber");
}

static status take_value(envi_header *h, const char *key, const char *text, record_file *file)
{
    status rc = STATUS_OK;
    char *braces = NULL;
    const int line = record_file_line(file);

    if (*text == '{') TRY(take_braces(&braces, text + 1, file));
    if (!strcasecmp(key, "samples")) TRY(take_whole(&h->channel_count, text, 1, 1 << 20, file));
    if (!strcasecmp(key, "lines")) TRY(take_whole(&h->record_count, text, 1, 1 << 24, file));
    if (!strcasecmp(key, "header offset")) TRY(take_whole(&h->offset, text, 0, 1 << 30, file));
    if (!strcasecmp(key, "data type")) TRY(take_whole(&h->data_type, text, 1, 15, file));
    if (!strcasecmp(key, "byte order")) TRY(take_whole(&h->byte_order, text, 0, 1, file));
    if (!strcasecmp(key, "wavelength units")) TRY(take_unit(h, text, file));
    if (!strcasecmp(key, "reflectance scale factor") && !number_read_list(text, 1, &h->scale))
        TRY(record_file_reject(file, "a number"));
    if (!strcasecmp(key, "wavelength") && braces) TRY(take_wavelengths(h, braces, file));
    if (!strcasecmp(key, "spectra names") && braces) {
        free(h->names);
        h->names = braces;
        h->names_line = line;
        braces = NULL;
    }
out:
    free(braces);
    return rc;
}

/* Splits `key = value`; false for other lines. */
static bool split(const char *line, char key[KEY_SIZE], const char **out_text)
{
    const char *equals = strchr(line, '=');
    size_t length = equals ? (size_t)(equals - line) : 0;

    while (length > 0 && isspace((unsigned char)line[length - 1])) length--;
    if (length == 0 || length >= KEY_SIZE) return false;
    snprintf(key, KEY_SIZE, "%.*s", (int)length, line);
    for (equals++; isspace((unsigned char)*equals);) equals++;
    *out_text = equals;
    return true;
}

static status read_header(envi_header *h, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    const char *line, *text;
    char key[KEY_SIZE];

    TRY(record_file_open(&file, path));
    TRY(record_file_text(file, &line, "ENVI"));
    if (strcmp(line, "ENVI") != 0) {
        rc = record_file_reject(file, "ENVI");
        goto out;
    }
    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &line, "a key and its value"));
        if (split(line, key, &text)) TRY(take_value(h, key, text, file));
    }
    if (!h->wavelength || !h->unit || !h->record_count || !h->data_type)
        rc = record_file_reject(file,
                                "samples, lines, data type, wavelength units and wavelength before "
                                "the end of the header");
out:
    record_file_free(file);
    return rc;
}

/* Copies the next name of a list; returns what follows it, NULL at its end. */
static const char *next_name(const char *list, char name[NAME_SIZE])
{
    const size_t length = strcspn(list, ",");
    const char *begin = list, *end = list + length;

    while (begin < end && isspace((unsigned char)*begin)) begin++;
    while (end > begin && isspace((unsigned char)end[-1])) end--;
    snprintf(name, NAME_SIZE, "%.*s", (int)(end - begin), begin);
    return list[length] ? list + length + 1 : NULL;
}

/* Finds the record of a name; the only one where none is asked for. */
static status find_record(int64_t *out, const envi_header *h, const char *wanted)
{
    status rc = STATUS_OK;
    char name[NAME_SIZE], nearest[NAME_SIZE] = "";
    size_t best = SIZE_MAX;
    int64_t index = 0;

    NEED(wanted || h->record_count == 1, STATUS_FORMAT,
         "%s:%d: found %d records, expected record, the name of one of them", h->path,
         h->names_line, (int)h->record_count);
    *out = 0;
    if (!wanted) goto out;
    for (const char *left = h->names; left; index++) {
        left = next_name(left, name);
        if (!strcmp(name, wanted) && index < h->record_count) {
            *out = index;
            goto out;
        }
        const size_t distance = spelling_distance(name, wanted);
        if (distance >= best) continue;
        best = distance;
        strcpy(nearest, name);
    }
    rc = status_set(STATUS_FORMAT,
                    "%s:%d: found no record '%s', expected one of spectra names, such as '%s'",
                    h->path, h->names_line, wanted, nearest);
out:
    return rc;
}

/* Bytes of a value of ENVI's data types; 0: it is none that spectra have. */
static size_t value_size(int64_t data_type)
{
    static const size_t sizes[16] = {
        [1] = 1, [2] = 2, [3] = 4, [4] = 4, [5] = 8, [12] = 2, [13] = 4};

    return sizes[data_type];
}

/* The program runs where the lowest byte comes first. */
static double value_at(const unsigned char *bytes, const envi_header *h)
{
    const size_t size = value_size(h->data_type);
    union {
        unsigned char byte[8];
        int16_t i16;
        uint16_t u16;
        int32_t i32;
        uint32_t u32;
        float f32;
        double f64;
    } value = {{0}};

    for (size_t i = 0; i < size; i++) value.byte[i] = bytes[h->byte_order ? size - 1 - i : i];
    switch (h->data_type) {
    case 1:
        return value.byte[0];
    case 2:
        return value.i16;
    case 3:
        return value.i32;
    case 4:
        return (double)value.f32;
    case 5:
        return value.f64;
    case 12:
        return value.u16;
    default:
        return value.u32;
    }
}

static status read_record(spectral_series *s, const envi_header *h, int64_t record,
                          const char *path)
{
    status rc = STATUS_OK;
    char message[1024], *bytes = NULL;
    size_t size;
    const size_t each = value_size(h->data_type), row = (size_t)h->channel_count * each;

    NEED(each > 0, STATUS_FORMAT, "%s: found data type %d, expected 1, 2, 3, 4, 5, 12 or 13",
         h->path, (int)h->data_type);
    NEED(input_file_read(&bytes, &size, path, INPUT_FILE_TEXT_LIMIT, message, sizeof message) == 0,
         STATUS_FILE, "%s", message);
    NEED(size >= (size_t)h->offset + (size_t)h->record_count * row, STATUS_FORMAT,
         "%s: found %zu bytes, expected %zu, as its header states", path, size,
         (size_t)h->offset + (size_t)h->record_count * row);
    for (int64_t i = 0; i < h->channel_count; i++) {
        const double value = value_at(
            (const unsigned char *)bytes + h->offset + (size_t)record * row + (size_t)i * each, h);
        TRY(spectral_series_add(
            s, (spectral_point){h->wavelength[i], isfinite(value) ? value : -HUGE_VAL, 0.0, 0}));
    }
out:
    free(bytes);
    return rc;
}

/* The path without its ending, and another one; the caller frees it. */
static char *path_with(const char *path, const char *ending)
{
    const size_t stem = strlen(path) - 4;
    char *made = malloc(stem + strlen(ending) + 1);

    if (made) sprintf(made, "%.*s%s", (int)stem, path, ending);
    return made;
}

status envi_library_read(spectral_curve **out, const spectral_source *source)
{
    status rc = STATUS_OK;
    envi_header h = {.scale = 1.0, .path = path_with(source->path, ".hdr")};
    char *binary = path_with(source->path, ".sli");
    int64_t record;
    spectral_series s = {.path = binary, .is_sampled = true, .quantity = SPECTRAL_REFLECTANCE};

    NEED(h.path && binary, STATUS_MEMORY, "%s: no memory to read it", source->path);
    TRY(read_header(&h, h.path));
    TRY(find_record(&record, &h, source->record));
    s.unit = h.unit;
    s.scale = 1.0 / h.scale;
    TRY(read_record(&s, &h, record, binary));
    TRY(spectral_series_finish(out, &s));
out:
    spectral_series_free(&s);
    free_header(&h);
    free(binary);
    return rc;
}
