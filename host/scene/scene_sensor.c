#include "scene/scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const double FARTHEST_M = 1e9;

enum { BAND_LIMIT = 4096, SAMPLE_LIMIT = 1024 };

static void read_pixels(scene_table *t, view *camera)
{
    double pixels[2];

    if (!scene_table_whole_numbers(t, "pixels", 2, 1.0, VIEW_SIDE, pixels)) return;
    camera->columns = (int)pixels[0];
    camera->rows = (int)pixels[1];
}

/* [column, row, columns, rows] of the frame. */
static void read_crop(scene_table *t, view *camera)
{
    double part[4];

    if (!scene_table_whole_numbers(t, "crop", 4, 0.0, VIEW_SIDE, part)) return;
    for (int i = 0; i < 2; i++) {
        const int size = i ? camera->rows : camera->columns;
        if (part[2 + i] >= 1.0 && part[i] + part[2 + i] <= size) continue;
        scene_fail(t->reader, toml_node_get(t->node, "crop"),
                   "camera.crop: found [%g, %g, %g, %g], expected column and row, columns and rows "
                   "within %d x %d pixels",
                   part[0], part[1], part[2], part[3], camera->columns, camera->rows);
        return;
    }
    camera->crop = (view_crop){(int)part[0], (int)part[1], camera->columns, camera->rows};
    camera->columns = (int)part[2];
    camera->rows = (int)part[3];
}

static void read_projection(scene_table *t, view *camera)
{
    static const char *const projections[] = {"perspective", "orthographic"};
    int projection = 0;

    scene_table_word(t, "projection", projections, 2, &projection);
    if (projection == 1) {
        scene_table_require(t, "width_m", "what the columns span, m");
        scene_table_number(t, "width_m", 1e-3, FARTHEST_M, &camera->width_m);
        return;
    }
    if (!(camera->focal_length_mm > 0.0))
        scene_table_require(t, "focal_length_mm", "the lens of a 35 mm camera, mm");
    scene_table_number(t, "focal_length_mm", 1.0, 1e7, &camera->focal_length_mm);
}

void scene_read_camera(scene_reader *reader)
{
    scene_table t = scene_table_open(reader, toml_node_get(reader->root, "camera"), "camera");
    view *camera = &reader->s->camera;
    const int failures = reader->failure_count;
    const char *path;

    if (scene_table_has(&t, "view")) {
        if (scene_table_file(&t, "view", &path)) scene_took(reader, view_read(camera, path));
    } else {
        scene_table_require(&t, "position_m", "[east, north, up], or view = a .adv file");
        scene_table_require(&t, "target_m", "[east, north, up]");
        scene_table_require(&t, "pixels", "[columns, rows]");
    }
    scene_table_numbers(&t, "position_m", 3, -FARTHEST_M, FARTHEST_M, camera->position_m);
    scene_table_numbers(&t, "target_m", 3, -FARTHEST_M, FARTHEST_M, camera->target_m);
    read_projection(&t, camera);
    scene_table_number(&t, "twist_deg", -360.0, 360.0, &camera->twist_deg);
    read_pixels(&t, camera);
    read_crop(&t, camera);
    scene_table_close(&t);
    if (t.node && reader->failure_count == failures &&
        !memcmp(camera->position_m, camera->target_m, sizeof camera->target_m))
        scene_fail(reader, t.node, "camera: position and target are the same point");
}

static void read_band_edges(scene_table *t, band *b)
{
    double edges[2];

    if (!scene_table_numbers(t, "wavelength_um", 2, .2, 50.0, edges)) return;
    b->low_um = edges[0];
    b->high_um = edges[1];
    if (!(edges[0] < edges[1]))
        scene_fail(t->reader, toml_node_get(t->node, "wavelength_um"),
                   "%s.wavelength_um: found [%g, %g], expected the low edge first",
                   toml_node_name(t->node), edges[0], edges[1]);
}

static void read_gaussian(scene_table *t, band *b)
{
    double centre_um = 0.0, fwhm_um = 0.0;

    scene_table_require(t, "centre_um", "um, where the response is 1");
    scene_table_require(t, "fwhm_um", "um, the full width at half maximum");
    if (!scene_table_number(t, "centre_um", .2, 50.0, &centre_um)) return;
    if (!scene_table_number(t, "fwhm_um", 1e-4, 20.0, &fwhm_um)) return;
    if (centre_um - 2.0 * fwhm_um < .2)
        scene_fail(t->reader, toml_node_get(t->node, "fwhm_um"),
                   "%s.fwhm_um: found %g, 2 of which below %g um lie below .2 um",
                   toml_node_name(t->node), fwhm_um, centre_um);
    else
        scene_took(t->reader, response_gaussian(&b->tabulated, centre_um, fwhm_um));
}

