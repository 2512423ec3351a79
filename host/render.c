#include "render.h"

#include "bodies.h"
#include "bvh.h"
#include "incident.h"
#include "ray_scene.h"
#include "shape_factor.h"
#include "spectra.h"
#include "sun.h"
#include "sunlight.h"
#include "temperature.h"

#include <math.h>
#include <stdlib.h>
#include <time.h>

/* The hemisphere of a coarse look: one ring of three rays. */
static const double coarse_zenith_step_deg = 90.0, coarse_azimuth_step_deg = 120.0;

enum { STAGE_LIMIT = 8, TILE_BYTES = 1 << 27, TILE_LEAST = 1 << 10, TILE_MOST = 1 << 16 };

struct render {
    const scene *s;
    device *dev;
    ray_scene *rays;
    bodies *bodies; /* NULL: none */
    shape_factor_grid *grid, *coarse_grid;
    bool is_coarse;
    spectra *bands;
    incident *around; /* exact mode */
    radiometry_record frame;
    camera_record camera;
    size_t facet_count;  /* with the ground's */
    facet_record *facet; /* shape (facet_count) */
    temperature *warmth;
    device_memory facets, facet_ids, materials;
    device_memory spectrum_rows, emissivity_rows, extinction_rows, band_records, ln_radiance;
    render_plane *planes;
    size_t plane_count;
    render_stage stages[STAGE_LIMIT];
    size_t stage_count;
    double stage_start;
};

