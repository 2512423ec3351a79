#include "scene_parts.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double FARTHEST_M = 1e9;

enum { PIXEL_LIMIT = 1 << 20, BAND_LIMIT = 4096 };

static void read_pixels(scene_table *t, view *camera)
{
    double pixels[2];

    if (!scene_table_numbers(t, "pixels", 2, 1.0, PIXEL_LIMIT, pixels)) return;
    camera->columns = (int)pixels[0];
    camera->rows = (int)pixels[1];
    if (pixels[0] != floor(pixels[0]) || pixels[1] != floor(pixels[1]))
        scene_fail(t->reader, toml_node_get(t->node, "pixels"),
                   "camera.pixels: expected whole numbers, columns and rows");
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
        scene_table_require(&t, "focal_length_mm", "the lens of a 35 mm camera, mm");
        scene_table_require(&t, "pixels", "[columns, rows]");
    }
    scene_table_numbers(&t, "position_m", 3, -FARTHEST_M, FARTHEST_M, camera->position_m);
    scene_table_numbers(&t, "target_m", 3, -FARTHEST_M, FARTHEST_M, camera->target_m);
    scene_table_number(&t, "focal_length_mm", 1.0, 1e7, &camera->focal_length_mm);
    scene_table_number(&t, "twist_deg", -360.0, 360.0, &camera->twist_deg);
    read_pixels(&t, camera);
    scene_table_close(&t);
    if (t.node && reader->failure_count == failures &&
        !memcmp(camera->position_m, camera->target_m, sizeof camera->target_m))
        scene_fail(reader, t.node, "camera: position and target are the same point");
}

static void read_band_edges(scene_table *t, band *b)
{
    double edges[2];

    scene_table_require(t, "wavelength_um", "[low, high], or sensor = a .sen file");
    if (!scene_table_numbers(t, "wavelength_um", 2, .2, 50.0, edges)) return;
    b->low_um = edges[0];
    b->high_um = edges[1];
    if (!(edges[0] < edges[1]))
        scene_fail(t->reader, toml_node_get(t->node, "wavelength_um"),
                   "%s.wavelength_um: found [%g, %g], expected the low edge first",
                   toml_node_name(t->node), edges[0], edges[1]);
}

static void read_band(scene_reader *reader, const toml_node *node, band *b)
{
    scene_table t = scene_table_open(reader, node, "band");
    const char *name = "", *path;

    scene_table_require(&t, "name", "a name for the band's planes");
    scene_table_string(&t, "name", &name);
    if (strcspn(name, " ,{}[]/\\\n") != strlen(name))
        scene_fail(reader, node,
                   "%s.name: found \"%s\", expected a word without blanks , { } [ ] /",
                   toml_node_name(node), name);
    for (const band *before = reader->s->bands; before < b; before++)
        if (!strcmp(before->name, name))
            scene_fail(reader, node, "%s.name: there are two bands \"%s\"", toml_node_name(node),
                       name);
    b->name = strdup(name);
    b->gain = 1.0;
    if (scene_table_has(&t, "sensor")) {
        if (scene_table_file(&t, "sensor", &path) &&
            scene_took(reader, sensor_read(&b->response, path))) {
            b->gain = b->response->gain;
            b->offset = b->response->offset;
        }
    } else {
        read_band_edges(&t, b);
    }
    scene_table_number(&t, "gain", -1e30, 1e30, &b->gain);
    scene_table_number(&t, "offset", -1e30, 1e30, &b->offset);
    scene_table_close(&t);
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
    s->bands = calloc(count, sizeof *s->bands);
    if (!s->bands) {
        scene_fail(reader, list, "no memory for %zu bands", count);
        return;
    }
    for (size_t i = 0; i < count; i++) {
        read_band(reader, toml_node_at(list, i), &s->bands[i]);
        s->band_count++;
    }
}

static void read_hemisphere(scene_reader *reader, const toml_node *node)
{
    scene_table t = scene_table_open(reader, node, "render.hemisphere_step_deg");

    scene_table_require(&t, "zenith", "degrees, a divisor of 90");
    scene_table_require(&t, "azimuth", "degrees, a divisor of 360");
    scene_table_number(&t, "zenith", .5, 90.0, &reader->s->hemisphere_zenith_step_deg);
    scene_table_number(&t, "azimuth", .5, 360.0, &reader->s->hemisphere_azimuth_step_deg);
    scene_table_close(&t);
}

void scene_read_render(scene_reader *reader)
{
    static const char *const modes[] = {"exact", "thesis"};
    static const char *const thermals[] = {"fixed", "therm", "layered"};
    static const char *const radiances[] = {"band", "mean"};
    scene *s = reader->s;
    scene_table t = scene_table_open(reader, toml_node_get(reader->root, "render"), "render");
    int mode = 0, thermal = SCENE_THERMAL_THERM, radiance = 0;
    const toml_node *step = scene_table_node(&t, "hemisphere_step_deg");

    scene_table_word(&t, "mode", modes, 2, &mode);
    scene_table_word(&t, "thermal", thermals, 3, &thermal);
    scene_table_word(&t, "radiance", radiances, 2, &radiance);
    s->thesis = mode == 1;
    s->thermal = (scene_thermal)thermal;
    s->hemisphere_zenith_step_deg = 15.0;
    s->hemisphere_azimuth_step_deg = 30.0;
    for (uint32_t i = 0; i < s->band_count; i++) s->bands[i].is_mean = radiance == 1;
    if (step) read_hemisphere(reader, step);
    scene_table_close(&t);
}