/* Reads the one way in which the table states the response. */
static void read_response(scene_table *t, band *b)
{
    static const char *const ways[] = {"wavelength_um", "response", "centre_um", "sensor"};
    const char *path;
    int found = 0;

    for (size_t i = 0; i < sizeof ways / sizeof *ways; i++) found += scene_table_has(t, ways[i]);
    if (found != 1)
        scene_fail(t->reader, t->node,
                   "%s: expected one of wavelength_um = [low, high], response = a .csv file, "
                   "centre_um with fwhm_um, sensor = a .sen file",
                   toml_node_name(t->node));
    if (scene_table_has(t, "centre_um")) read_gaussian(t, b);
    if (scene_table_file(t, "response", &path))
        scene_took(t->reader, response_read(&b->tabulated, path));
    if (scene_table_file(t, "sensor", &path))
        scene_took(t->reader, response_file_read(&b->sensor, path));
    read_band_edges(t, b);
    if (b->tabulated) {
        b->low_um = b->tabulated->wavelength_um[0];
        b->high_um = b->tabulated->wavelength_um[b->tabulated->count - 1];
    }
}

static const char *read_band_name(scene_table *t)
{
    const char *name = "";

    scene_table_require(t, "name", "a name for the band's planes");
    scene_table_name(t, "name", " ,{}[]/\\", "a word without blanks , { } [ ] /", &name);
    return name;
}

static long read_count(scene_table *t, const band *b)
{
    const toml_node *node = toml_node_get(t->node, "count");
    double count = 1.0;

    if (!scene_table_whole(t, "count", 1.0, BAND_LIMIT, &count)) return 1;
    if (b->tabulated || b->sensor)
        scene_fail(t->reader, node, "%s: found %g, expected it beside wavelength_um",
                   toml_node_name(node), count);
    return (long)count;
}

/* Adds a band that owns what `b` owns; there is room for it. */
static void add_band(scene_reader *reader, const toml_node *node, band b, const char *name)
{
    scene *s = reader->s;

    for (uint32_t i = 0; i < s->band_count; i++) {
        if (strcmp(s->bands[i].name, name)) continue;
        scene_fail(reader, node, "%s.name: there are two bands \"%s\"", toml_node_name(node), name);
        break;
    }
    b.name = strdup(name);
    if (b.name) {
        s->bands[s->band_count++] = b;
        return;
    }
    scene_took(reader, status_set(STATUS_MEMORY, "%s: no memory for the band", name));
    band_free(&b);
}

/* Cuts a band into bands of equal width: NAME_000, NAME_001 .. for 200 of them. */
static void add_series(scene_reader *reader, const toml_node *node, band b, const char *name,
                       long count)
{
    const double low_um = b.low_um, width_um = b.high_um - b.low_um;
    const int digits = snprintf(NULL, 0, "%ld", count - 1);
    char numbered[256];

    for (long i = 0; i < count; i++) {
        b.low_um = low_um + width_um * (double)i / (double)count;
        b.high_um = low_um + width_um * (double)(i + 1) / (double)count;
        snprintf(numbered, sizeof numbered, "%s_%0*ld", name, digits, i);
        add_band(reader, node, b, numbered);
    }
}

static void read_band(scene_reader *reader, const toml_node *node, uint32_t table)
{
    scene_table t = scene_table_open(reader, node, "band");
    band b = {.gain = 1.0, .table = table};
    const int failures = reader->failure_count;
    const char *name = read_band_name(&t);

    read_response(&t, &b);
    if (b.sensor) {
        b.gain = b.sensor->gain;
        b.offset = b.sensor->offset;
    }
    scene_table_number(&t, "gain", -1e30, 1e30, &b.gain);
    scene_table_number(&t, "offset", -1e30, 1e30, &b.offset);
    const long count = read_count(&t, &b);
    scene_table_close(&t);
    if ((long)reader->s->band_count + count > BAND_LIMIT)
        scene_fail(reader, node, "%s: is one of more than %d bands", toml_node_name(node),
                   BAND_LIMIT);
    if (reader->failure_count > failures)
        band_free(&b);
    else if (count > 1)
        add_series(reader, node, b, name, count);
    else
        add_band(reader, node, b, name);
}

