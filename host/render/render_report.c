#include "render/render_report.h"

#include "files/json_text.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { LEAST_DIGITS = 15 };

/* Adds a value; where memory ends the list becomes NULL, and so does all that is made of it. */
static void append(json_t **list, json_t *value)
{
    if (json_array_append_new(*list, value) == 0) return;
    json_decref(*list);
    *list = NULL;
}

static void set(json_t **object, const char *key, json_t *value)
{
    if (json_object_set_new(*object, key, value) == 0) return;
    json_decref(*object);
    *object = NULL;
}

static json_t *site_of(const render_report *report, size_t *digits)
{
    json_t *object = json_object();

    set(&object, "latitude_deg", json_text_number(report->latitude_deg, digits));
    set(&object, "longitude_deg", json_text_number(report->longitude_deg, digits));
    set(&object, "altitude_m", json_text_number(report->altitude_m, digits));
    return object;
}

static json_t *device_of(const render_report *report)
{
    return json_pack("{s:o, s:o, s:o}", "platform", json_text(report->platform), "name",
                     json_text(report->device), "version", json_text(report->device_version));
}

static json_t *bands_of(const render_report *report, size_t *digits)
{
    json_t *list = json_array();

    for (size_t i = 0; i < report->band_count; i++) {
        const render_report_band *band = &report->band[i];
        json_t *object = json_object();
        set(&object, "name", json_text(band->name));
        set(&object, "wavelength_min_um", json_text_number(band->wavelength_min_um, digits));
        set(&object, "wavelength_max_um", json_text_number(band->wavelength_max_um, digits));
        set(&object, "gain", json_text_number(band->gain, digits));
        set(&object, "offset", json_text_number(band->offset, digits));
        append(&list, object);
    }
    return list;
}

static json_t *planes_of(const render_report *report)
{
    json_t *list = json_array();

    for (size_t i = 0; i < report->plane_count; i++) {
        const image_plane *plane = &report->plane[i];
        const char *unit = plane->unit && plane->unit[0] ? plane->unit : NULL;
        append(&list,
               json_pack("{s:o, s:o}", "name", json_text(plane->name), "unit", json_text(unit)));
    }
    return list;
}

static json_t *materials_of(const render_report *report)
{
    json_t *list = json_array();

    for (size_t i = 0; i < report->material_count; i++) {
        const image_label *material = &report->material[i];
        json_t *object = json_pack("{s:I, s:o}", "number", (json_int_t)material->number, "name",
                                   json_text(material->name));
        if (report->spectrum && report->spectrum[i])
            set(&object, "spectrum", json_text(report->spectrum[i]));
        append(&list, object);
    }
    return list;
}

static json_t *settings_of(const render_report *report, size_t *digits)
{
    json_t *object = json_object();

    for (size_t i = 0; i < report->setting_count; i++) {
        const render_report_setting *setting = &report->setting[i];
        set(&object, setting->key,
            setting->text ? json_text(setting->text) : json_text_number(setting->number, digits));
    }
    return object;
}

static json_t *inputs_of(const render_report *report)
{
    json_t *list = json_array();

    for (size_t i = 0; i < report->input_count; i++) {
        const render_report_input *input = &report->input[i];
        append(&list, json_pack("{s:o, s:s, s:I}", "path", json_text(input->path), "sha256",
                                input->hash.sha256, "bytes", (json_int_t)input->hash.bytes));
    }
    return list;
}

/* A string a line. */
static json_t *warnings_of(const render_report *report)
{
    json_t *list = json_array();
    char *next = NULL, *copy = strdup(report->warnings ? report->warnings : "");

    if (!copy) append(&list, NULL);
    for (char *line = copy ? strtok_r(copy, "\n", &next) : NULL; line;
         line = strtok_r(NULL, "\n", &next))
        append(&list, json_text(line));
    free(copy);
    return list;
}

/* Seconds to a tenth of a millisecond. */
static json_t *timings_of(const render_report *report, size_t *digits)
{
    json_t *object = json_object();

    for (size_t i = 0; i < report->stage_count; i++) {
        const render_report_stage *stage = &report->stage[i];
        set(&object, stage->name, json_text_number(round(1e4 * stage->seconds) / 1e4, digits));
    }
    return object;
}

/* The whole document, its members in this order; NULL if memory ended.
 *   digits   raised to what its numbers need */
static json_t *document_of(const render_report *report, size_t *digits)
{
    json_t *object = json_object();

    set(&object, "program", json_string("radsig " RADSIG_VERSION));
    set(&object, "scene", json_text(report->scene));
    set(&object, "scene_path", json_text(report->scene_path));
    set(&object, "mode", json_text(report->mode));
    set(&object, "thermal", json_text(report->thermal));
    set(&object, "time", json_text(report->time));
    set(&object, "site", site_of(report, digits));
    set(&object, "device", device_of(report));
    set(&object, "image",
        json_pack("{s:I, s:I}", "columns", (json_int_t)report->columns, "rows",
                  (json_int_t)report->rows));
    set(&object, "bands", bands_of(report, digits));
    set(&object, "planes", planes_of(report));
    set(&object, "materials", materials_of(report));
    set(&object, "settings", settings_of(report, digits));
    set(&object, "inputs", inputs_of(report));
    set(&object, "warnings", warnings_of(report));
    set(&object, "timings_s", timings_of(report, digits));
    return object;
}

status render_report_write(output_folder *folder, const char *name, const render_report *report)
{
    status rc = STATUS_OK;
    output_file *file = NULL;
    size_t digits = LEAST_DIGITS;
    json_t *document = document_of(report, &digits);

    NEED(document, STATUS_MEMORY, "%s: no memory for the report", name);
    TRY(output_folder_add(folder, name, &file));
    json_dumpf(document, output_file_stream(file), JSON_INDENT(2) | JSON_REAL_PRECISION(digits));
    fputc('\n', output_file_stream(file));
    TRY(output_file_close(file));
out:
    json_decref(document);
    return rc;
}
