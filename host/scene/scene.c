#include "scene/scene.h"

#include "base/spelling.h"
#include "kernels/radiance/lobe.h"
#include "scene/scene_limits.h"
#include "scene/scene_parts.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void check_tables(scene_reader *reader)
{
    static const char *const known[] = {"name",     "site",    "weather",  "atmosphere",
                                        "geometry", "library", "material", "materials",
                                        "camera",   "band",    "render",   "sensor"};
    static const char *const needed[] = {"site", "atmosphere", "camera"};
    scene_table t = scene_table_open(reader, reader->root, "scene");

    for (size_t i = 0; i < sizeof known / sizeof *known; i++) scene_table_node(&t, known[i]);
    for (size_t i = 0; i < sizeof needed / sizeof *needed; i++)
        if (!toml_node_get(reader->root, needed[i]))
            scene_fail(reader, NULL, "[%s]: the table is missing", needed[i]);
    scene_table_close(&t);
}

static void read_name(scene_reader *reader)
{
    scene_table t = scene_table_open(reader, reader->root, "scene");
    const char *name = "";

    scene_table_require(&t, "name", "the name of the scene, from which files are named");
    if (scene_table_name(&t, "name", "/\\", "a name for files, without slashes", &name) &&
        *name == '.')
        scene_fail(reader, toml_node_get(reader->root, "name"),
                   "name: found \"%s\", expected a name for files, not beginning with a dot", name);
    reader->s->name = strdup(name);
    if (!reader->s->name)
        scene_took(reader, status_set(STATUS_MEMORY, "no memory for the scene's name"));
}

/* Facets that need a thickness or a temperature and have none, by material. */
static void check_facets(scene_reader *reader)
{
    const scene *s = reader->s;
    const geometry *g = s->shape;
    const bool fixed = s->thermal == SCENE_THERMAL_FIXED;
    bool *told = calloc((size_t)g->material_count + 1, sizeof *told);

    if (!told)
        scene_took(reader,
                   status_set(STATUS_MEMORY, "no memory for %u materials", g->material_count));
    for (uint32_t i = 0; told && i < g->facet_count; i++) {
        const uint32_t k = g->material[i];
        if (told[k]) continue;
        const scene_material *m = &s->materials[s->material_of[k]];
        if (g->stated_temperature_k[i] > 0.0f || m->medium != RECORD_NONE) continue;
        if (fixed ? m->temperature_k > 0.0 : g->thickness_m[i] > 0.0f || m->thickness_m > 0.0)
            continue;
        scene_fail(reader, NULL,
                   fixed ? "%s: face %u of material %s has no temperature: state temperature_k in "
                           "its [[material]]"
                         : "%s: face %u of material %s has no thickness: state thickness_cm in its "
                           "[[geometry]] or [[material]]",
                   g->object_path[g->part_object[g->part[i]]], g->facet_id[i], m->name);
        told[k] = true;
    }
    free(told);
}

/* The ground plane goes on from the scene's own ground: the largest facet of its material that faces
 * up and is level, else the lowest point. */
static double ground_height(const scene *s)
{
    const geometry *g = s->shape;
    double height = (double)g->low[2];
    float largest_m2 = 0.0f;

    for (uint32_t i = 0; i < g->facet_count; i++) {
        if (s->material_of[g->material[i]] != s->ground_material) continue;
        if (g->normal[i][2] < .9999f || g->area_m2[i] <= largest_m2) continue;
        largest_m2 = g->area_m2[i];
        height = (double)g->position[g->corner[i][0]][2];
    }
    return height + g->origin_m[2];
}