void scene_read_bands(scene_reader *reader)
{
    scene *s = reader->s;
    const toml_node *list = toml_node_get(reader->root, "band");
    const size_t count = list && toml_node_kind(list) == TOML_ARRAY ? toml_node_count(list) : 0;

    if (count == 0 || count > BAND_LIMIT) {
        scene_fail(reader, list,
                   "[[band]]: expected one to %d of them, each with a name and "
                   "wavelength_um = [low, high]",
                   BAND_LIMIT);
        return;
    }
    s->bands = calloc(BAND_LIMIT, sizeof *s->bands);
    if (!s->bands) {
        scene_took(reader, status_set(STATUS_MEMORY, "no memory for %zu bands", count));
        return;
    }
    for (size_t i = 0; i < count; i++) read_band(reader, toml_node_at(list, i), (uint32_t)i);
}

static void read_step(scene_table *t, const char *key, double range_deg, double *out)
{
    const toml_node *node = toml_node_get(t->node, key);
    double step_deg;

    if (!scene_table_number(t, key, .5, range_deg, &step_deg)) return;
    if (fabs(remainder(range_deg, step_deg)) < 1e-6 * range_deg)
        *out = step_deg;
    else
        scene_fail(t->reader, node, "%s: found %g, expected a divisor of %g", toml_node_name(node),
                   step_deg, range_deg);
}

static void read_hemisphere(scene_reader *reader, const toml_node *node)
{
    scene_table t = scene_table_open(reader, node, "render.hemisphere_step_deg");

    scene_table_require(&t, "zenith", "degrees, a divisor of 90");
    scene_table_require(&t, "azimuth", "degrees, a divisor of 360");
    read_step(&t, "zenith", 90.0, &reader->s->hemisphere_zenith_step_deg);
    read_step(&t, "azimuth", 360.0, &reader->s->hemisphere_azimuth_step_deg);
    scene_table_close(&t);
}

static void read_samples(scene_table *t)
{
    scene *s = t->reader->s;
    const toml_node *node = toml_node_get(t->node, "samples_per_pixel");
    double samples = 1.0, seed = 0.0;

    s->samples_per_side = 1;
    if (scene_table_whole(t, "seed", 0.0, UINT32_MAX, &seed)) s->seed = (uint32_t)seed;
    if (!scene_table_whole(t, "samples_per_pixel", 1.0, SAMPLE_LIMIT, &samples)) return;
    s->samples_per_side = (uint32_t)lround(sqrt(samples));
    if (s->samples_per_side * s->samples_per_side != (uint32_t)samples)
        scene_fail(t->reader, node, "%s: found %g, expected a square number: 1, 4, 9 .. %d",
                   toml_node_name(node), samples, SAMPLE_LIMIT);
}

void scene_read_render(scene_reader *reader)
{
    static const char *const modes[] = {"exact", "thesis"};
    static const char *const thermals[] = {"fixed", "therm", "layered"};
    static const char *const radiances[] = {"band", "mean"};
    scene *s = reader->s;
    scene_table t = scene_table_open(reader, toml_node_get(reader->root, "render"), "render");
    int mode = 0, thermal = SCENE_THERMAL_THERM, radiance = 0;
    double depth = 0.0;
    const toml_node *step = scene_table_node(&t, "hemisphere_step_deg");

    scene_table_word(&t, "mode", modes, 2, &mode);
    scene_table_word(&t, "thermal", thermals, 3, &thermal);
    scene_table_word(&t, "radiance", radiances, 2, &radiance);
    s->thesis = mode == 1;
    s->thermal = (scene_thermal)thermal;
    s->lateral_conduction = s->facet_longwave = true;
    scene_table_bool(&t, "lateral_conduction", &s->lateral_conduction);
    scene_table_bool(&t, "facet_longwave", &s->facet_longwave);
    s->hemisphere_zenith_step_deg = 15.0;
    s->hemisphere_azimuth_step_deg = 30.0;
    for (uint32_t i = 0; i < s->band_count; i++) s->bands[i].is_mean = radiance == 1;
    if (step) read_hemisphere(reader, step);
    if (scene_table_whole(&t, "depth", 1.0, 1000.0, &depth)) s->depth = (uint32_t)depth;
    read_samples(&t);
    scene_table_close(&t);
}
