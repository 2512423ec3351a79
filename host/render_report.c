#include "render_report.h"

#include <errno.h>
#include <math.h>
#include <sha256.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>

/* The document being written; `depth` counts what is open. */
typedef struct json {
    FILE *file;
    int depth;
    bool empty; /* nothing stands yet in what was opened last */
} json;

/* Bytes of the UTF-8 character that begins here; 0 if none does. */
static size_t character_length(const unsigned char *text)
{
    const size_t length = text[0] < 0x80             ? 1
                          : (text[0] & 0xe0) == 0xc0 ? 2
                          : (text[0] & 0xf0) == 0xe0 ? 3
                          : (text[0] & 0xf8) == 0xf0 ? 4
                                                     : 0;

    for (size_t i = 1; i < length; i++)
        if ((text[i] & 0xc0) != 0x80) return 0;
    return length;
}

static void put_character(FILE *file, const unsigned char *text, size_t length)
{
    if (length == 0)
        fputs("\\ufffd", file);
    else if (text[0] == '"' || text[0] == '\\')
        fprintf(file, "\\%c", text[0]);
    else if (text[0] < ' ' || text[0] == 0x7f)
        fprintf(file, "\\u%04x", text[0]);
    else
        fwrite(text, 1, length, file);
}

static void put_string(FILE *file, const char *text)
{
    const unsigned char *byte = (const unsigned char *)text;

    if (!text) {
        fputs("null", file);
        return;
    }
    fputc('"', file);
    while (*byte) {
        const size_t length = character_length(byte);
        put_character(file, byte, length);
        byte += length ? length : 1;
    }
    fputc('"', file);
}

/* The fewest digits that read back as the same number. */
static void put_number(FILE *file, double value)
{
    char text[40];

    if (!isfinite(value)) {
        fputs("null", file);
        return;
    }
    for (int digits = 6; digits <= 17; digits++) {
        snprintf(text, sizeof text, "%.*g", digits, value);
        if (strtod(text, NULL) == value) break;
    }
    fputs(text, file);
}

/* Begins the next member of an object, or of an array if key is NULL. */
static void begin_member(json *to, const char *key)
{
    fprintf(to->file, "%s\n%*s", to->empty ? "" : ",", 2 * to->depth, "");
    to->empty = false;
    if (!key) return;
    put_string(to->file, key);
    fputs(": ", to->file);
}

static void open_group(json *to, const char *key, char mark)
{
    begin_member(to, key);
    fputc(mark, to->file);
    to->depth++;
    to->empty = true;
}

static void close_group(json *to, char mark)
{
    to->depth--;
    if (!to->empty) fprintf(to->file, "\n%*s", 2 * to->depth, "");
    fputc(mark, to->file);
    to->empty = false;
}

static void add_string(json *to, const char *key, const char *text)
{
    begin_member(to, key);
    put_string(to->file, text);
}

static void add_number(json *to, const char *key, double value)
{
    begin_member(to, key);
    put_number(to->file, value);
}

static void add_scene(json *to, const render_report *report)
{
    add_string(to, "program", "radsig " RADSIG_VERSION);
    add_string(to, "scene", report->scene);
    add_string(to, "scene_path", report->scene_path);
    add_string(to, "mode", report->mode);
    add_string(to, "thermal", report->thermal);
    add_string(to, "time", report->time);
    open_group(to, "site", '{');
    add_number(to, "latitude_deg", report->latitude_deg);
    add_number(to, "longitude_deg", report->longitude_deg);
    add_number(to, "altitude_m", report->altitude_m);
    close_group(to, '}');
    open_group(to, "device", '{');
    add_string(to, "platform", report->platform);
    add_string(to, "name", report->device);
    add_string(to, "version", report->device_version);
    close_group(to, '}');
    open_group(to, "image", '{');
    add_number(to, "columns", report->columns);
    add_number(to, "rows", report->rows);
    close_group(to, '}');
}