/* The ground plane is as thick as its material, or as the first facet of it. */
static void set_ground(scene_reader *reader)
{
    scene *s = reader->s;
    const geometry *g = s->shape;

    if (s->ground_material == RECORD_NONE) {
        if (!s->is_uniform)
            status_warn("%s: no ground_material in [site]: rays that leave the scene below the "
                        "horizon see the sky at the horizon",
                        s->path);
        return;
    }
    const scene_material *m = &s->materials[s->ground_material];
    s->ground_z_m = ground_height(s);
    s->ground_thickness_m = m->thickness_m;
    for (uint32_t i = 0; i < g->facet_count && s->ground_thickness_m == 0.0; i++)
        if (s->material_of[g->material[i]] == s->ground_material)
            s->ground_thickness_m = (double)g->thickness_m[i];
    if (s->thermal != SCENE_THERMAL_FIXED && s->ground_thickness_m == 0.0)
        scene_fail(reader, NULL,
                   "ground_material %s has no thickness: state thickness_cm in its "
                   "[[material]]",
                   m->name);
    if (s->thermal == SCENE_THERMAL_FIXED && m->temperature_k == 0.0)
        scene_fail(reader, NULL,
                   "ground_material %s has no temperature: state temperature_k in its "
                   "[[material]]",
                   m->name);
}

static void warn_about_facets(const scene *s)
{
    const geometry *g = s->shape;

    if (g->non_finite_count)
        status_warn("%u facets have a coordinate that is not a number: no ray meets them",
                    g->non_finite_count);
    if (g->degenerate_count)
        status_warn("%u facets have no area: no ray meets them", g->degenerate_count);
    if (g->duplicate_count)
        status_warn("%u facets repeat an earlier one, which hides them", g->duplicate_count);
    if (g->non_manifold_count)
        status_warn("%u facets share an edge with two others: they have no neighbours",
                    g->non_manifold_count);
}

/* The ground plane never states its temperature. */
static void check_weather(scene_reader *reader)
{
    const scene *s = reader->s;
    bool computed = s->shape && s->ground_material != RECORD_NONE;

    for (uint32_t i = 0; s->shape && i < s->shape->facet_count && !computed; i++)
        computed = s->shape->stated_temperature_k[i] == 0.0f;
    if (s->thermal != SCENE_THERMAL_FIXED && computed && !toml_node_get(reader->root, "weather"))
        scene_fail(reader, NULL, "[weather]: the table is missing, thermal = \"%s\" needs it",
                   scene_thermal_name(s->thermal));
}

/* Temperatures of an image follow from weather up to its time. */
static void check_history(scene_reader *reader)
{
    const scene *s = reader->s;
    const weather *w = s->history;

    if (!w || w->count == 0 || s->thermal == SCENE_THERMAL_FIXED) return;
    const double time_h = (s->place.time_s - weather_origin_s(w, &s->place)) / 3600.0;
    const double last_h = w->record[w->count - 1].time_h;
    if (time_h > last_h + 1e-6)
        scene_fail(reader, toml_node_get(reader->root, "weather"),
                   "weather.history: ends %.4g h before the image, expected weather up to its time",
                   time_h - last_h);
}

/* A band that was read must lie within the atmosphere. */
static void check_bands(scene_reader *reader)
{
    const scene *s = reader->s;
    const toml_node *list = toml_node_get(reader->root, "band");
    uint32_t refused = UINT32_MAX;

    for (uint32_t i = 0; s->air && i < s->band_count; i++) {
        const band *b = &s->bands[i];
        if (b->table == refused) continue; /* one message a table */
        band_samples samples = {0};
        if (!scene_took_at(reader, toml_node_at(list, b->table),
                           band_sample(&samples, b, s->air, scene_quadrature(s))))
            refused = b->table;
        band_samples_free(&samples);
    }
}

static void read_parts(scene_reader *reader)
{
    const char *ground_material = NULL;
    const scene *s = reader->s;

    check_tables(reader);
    read_name(reader);
    scene_read_site(reader, &ground_material);
    const bool placed = reader->failure_count == 0;
    scene_read_camera(reader);
    scene_read_bands(reader);
    scene_read_render(reader);
    scene_read_detector(reader);
    scene_read_atmosphere(reader);
    check_bands(reader);
    if (placed) scene_read_weather(reader);
    scene_read_geometry(reader);
    scene_read_materials(reader, ground_material);
    check_weather(reader);
    check_history(reader);
    scene_limits_check(reader);
    if (!s->shape || reader->failure_count > 0) return;
    check_facets(reader);
    scene_check_media(reader);
    set_ground(reader);
    scene_place_samples(reader);
    warn_about_facets(s);
}