static double now(void)
{
    struct timespec t;

    clock_gettime(CLOCK_MONOTONIC, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

static void end_stage(render *r, const char *name)
{
    const double end = now();

    r->stages[r->stage_count++] = (render_stage){name, end - r->stage_start};
    r->stage_start = end;
}

static status open_rays(render *r)
{
    status rc = STATUS_OK;
    const scene *s = r->s;
    const geometry *g = s->shape;
    const shape_factor_reading reading = s->thesis ? SHAPE_FACTOR_THESIS : SHAPE_FACTOR_COSINE;
    bvh *tree = NULL;
    uint32_t(*corner)[4] = malloc(((size_t)g->facet_count + 1) * sizeof *corner);

    NEED(corner, STATUS_MEMORY, "no memory for %u facets", g->facet_count);
    bodies_leave_out(s, corner);
    TRY(bodies_open(&r->bodies, r->dev, s));
    TRY(bvh_build(&tree, g->facet_count, (const uint32_t(*)[4])corner,
                  (const float(*)[3])g->position));
    TRY(ray_scene_open(&r->rays, r->dev, tree));
    if (s->ground_material != RECORD_NONE)
        ray_scene_set_ground(r->rays, g->facet_count, (float)(s->ground_z_m - g->origin_m[2]));
    TRY(shape_factor_open(&r->grid, r->dev, reading, s->hemisphere_zenith_step_deg,
                          s->hemisphere_azimuth_step_deg));
    TRY(shape_factor_open(&r->coarse_grid, r->dev, reading, coarse_zenith_step_deg,
                          coarse_azimuth_step_deg));
    end_stage(r, "tree");
out:
    bvh_free(tree);
    free(corner);
    return rc;
}

static status upload_facets(render *r)
{
    status rc = STATUS_OK;
    const scene *s = r->s;
    const size_t real = s->shape->facet_count;
    uint32_t *ids = malloc((r->facet_count + 1) * sizeof *ids);
    material_record *materials = malloc((s->material_count + 1) * sizeof *materials);

    r->facet = malloc((r->facet_count + 1) * sizeof *r->facet);
    NEED(r->facet && ids && materials, STATUS_MEMORY, "no memory for %zu facets", real);
    scene_facet_records(s, r->facet);
    for (size_t i = 0; i < r->facet_count; i++)
        ids[i] = i < real ? s->shape->facet_id[i] : RECORD_NONE;
    for (uint32_t i = 0; i < s->material_count; i++) materials[i] = s->materials[i].record;
    TRY(device_allocate(r->dev, &r->facets, r->facet_count * sizeof *r->facet, r->facet));
    TRY(device_allocate(r->dev, &r->facet_ids, r->facet_count * sizeof *ids, ids));
    TRY(device_allocate(r->dev, &r->materials, s->material_count * sizeof *materials, materials));
out:
    free(ids);
    free(materials);
    return rc;
}

static status set_temperatures(render *r)
{
    status rc = STATUS_OK;

    TRY(upload_facets(r));
    TRY(temperature_open(&r->warmth, r->dev, r->s, r->rays, r->bodies, r->facets, r->facet,
                         r->facet_count));
    end_stage(r, "temperatures");
out:
    return rc;
}

/* The emissivity of all materials on the samples of the bands: 91 rows or one each. */
static status upload_emissivity(render *r)
{
    status rc = STATUS_OK;
    const scene *s = r->s;
    const size_t samples = r->bands->sample_count;
    const size_t bytes = (size_t)scene_emissivity_rows(s) * samples * sizeof(float);
    float *rows = malloc(bytes + 1);

    NEED(rows, STATUS_MEMORY, "no memory for the emissivity of %u materials", s->material_count);
    for (uint32_t i = 0; i < s->material_count; i++) {
        const scene_material *m = &s->materials[i];
        float *first = rows + (size_t)m->record.emissivity_first * samples;
        if (m->table)
            spectra_sample_emissivity(r->bands, m->table, first);
        else
            for (size_t k = 0; k < samples; k++) first[k] = (float)m->grey_emissivity;
    }
    TRY(device_allocate(r->dev, &r->emissivity_rows, bytes, rows));
out:
    free(rows);
    return rc;
}

static status open_spectra(render *r)
{
    status rc = STATUS_OK;
    const scene *s = r->s;

    TRY(spectra_build(&r->bands, s->bands, s->band_count, s->air, scene_sums_points(s), s->thesis));
    TRY(device_allocate(r->dev, &r->spectrum_rows,
                        (size_t)r->bands->row_count * r->bands->sample_count * sizeof(float),
                        r->bands->rows));
    TRY(device_allocate(r->dev, &r->band_records, s->band_count * sizeof(band_record),
                        r->bands->bands));
    TRY(device_allocate(r->dev, &r->ln_radiance,
                        (size_t)s->band_count * BAND_TEMPERATURES * sizeof(float), NULL));
    TRY(upload_emissivity(r));
    if (r->bodies)
        TRY(bodies_sample(r->bodies, r->bands->wavenumber_cm1, r->bands->sample_count,
                          &r->extinction_rows));
    TRY(device_run(r->dev, "band_temperature", shape2(BAND_TEMPERATURES, s->band_count),
                   ARG(r->bands->sample_count), ARG(r->spectrum_rows), ARG(r->band_records),
                   ARG(r->ln_radiance)));
    end_stage(r, "spectra");
out:
    return rc;
}

static void set_frame(render *r)
{
    const scene *s = r->s;
    const atmosphere *air = s->air;

    r->frame = (radiometry_record){
        .band_count = s->band_count,
        .sample_count = r->bands->sample_count,
        .path_count = (uint32_t)air->path_count,
        .path_zenith_first_deg = (float)air->path_zenith_first_deg,
        .path_zenith_step_deg = (float)air->path_zenith_step_deg,
        .zenith_count = (uint32_t)air->zenith_count,
        .azimuth_count = (uint32_t)air->azimuth_count,
        .zenith_step_deg = (float)air->zenith_step_deg,
        .azimuth_step_deg = (float)air->azimuth_step_deg,
    };
}

static status open_incident(render *r)
{
    status rc = STATUS_OK;
    const shape_factor_tables tables = {r->facets, temperature_of_facets(r->warmth), r->materials};

    TRY(incident_open(&r->around, r->rays, r->grid, &tables, r->s->shape, &r->frame));
    end_stage(r, "surroundings of facets");
out:
    return rc;
}

render_look render_stated_look(const scene *s)
{
    return (render_look){.camera = s->camera, .time_s = s->place.time_s};
}

void render_change_look(render *r, const render_look *look)
{
    const scene *s = r->s;
    const sun_position sun = sun_at(look->time_s, s->place.latitude_deg, s->place.longitude_deg);
    double direction[3];

    sun_direction(sun, direction);
    for (int i = 0; i < 3; i++) r->frame.sun[i] = (float)direction[i];
    r->camera = view_camera(&look->camera, s->shape->origin_m);
    r->frame.columns = (uint32_t)look->camera.columns;
    r->frame.thesis = s->thesis || look->is_coarse;
    r->is_coarse = look->is_coarse;
}

status render_open(render **out, const scene *s, device *dev)
{
    status rc = STATUS_OK;
    const render_look look = render_stated_look(s);
    render *r = calloc(1, sizeof *r);

    NEED(r, STATUS_MEMORY, "no memory for a render");
    r->s = s;
    r->dev = dev;
    r->facet_count = s->shape->facet_count + (s->ground_material != RECORD_NONE);
    r->stage_start = now();
    TRY(open_rays(r));
    TRY(set_temperatures(r));
    TRY(open_spectra(r));
    set_frame(r);
    render_change_look(r, &look);
    if (!s->thesis) TRY(open_incident(r));
    TRY(render_plane_list(&r->planes, &r->plane_count, s, r->bands->centre_um, r->bands->width_um));
    *out = r;
    r = NULL;
out:
    render_free(r);
    return rc;
}

void render_free(render *r)
{
    if (!r) return;
    free(r->planes);
    device_release(r->ln_radiance);
    device_release(r->band_records);
    device_release(r->extinction_rows);
    device_release(r->emissivity_rows);
    device_release(r->spectrum_rows);
    temperature_free(r->warmth);
    device_release(r->materials);
    device_release(r->facet_ids);
    device_release(r->facets);
    free(r->facet);
    incident_free(r->around);
    spectra_free(r->bands);
    shape_factor_free(r->coarse_grid);
    shape_factor_free(r->grid);
    bodies_free(r->bodies);
    ray_scene_free(r->rays);
    free(r);
}

const render_plane *render_planes(const render *r, size_t *out_count)
{
    *out_count = r->plane_count;
    return r->planes;
}

const render_stage *render_stages(const render *r, size_t *out_count)
{
    *out_count = r->stage_count;
    return r->stages;
}

/* What bodies add to a pixel: its ways, and the shares of its history. */
static uint32_t body_words(const render *r)
{
    return TRANSMISSION_PATHS * (uint32_t)(sizeof(transmission_path) / sizeof(float)) +
           temperature_history_words(r->warmth);
}

uint32_t render_tile_limit(const render *r)
{
    const uint64_t words =
        shape_factor_cell_count(r->grid) + 64u + (r->around ? 2u * r->frame.sample_count : 0u) +
        (r->bodies ? body_words(r) : 0u) + (uint64_t)r->s->band_count * BAND_PLANES;
    const uint64_t limit = ((uint64_t)TILE_BYTES / (words * sizeof(float))) & ~(uint64_t)63;

    return limit < TILE_LEAST ? TILE_LEAST : limit > TILE_MOST ? TILE_MOST : (uint32_t)limit;
}

static bool has_incident(const render *r)
{
    return r->around && !r->is_coarse;
}

/* What one tile holds on the device. */
typedef struct tile {
    uint32_t first, count;
    shape_factor_points points;
    device_memory lit, history, temperature_k, background, background_hit, background_lit;
    device_memory incident; /* exact mode: spectra, shape (count, 2, samples) */
    device_memory body_paths, direct, background_direct; /* with bodies: see crossing.cl */
    device_memory truth_planes, band_planes;
} tile;

static status open_tile(tile *t, const render *r, uint32_t first, uint32_t count)
{
    status rc = STATUS_OK;
    const size_t n = count;

    *t = (tile){.first = first, .count = count, .points = {.count = count}};
    TRY(device_allocate(r->dev, &t->points.hit, n * sizeof(hit_record), NULL));
    TRY(device_allocate(r->dev, &t->points.met,
                        n * shape_factor_cell_count(r->grid) * sizeof(uint32_t), NULL));
    TRY(device_allocate(r->dev, &t->lit, n * sizeof(float), NULL));
    TRY(device_allocate(r->dev, &t->history,
                        n * temperature_history_words(r->warmth) * sizeof(uint32_t), NULL));
    TRY(device_allocate(r->dev, &t->temperature_k, n * sizeof(float), NULL));
    TRY(device_allocate(r->dev, &t->background, n * sizeof(background_record), NULL));
    TRY(device_allocate(r->dev, &t->background_hit, n * sizeof(hit_record), NULL));
    TRY(device_allocate(r->dev, &t->background_lit, n * sizeof(float), NULL));
    if (has_incident(r))
        TRY(device_allocate(r->dev, &t->incident, n * 2 * r->frame.sample_count * sizeof(float),
                            NULL));
    if (r->bodies) {
        TRY(device_allocate(r->dev, &t->body_paths,
                            n * TRANSMISSION_PATHS * sizeof(transmission_path), NULL));
        TRY(device_allocate(r->dev, &t->direct, n * sizeof(float), NULL));
        TRY(device_allocate(r->dev, &t->background_direct, n * sizeof(float), NULL));
    }
    TRY(device_allocate(r->dev, &t->truth_planes, n * (TRUTH_PLANES + SUN_PLANES) * sizeof(float),
                        NULL));
    TRY(device_allocate(r->dev, &t->band_planes, n * r->s->band_count * BAND_PLANES * sizeof(float),
                        NULL));
out:
    return rc;
}

static void free_tile(tile *t)
{
    device_release(t->band_planes);
    device_release(t->truth_planes);
    device_release(t->background_direct);
    device_release(t->direct);
    device_release(t->body_paths);
    device_release(t->incident);
    device_release(t->background_lit);
    device_release(t->background_hit);
    device_release(t->background);
    device_release(t->temperature_k);
    device_release(t->history);
    device_release(t->lit);
    device_release(t->points.met);
    device_release(t->points.hit);
}

/* What the pixels see, what lights them, and what stands around them. */
static status trace_tile(const render *r, const tile *t)
{
    status rc = STATUS_OK;
    const device_memory facet_k = temperature_of_facets(r->warmth);
    const shape_factor_tables tables = {r->facets, facet_k, r->materials};
    const device_memory nodes = ray_scene_nodes(r->rays), blocks = ray_scene_blocks(r->rays);
    const world_record world = ray_scene_world(r->rays);

    TRY(ray_scene_primary(r->rays, &r->camera, r->frame.columns, t->first, t->count,
                          t->points.hit));
    TRY(sunlight_run(r->rays, r->frame.sun, t->count, t->points.hit, t->lit));
    TRY(shape_factor_run(r->is_coarse ? r->coarse_grid : r->grid, r->rays, &tables,
                         has_incident(r) ? r->frame.sun : NULL, &t->points, t->background));
    TRY(device_run(r->dev, "mirror", shape1(t->count), ARG(t->count), ARG(r->camera), ARG(world),
                   ARG(nodes), ARG(blocks), ARG(r->facets), ARG(facet_k), ARG(r->materials),
                   ARG(t->points.hit), ARG(t->background)));
    TRY(device_run(r->dev, "background_hit", shape1(t->count), ARG(t->count), ARG(t->background),
                   ARG(t->background_hit)));
    TRY(sunlight_run(r->rays, r->frame.sun, t->count, t->background_hit, t->background_lit));
out:
    return rc;
}

/* What stands on the pixels' ways to sensor, sun and background. */
static status cross_bodies(const render *r, const tile *t, const radiometry_record *frame)
{
    const world_record world = ray_scene_world(r->rays);
    const crossing_world around = bodies_world(r->bodies);
    const device_memory nodes = bodies_nodes(r->bodies), blocks = bodies_blocks(r->bodies);
    const device_memory medium = bodies_medium(r->bodies), levels = bodies_levels(r->bodies);

    return device_run(r->dev, "crossing", shape1(t->count), ARG(*frame), ARG(r->camera), ARG(world),
                      ARG(around), ARG(nodes), ARG(blocks), ARG(medium), ARG(levels),
                      ARG(t->points.hit), ARG(t->background_hit), ARG(t->lit),
                      ARG(t->background_lit), ARG(t->body_paths), ARG(t->direct),
                      ARG(t->background_direct));
}

static bool wants_parts(const render *r, float *const *values)
{
    for (size_t i = 0; i < r->plane_count; i++)
        if (r->planes[i].is_part && values[i]) return true;
    return false;
}

static status colour_tile(const render *r, const tile *t, float *const *values)
{
    status rc = STATUS_OK;
    radiometry_record frame = r->frame;

    frame.first_pixel = t->first;
    frame.pixel_count = t->count;
    frame.wants_parts = wants_parts(r, values);
    if (r->bodies) TRY(cross_bodies(r, t, &frame));
    const device_memory direct = r->bodies ? t->direct : t->lit;
    const device_memory behind = r->bodies ? t->background_direct : t->background_lit;
    TRY(device_run(r->dev, "truth", shape1(t->count), ARG(frame), ARG(r->camera), ARG(r->facets),
                   ARG(r->facet_ids), ARG(r->materials), ARG(t->temperature_k), ARG(t->points.hit),
                   ARG(t->background), ARG(direct), ARG(behind), ARG(t->truth_planes)));
    if (has_incident(r)) {
        const incident_pixels pixels = {
            .frame = frame,
            .camera = r->camera,
            .points = t->points,
            .background = t->background,
            .background_lit = t->background_lit,
            .spectra = r->spectrum_rows,
            .emissivity = r->emissivity_rows,
            .bodies = r->bodies,
            .extinction = r->extinction_rows,
        };
        TRY(incident_run(r->around, &pixels, t->incident));
    }
    TRY(device_run(r->dev, "radiometry", shape1(t->count), ARG(frame), ARG(r->camera),
                   ARG(r->facets), ARG(r->materials), ARG(t->temperature_k), ARG(t->points.hit),
                   ARG(t->background), ARG(t->lit), ARG(t->background_lit), ARG(r->spectrum_rows),
                   ARG(r->emissivity_rows), ARG(t->incident), ARG(r->extinction_rows),
                   ARG(t->body_paths), ARG(r->band_records), ARG(r->ln_radiance),
                   ARG(t->band_planes)));
out:
    return rc;
}

status render_tile(render *r, uint32_t first_pixel, uint32_t pixel_count, float *const *values)
{
    status rc = STATUS_OK;
    tile t;

    TRY(open_tile(&t, r, first_pixel, pixel_count));
    TRY(trace_tile(r, &t));
    if (r->is_coarse)
        TRY(temperature_of_hits(r->warmth, t.count, t.points.hit, TRUTH_PLANES, t.temperature_k,
                                t.truth_planes));
    else
        TRY(temperature_of_pixels(r->warmth, r->rays, t.count, t.points.hit, TRUTH_PLANES,
                                  t.history, t.temperature_k, t.truth_planes));
    TRY(colour_tile(r, &t, values));
    for (size_t i = 0; i < r->plane_count; i++) {
        const render_plane *p = &r->planes[i];
        const device_memory from = p->is_of_band ? t.band_planes : t.truth_planes;
        const size_t bytes = (size_t)pixel_count * sizeof(float);
        if (!values[i]) continue;
        TRY(device_download(r->dev, from, p->source * bytes, bytes, values[i] + first_pixel));
    }
out:
    free_tile(&t);
    return rc;
}

status render_pixel_day(render *r, uint32_t pixel, temperature_day *out)
{
    status rc = STATUS_OK;
    device_memory hit = NULL;
    hit_record met;

    *out = (temperature_day){0};
    TRY(device_allocate(r->dev, &hit, sizeof met, NULL));
    TRY(ray_scene_primary(r->rays, &r->camera, r->frame.columns, pixel, 1, hit));
    TRY(device_download(r->dev, hit, 0, sizeof met, &met));
    if (met.facet != RECORD_NONE) TRY(temperature_day_of(r->warmth, r->rays, hit, out));
out:
    device_release(hit);
    return rc;
}
