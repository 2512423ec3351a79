#include "render/render_summary.h"

#include "base/clock.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { STAGE_LIMIT = 256, DEVICE_TEXT = 1024, SETTING_COUNT = 7 };

typedef struct lists {
    render_report_band *bands;
    image_plane *planes;
    size_t plane_count;
    render_report_input *inputs;
    const char **spectra;
    render_report_stage stages[STAGE_LIMIT];
    size_t stage_count;
    char names[STAGE_LIMIT][64];
} lists;

static void list_bands(lists *l, const scene *s)
{
    const atmosphere *air = s->air;

    for (uint32_t i = 0; i < s->band_count; i++) {
        const band *b = &s->bands[i];
        l->bands[i] = (render_report_band){
            b->name, b->sensor ? air->wavelength_um[0] : b->low_um,
            b->sensor ? air->wavelength_um[air->point_count - 1] : b->high_um, b->gain, b->offset};
    }
}

static void list_inputs(lists *l, const scene *s)
{
    for (size_t i = 0; i < s->input_count; i++)
        l->inputs[i] = (render_report_input){s->inputs[i].name, s->inputs[i].hash};
}

static void add_stage(lists *l, const char *label, const char *name, double seconds)
{
    if (l->stage_count == STAGE_LIMIT) return;
    char *text = l->names[l->stage_count];
    snprintf(text, sizeof l->names[0], "%s%s", label, name);
    l->stages[l->stage_count++] = (render_report_stage){text, seconds};
}

static status list_stages(lists *l, const render_summary *summary)
{
    status rc = STATUS_OK;
    const device_time *times;
    char label[64] = "kernel ";
    size_t count;
    const render_stage *stages = render_stages(render_pool_render(summary->pool), &count);
    device *dev;

    for (size_t i = 0; i < count; i++) add_stage(l, "host ", stages[i].name, stages[i].seconds);
    for (size_t d = 0; (dev = render_pool_device(summary->pool, d)); d++) {
        if (d > 0) snprintf(label, sizeof label, "device %u kernel ", device_describe(dev)->index);
        TRY(device_times(dev, &times, &count));
        for (size_t i = 0; i < count; i++)
            if (times[i].launches) add_stage(l, label, times[i].kernel, times[i].seconds);
    }
    add_stage(l, "", "all but reading", clock_now_s() - summary->start_s);
out:
    return rc;
}

static status gather(lists *l, const render_summary *summary)
{
    status rc = STATUS_OK;
    const scene *s = summary->s;

    l->bands = calloc(s->band_count, sizeof *l->bands);
    const size_t sensor_count = summary->sensor ? image_plane_count(summary->sensor) : 0;

    l->planes = calloc(summary->plane_count + sensor_count, sizeof *l->planes);
    l->inputs = calloc(s->input_count + 1, sizeof *l->inputs);
    l->spectra = calloc(s->material_count + 1, sizeof *l->spectra);
    NEED(l->bands && l->planes && l->inputs && l->spectra, STATUS_MEMORY,
         "no memory for the report");
    list_bands(l, s);
    list_inputs(l, s);
    for (uint32_t i = 0; i < s->material_count; i++) l->spectra[i] = s->materials[i].spectrum;
    for (size_t i = 0; i < summary->plane_count; i++)
        if (summary->values[i]) l->planes[l->plane_count++] = summary->planes[i].plane;
    for (size_t i = 0; i < sensor_count; i++)
        l->planes[l->plane_count++] = *image_plane_at(summary->sensor, i);
    TRY(list_stages(l, summary));
out:
    return rc;
}

/* Adds to a list with commas between; what does not fit is cut. */
static void append(char list[DEVICE_TEXT], const char *text)
{
    const size_t length = strlen(list);

    snprintf(list + length, DEVICE_TEXT - length, "%s%s", length ? ", " : "", text);
}

status render_summary_write(output_folder *folder, const char *name, const render_summary *summary)
{
    status rc = STATUS_OK;
    const scene *s = summary->s;
    char platform[DEVICE_TEXT] = "", device_name[DEVICE_TEXT] = "", version[DEVICE_TEXT] = "";
    char time[SITE_TIME_SIZE];
    lists l = {0};
    device *dev;
    const render_report_setting settings[SETTING_COUNT] = {
        {"hemisphere_step_deg.zenith", NULL, s->hemisphere_zenith_step_deg},
        {"hemisphere_step_deg.azimuth", NULL, s->hemisphere_azimuth_step_deg},
        {"radiance", s->bands[0].is_mean ? "mean" : "band", 0.0},
        {"samples_per_pixel", NULL, (double)s->samples_per_side * s->samples_per_side},
        {"seed", NULL, s->seed},
        {"sensor.seed", NULL, s->sensor.seed},
        {"sensor.frame", NULL, s->sensor.frame}};

    site_format_time(s->place.time_s, s->place.utc_offset_min, time);
    for (size_t d = 0; (dev = render_pool_device(summary->pool, d)); d++) {
        append(platform, device_describe(dev)->platform);
        append(device_name, device_describe(dev)->name);
        append(version, device_describe(dev)->version);
    }
    TRY(gather(&l, summary));
    const render_report report = {
        .scene = s->name,
        .scene_path = summary->scene_path,
        .mode = s->thesis ? "thesis" : "exact",
        .thermal = scene_thermal_name(s->thermal),
        .time = time,
        .latitude_deg = s->place.latitude_deg,
        .longitude_deg = s->place.longitude_deg,
        .platform = platform,
        .device = device_name,
        .device_version = version,
        .columns = (uint32_t)s->camera.columns,
        .rows = (uint32_t)s->camera.rows,
        .band = l.bands,
        .band_count = s->band_count,
        .plane = l.planes,
        .plane_count = l.plane_count,
        .material = summary->materials,
        .material_count = s->material_count,
        .spectrum = l.spectra,
        .setting = settings,
        .setting_count = summary->sensor ? SETTING_COUNT : SETTING_COUNT - 2,
        .input = l.inputs,
        .input_count = s->input_count,
        .warnings = status_warnings_so_far(),
        .stage = l.stages,
        .stage_count = l.stage_count,
    };
    TRY(render_report_write(folder, name, &report));
out:
    free(l.bands);
    free(l.planes);
    free(l.inputs);
    free(l.spectra);
    return rc;
}