static void add_bands(json *to, const render_report *report)
{
    open_group(to, "bands", '[');
    for (size_t i = 0; i < report->band_count; i++) {
        const render_report_band *band = &report->band[i];
        open_group(to, NULL, '{');
        add_string(to, "name", band->name);
        add_number(to, "wavelength_min_um", band->wavelength_min_um);
        add_number(to, "wavelength_max_um", band->wavelength_max_um);
        add_number(to, "gain", band->gain);
        add_number(to, "offset", band->offset);
        close_group(to, '}');
    }
    close_group(to, ']');
}

static void add_planes(json *to, const render_report *report)
{
    open_group(to, "planes", '[');
    for (size_t i = 0; i < report->plane_count; i++) {
        const char *unit = report->plane[i].unit;
        open_group(to, NULL, '{');
        add_string(to, "name", report->plane[i].name);
        add_string(to, "unit", unit && unit[0] ? unit : NULL);
        close_group(to, '}');
    }
    close_group(to, ']');
    open_group(to, "materials", '[');
    for (size_t i = 0; i < report->material_count; i++) {
        open_group(to, NULL, '{');
        add_number(to, "number", report->material[i].number);
        add_string(to, "name", report->material[i].name);
        close_group(to, '}');
    }
    close_group(to, ']');
}

static void add_settings_and_inputs(json *to, const render_report *report)
{
    open_group(to, "settings", '{');
    for (size_t i = 0; i < report->setting_count; i++) {
        const render_report_setting *setting = &report->setting[i];
        if (setting->text)
            add_string(to, setting->key, setting->text);
        else
            add_number(to, setting->key, setting->number);
    }
    close_group(to, '}');
    open_group(to, "inputs", '[');
    for (size_t i = 0; i < report->input_count; i++) {
        const render_report_input *input = &report->input[i];
        open_group(to, NULL, '{');
        add_string(to, "path", input->path);
        add_string(to, "sha256", input->sha256);
        begin_member(to, "bytes");
        fprintf(to->file, "%llu", (unsigned long long)input->bytes);
        close_group(to, '}');
    }
    close_group(to, ']');
}

static status add_warnings(json *to, const char *warnings)
{
    status rc = STATUS_OK;
    char *next = NULL, *copy = strdup(warnings ? warnings : "");

    NEED(copy, STATUS_MEMORY, "no memory for the warnings");
    open_group(to, "warnings", '[');
    for (char *line = strtok_r(copy, "\n", &next); line; line = strtok_r(NULL, "\n", &next))
        add_string(to, NULL, line);
    close_group(to, ']');
out:
    free(copy);
    return rc;
}

static void add_timings(json *to, const render_report *report)
{
    open_group(to, "timings_s", '{');
    for (size_t i = 0; i < report->stage_count; i++) {
        begin_member(to, report->stage[i].name);
        fprintf(to->file, "%.4f", report->stage[i].seconds);
    }
    close_group(to, '}');
}

status render_report_write(output_folder *folder, const char *name, const render_report *report)
{
    status rc = STATUS_OK;
    output_file *place = NULL;
    json to = {.depth = 1, .empty = true};

    TRY(output_folder_add(folder, name, &place));
    to.file = output_file_stream(place);
    fputc('{', to.file);
    add_scene(&to, report);
    add_bands(&to, report);
    add_planes(&to, report);
    add_settings_and_inputs(&to, report);
    TRY(add_warnings(&to, report->warnings));
    add_timings(&to, report);
    fputs("\n}\n", to.file);
    TRY(output_file_close(place));
out:
    return rc;
}

status render_report_hash(const char *path, char out_sha256[65], uint64_t *out_bytes)
{
    status rc = STATUS_OK;
    struct stat found;

    NEED(stat(path, &found) == 0, STATUS_FILE, "%s: %s", path, strerror(errno));
    NEED(SHA256File(path, out_sha256), STATUS_FILE, "%s: %s", path, strerror(errno));
    *out_bytes = (uint64_t)found.st_size;
out:
    return rc;
}