static status set_path(scene *s, const char *path)
{
    status rc = STATUS_OK;
    const char *slash = strrchr(path, '/');

    s->path = strdup(path);
    s->folder = strndup(path, slash ? (size_t)(slash - path + 1) : 0);
    NEED(s->path && s->folder, STATUS_MEMORY, "%s: no memory to read it", path);
out:
    return rc;
}

status scene_read(scene **out, const char *path, const char *const *setting, size_t setting_count)
{
    status rc = STATUS_OK;
    char message[2048];
    toml_file *file = NULL;
    input_hashes *hashes = NULL;
    scene_reader reader = {.s = calloc(1, sizeof(scene))};
    const file_stamp stamp = file_stamp_of(path);

    NEED(reader.s, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(set_path(reader.s, path));
    TRY(input_hashes_open(&hashes));
    NEED(toml_file_read(&file, path, setting, setting_count, message, sizeof message) == 0,
         STATUS_FORMAT, "%s", message);
    reader.root = toml_file_root(file);
    if (scene_add_input(&reader, NULL, "", path)) reader.s->inputs[0].stamp = stamp;
    read_parts(&reader);
    if (reader.failure_count > 0) {
        rc = reader.ending ? reader.ending : STATUS_FORMAT;
        goto out;
    }
    for (size_t i = 0; i < reader.s->input_count; i++)
        TRY(input_hashes_find(hashes, reader.s->inputs[i].path, &reader.s->inputs[i].hash));
    *out = reader.s;
    reader.s = NULL;
out:
    input_hashes_free(hashes);
    toml_file_free(file);
    scene_free(reader.s);
    return status_finish(rc);
}

/* Takes the next name of a list; returns what is left, or NULL at the end. */
static const char *next_name(const char *list, char *name, size_t size)
{
    const size_t length = strcspn(list, ",");

    snprintf(name, size, "%.*s", (int)length, list);
    return list[length] ? list + length + 1 : NULL;
}

status scene_keep_bands(scene *s, const char *names)
{
    status rc = STATUS_OK;
    char name[256], hint[SPELLING_HINT_SIZE];
    bool *kept = calloc(s->band_count, sizeof *kept);
    uint32_t count = 0;

    NEED(kept, STATUS_MEMORY, "no memory for the bands");
    for (const char *left = names; left;) {
        uint32_t i = 0;
        left = next_name(left, name, sizeof name);
        spelling near = spelling_of(name);
        for (; i < s->band_count && strcmp(s->bands[i].name, name); i++)
            spelling_offer(&near, s->bands[i].name);
        NEED(i < s->band_count, STATUS_ARGUMENT, "unknown band '%s'%s", name,
             spelling_hint(&near, "", hint));
        kept[i] = true;
    }
    for (uint32_t i = 0; i < s->band_count; i++) {
        if (kept[i])
            s->bands[count++] = s->bands[i];
        else
            band_free(&s->bands[i]);
    }
    s->band_count = count;
out:
    free(kept);
    return rc;
}

void scene_free(scene *s)
{
    if (!s) return;
    weather_free(s->history);
    atmosphere_free(s->air);
    geometry_free(s->shape);
    for (uint32_t i = 0; i < s->material_count; i++) {
        free(s->materials[i].name);
        free(s->materials[i].spectrum);
        emissivity_free(s->materials[i].table);
        extinction_free(s->materials[i].extinction);
        scattering_free(s->materials[i].scattering);
    }
    free(s->materials);
    free(s->material_of);
    for (uint32_t i = 0; i < s->band_count; i++) band_free(&s->bands[i]);
    free(s->bands);
    psf_free(s->sensor.table);
    for (size_t i = 0; i < s->input_count; i++) {
        free(s->inputs[i].name);
        free(s->inputs[i].path);
    }
    free(s->inputs);
    name_table_free(s->input_numbers);
    free(s->time_s);
    free(s->path);
    free(s->folder);
    free(s->name);
    free(s);
}

const char *scene_thermal_name(scene_thermal thermal)
{
    static const char *const names[] = {"fixed", "therm", "layered"};

    return names[thermal];
}

band_quadrature scene_quadrature(const scene *s)
{
    return s->thesis && !s->is_uniform ? BAND_DATABASE_POINTS : BAND_FINE;
}

bool scene_is_rough(const scene *s)
{
    for (uint32_t i = 0; i < s->material_count; i++) {
        const material_record *m = &s->materials[i].record;
        if (m->specular_share > 0.0f && m->roughness >= LOBE_SMOOTH) return true;
    }
    return false;
}

uint32_t scene_lobe_rings(const scene *s)
{
    const uint32_t rings = (uint32_t)lround(90.0 / s->hemisphere_zenith_step_deg);
    const uint32_t directions =
        s->air ? (uint32_t)(s->air->zenith_count * s->air->azimuth_count) : 1;
    uint32_t most = 1;

    for (uint32_t i = 0; i < s->material_count; i++)
        if (s->materials[i].record.emissivity_angles > 1) most = LOBE_RINGS;
    while (rings % most > 0 || (most > 1 && most * directions > INCIDENT_WEIGHTS)) most--;
    return most;
}

uint32_t scene_lobe_rows(const scene *s, uint32_t material)
{
    const bool has_lobe = !s->thesis && s->materials[material].record.emissivity_angles > 1;

    return has_lobe ? LOBE_ROWS + scene_lobe_rings(s) : 0;
}

uint32_t scene_emissivity_rows(const scene *s)
{
    uint32_t rows = 0;

    for (uint32_t i = 0; i < s->material_count; i++)
        rows += s->materials[i].record.emissivity_angles + scene_lobe_rows(s, i);
    return rows;
}

const char *scene_facet_text(const scene *s, uint32_t facet, char *out, size_t size)
{
    const geometry *g = s->shape;

    if (facet == g->facet_count) {
        snprintf(out, size, "%s: the ground plane of material %s", s->path,
                 s->materials[s->ground_material].name);
        return out;
    }
    const uint32_t part = g->part[facet], object = g->part_object[part];
    snprintf(out, size, "%s: face %u of object %s, part %s, material %s", g->object_path[object],
             g->facet_id[facet], g->object_name[object], g->part_name[part],
             s->materials[s->material_of[g->material[facet]]].name);
    return out;
}

/* No ray meets a body's facets, so any temperature will do. */
static double stated_temperature_k(const scene *s, const scene_material *m, double of_facet_k)
{
    if (m->medium != RECORD_NONE) return (double)ZERO_CELSIUS_K;
    if (of_facet_k > 0.0 || s->thermal != SCENE_THERMAL_FIXED) return of_facet_k;
    return m->temperature_k;
}

void scene_facet_records(const scene *s, facet_record *out)
{
    const geometry *g = s->shape;

    for (uint32_t i = 0; i < g->facet_count; i++) {
        const uint32_t material = s->material_of[g->material[i]];
        const scene_material *m = &s->materials[material];
        out[i] = (facet_record){
            .normal = {g->normal[i][0], g->normal[i][1], g->normal[i][2]},
            .material = material,
            .slope_rad = g->slope_rad[i],
            .azimuth_rad = g->azimuth_rad[i],
            .thickness_m = g->thickness_m[i] > 0.0f ? g->thickness_m[i] : (float)m->thickness_m,
            .power_w_m2 = g->power_w_m2[i],
            .stated_temperature_k =
                (float)stated_temperature_k(s, m, (double)g->stated_temperature_k[i]),
            .two_sided = m->two_sided,
        };
    }
    if (s->ground_material == RECORD_NONE) return;
    out[g->facet_count] = (facet_record){
        .normal = {0.0f, 0.0f, 1.0f},
        .material = s->ground_material,
        .thickness_m = (float)s->ground_thickness_m,
        .stated_temperature_k =
            (float)stated_temperature_k(s, &s->materials[s->ground_material], 0.0),
    };
}
