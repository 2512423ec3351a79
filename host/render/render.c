#include "render/render.h"

#include "kernels/band_plane.h"

#include "base/clock.h"
#include "hemisphere/hemisphere_strata.h"
#include "rays/media.h"
#include "rays/scene_rays.h"
#include "render/render_tile.h"
#include "sky/sun.h"

#include <stdlib.h>

/* The hemisphere of a coarse look: one ring of three rays. */
static const double coarse_zenith_step_deg = 90.0, coarse_azimuth_step_deg = 120.0;

enum { STAGE_LIMIT = 8 };

struct render {
    render_shared shared;
    render_plane *planes;
    size_t plane_count;
    render_stage stages[STAGE_LIMIT];
    size_t stage_count;
    double stage_start_s;
    sun_memory *suns; /* NULL: the scene has one time */
    render_tile_memory tile;
};

void render_prepare(device *dev, const atomic_bool *is_vain)
{
    static const size_t kernels[] = {
        KERNEL_SUN_HISTORY,    KERNEL_HEMISPHERE, KERNEL_BAND_TEMPERATURE, KERNEL_BACKGROUND,
        KERNEL_PRIMARY,        KERNEL_SUNLIGHT,   KERNEL_MIRROR,           KERNEL_BACKGROUND_HIT,
        KERNEL_SUN_TIMES,      KERNEL_TRUTH,      KERNEL_RADIOMETRY,       KERNEL_BAND_PLANES,
        KERNEL_BAND_EMISSIVITY};

    for (size_t i = 0; i < sizeof kernels / sizeof *kernels && !*is_vain; i++)
        device_prepare(dev, kernels[i]);
    status_clear();
}

static void end_stage(render *r, const char *name)
{
    const double end = clock_now_s();

    r->stages[r->stage_count++] = (render_stage){name, end - r->stage_start_s};
    r->stage_start_s = end;
}

/* Sets of directions of pixels' hemispheres: whole rounds, and so many that each sample has its own. */
static uint32_t hemisphere_sets(const scene *s)
{
    const uint32_t side = s->samples_per_side > 1 ? s->samples_per_side : 1;

    return (side * side + HEMISPHERE_SETS - 1) / HEMISPHERE_SETS * HEMISPHERE_SETS;
}

static status open_hemispheres(render *r)
{
    status rc = STATUS_OK;
    const scene *s = r->shared.s;
    device *dev = r->shared.dev;
    const double zenith_deg = s->hemisphere_zenith_step_deg;
    const double azimuth_deg = s->hemisphere_azimuth_step_deg;
    hemisphere_grid *middles = NULL;

    if (s->thesis) {
        TRY(hemisphere_grid_open(&r->shared.grid, dev, SHAPE_FACTOR_THESIS, zenith_deg,
                                 azimuth_deg));
        TRY(hemisphere_grid_open(&r->shared.coarse_grid, dev, SHAPE_FACTOR_THESIS,
                                 coarse_zenith_step_deg, coarse_azimuth_step_deg));
        return rc;
    }
    TRY(hemisphere_grid_open_strata(&r->shared.grid, dev, zenith_deg, azimuth_deg,
                                    hemisphere_sets(s), s->seed));
    TRY(hemisphere_grid_open_strata(&r->shared.coarse_grid, dev, coarse_zenith_step_deg,
                                    coarse_azimuth_step_deg, 0, 0));
    TRY(hemisphere_grid_open_strata(&middles, dev, zenith_deg, azimuth_deg, 0, 0));
    /* A pixel gets the mean of many facets, and reflects what they reflect: few rays each will do. */
    TRY(hemisphere_grid_open_thinned(&r->shared.facet_grid, dev, middles));
out:
    hemisphere_grid_free(middles);
    return rc;
}

static status open_rays(render *r)
{
    status rc = STATUS_OK;

    TRY(media_open(&r->shared.media, r->shared.dev, r->shared.s));
    TRY(scene_rays_open(&r->shared.rays, r->shared.dev, r->shared.s));
    TRY(open_hemispheres(r));
    end_stage(r, "tree");
out:
    return rc;
}

static status set_temperatures(render *r)
{
    status rc = STATUS_OK;

    TRY(temperature_open(&r->shared.temperatures, r->shared.dev,
                         &(temperature_scene){.s = r->shared.s,
                                              .rays = r->shared.rays,
                                              .dimming = r->shared.media,
                                              .facets = r->shared.tables.facets,
                                              .facet = r->shared.tables.facet,
                                              .facet_count = r->shared.tables.facet_count,
                                              .memory = r->suns}));
    r->shared.surfaces =
        (surface_tables){.facets = r->shared.tables.facets,
                         .materials = r->shared.tables.materials,
                         .facet_temperature_k = temperature_of_facets(r->shared.temperatures)};
    end_stage(r, "temperatures");
out:
    return rc;
}

static void set_frame(render *r)
{
    const scene *s = r->shared.s;
    const atmosphere *air = s->air;

    r->shared.frame = (radiometry_record){
        .band_count = s->band_count,
        .sample_count = r->shared.tables.bands->sample_count,
        .path_count = (uint32_t)air->path_count,
        .path_zenith_first_deg = (float)air->path_zenith_first_deg,
        .path_zenith_step_deg = (float)air->path_zenith_step_deg,
        .zenith_count = (uint32_t)air->zenith_count,
        .azimuth_count = (uint32_t)air->azimuth_count,
        .zenith_step_deg = (float)air->zenith_step_deg,
        .azimuth_step_deg = (float)air->azimuth_step_deg,
        .knot_count = s->thesis ? 0 : r->shared.tables.knots->spectra->sample_count,
        .knot_span = s->thesis ? 0 : r->shared.tables.knots->span,
    };
    r->shared.air = spectra_air(air, s->shape->origin_m[2]);
}

static status open_incident(render *r)
{
    status rc = STATUS_OK;
    const uint32_t rings = scene_lobe_rings(r->shared.s);

    TRY(incident_open(&r->shared.incident_of_pixels, r->shared.rays, r->shared.grid,
                      &r->shared.surfaces, rings, &r->shared.frame));
    TRY(incident_open(&r->shared.incident_of_facets, r->shared.rays, r->shared.facet_grid,
                      &r->shared.surfaces, rings, &r->shared.frame));
    const interreflection_scene from = {r->shared.incident_of_facets, r->shared.rays,
                                        r->shared.facet_grid, r->shared.s->shape,
                                        r->shared.surfaces};
    TRY(interreflection_open(&r->shared.interreflection, &from, r->shared.tables.reflectance,
                             r->shared.s->depth, &r->shared.tables.blocks, r->shared.frame.sun));
    TRY(interreflection_set_sun(r->shared.interreflection, &r->shared.frame));
    end_stage(r, "light between facets");
out:
    return rc;
}

static void free_incident(render *r)
{
    interreflection_free(r->shared.interreflection);
    incident_free(r->shared.incident_of_facets);
    incident_free(r->shared.incident_of_pixels);
    r->shared.interreflection = NULL;
    r->shared.incident_of_facets = r->shared.incident_of_pixels = NULL;
}

render_look render_stated_look(const scene *s)
{
    return (render_look){.camera = s->camera, .time_s = s->place.time_s};
}

void render_change_look(render *r, const render_look *look)
{
    const scene *s = r->shared.s;
    const sun_position sun = sun_at(look->time_s, s->place.latitude_deg, s->place.longitude_deg);
    double direction[3];

    sun_direction(sun, direction);
    for (int i = 0; i < 3; i++) r->shared.frame.sun[i] = (float)direction[i];
    r->shared.camera = view_camera(&look->camera, s->shape->origin_m);
    r->shared.air.is_level = r->shared.camera.position[2] < s->shape->high[2];
    r->shared.camera.samples_per_side = look->is_coarse ? 1 : s->samples_per_side;
    r->shared.camera.seed = s->seed;
    r->shared.frame.columns = (uint32_t)look->camera.columns;
    r->shared.frame.thesis = s->thesis || look->is_coarse;
    r->shared.is_coarse = look->is_coarse;
}

status render_open(render **out, const scene *s, device *dev)
{
    status rc = STATUS_OK;
    const render_look look = render_stated_look(s);
    render *r = calloc(1, sizeof *r);

    NEED(r, STATUS_MEMORY, "no memory for a render");
    r->shared.s = s;
    r->shared.dev = dev;
    r->shared.tables.facet_count = s->shape->facet_count + (s->ground_material != RECORD_NONE);
    r->stage_start_s = clock_now_s();
    if (s->time_count > 1) TRY(sun_memory_open(&r->suns));
    TRY(open_rays(r));
    TRY(render_tables_take_facets(&r->shared.tables, dev, s));
    TRY(set_temperatures(r));
    TRY(render_tables_take_spectra(&r->shared.tables, dev, s, r->shared.media));
    end_stage(r, "spectra");
    set_frame(r);
    render_change_look(r, &look);
    if (!s->thesis) {
        TRY(render_tables_take_blocks(&r->shared.tables, dev, s));
        TRY(open_incident(r));
    }
    TRY(render_plane_list(&r->planes, &r->plane_count, s, r->shared.tables.bands->centre_um,
                          r->shared.tables.bands->width_um));
    *out = r;
    r = NULL;
out:
    render_free(r);
    return rc;
}

status render_move(render *r, const scene *s)
{
    status rc = STATUS_OK;
    const render_look look = render_stated_look(s);

    r->stage_count = 0;
    r->stage_start_s = clock_now_s();
    render_tile_free(&r->tile);
    r->shared.s = s;
    free_incident(r);
    temperature_free(r->shared.temperatures);
    r->shared.temperatures = NULL;
    TRY(set_temperatures(r));
    render_change_look(r, &look);
    if (!s->thesis) TRY(open_incident(r));
out:
    return rc;
}

void render_free(render *r)
{
    if (!r) return;
    render_tile_free(&r->tile);
    free(r->planes);
    free_incident(r);
    temperature_free(r->shared.temperatures);
    render_tables_free(&r->shared.tables);
    hemisphere_grid_free(r->shared.coarse_grid);
    hemisphere_grid_free(r->shared.facet_grid);
    hemisphere_grid_free(r->shared.grid);
    media_free(r->shared.media);
    ray_scene_free(r->shared.rays);
    sun_memory_free(r->suns);
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

uint32_t render_tile_limit(const render *r)
{
    const uint32_t most = render_tile_most(&r->shared) / render_tile_samples(&r->shared);

    return most > 0 ? most : 1;
}

/* Bit k: plane k of a band is wanted. */
static uint32_t band_wants(const render *r, float *const *values)
{
    uint32_t bits = 0;

    for (size_t i = 0; i < r->plane_count; i++)
        if (r->planes[i].is_of_band && values[i]) bits |= 1u << r->planes[i].source % BAND_PLANES;
    return bits;
}

/* Bit k: truth plane k is categorical. */
static uint32_t categorical_planes(const render *r)
{
    uint32_t bits = 0;

    for (size_t i = 0; i < r->plane_count; i++)
        if (!r->planes[i].is_of_band && r->planes[i].plane.categorical)
            bits |= 1u << r->planes[i].source;
    return bits;
}

status render_tile(render *r, uint32_t first_pixel, uint32_t pixel_count, float *const *values,
                   const render_store *store)
{
    status rc = STATUS_OK;
    const uint32_t samples = render_tile_samples(&r->shared);

    TRY(render_tile_open(&r->tile, &r->shared, first_pixel * samples, pixel_count * samples,
                         band_wants(r, values)));
    TRY(render_tile_compute(&r->tile, &r->shared));
    if (samples > 1) TRY(render_tile_average(&r->tile, &r->shared, categorical_planes(r)));
    TRY(render_tile_store(&r->tile, &r->shared, r->planes, r->plane_count, values, store));
out:
    if (rc != STATUS_OK) render_tile_free(&r->tile);
    return rc;
}

const spectra *render_spectra(const render *r)
{
    return r->shared.tables.bands;
}

/* The spectra of a group of pixels of which one sample is the first.
 *   out   shape (count, PIXEL_GROUP) */
static status sample_terms(const render *r, uint32_t sample, size_t count, float *out)
{
    status rc = STATUS_OK;
    render_tile_memory t = {0};

    TRY(render_tile_open(&t, &r->shared, sample, 1, BAND_PLANE_PARTS));
    TRY(render_tile_compute(&t, &r->shared));
    TRY(device_download(r->shared.dev, t.terms, count * PIXEL_GROUP, out));
out:
    render_tile_free(&t);
    return rc;
}

status render_pixel_terms(render *r, uint32_t pixel, double *out)
{
    status rc = STATUS_OK;
    const uint32_t samples = render_tile_samples(&r->shared);
    const size_t count = (size_t)SENSOR_TERMS * r->shared.frame.sample_count;
    float *one = malloc(count * PIXEL_GROUP * sizeof *one);

    NEED(one, STATUS_MEMORY, "no memory for the spectra of a pixel");
    for (size_t i = 0; i < count; i++) out[i] = 0.0;
    for (uint32_t k = 0; k < samples; k++) {
        TRY(sample_terms(r, pixel * samples + k, count, one));
        for (size_t i = 0; i < count; i++) out[i] += (double)one[i * PIXEL_GROUP] / samples;
    }
out:
    free(one);
    return rc;
}

status render_pixel_day(render *r, uint32_t pixel, pixel_day *out)
{
    status rc = STATUS_OK;
    camera_record camera = r->shared.camera;
    hit_record_buffer hit = {0};
    hit_record met;

    *out = (pixel_day){0};
    camera.samples_per_side = 1;
    TRY(device_allocate(r->shared.dev, &hit, 1, NULL));
    TRY(ray_scene_primary(r->shared.rays, &camera, r->shared.frame.columns, pixel, 1, hit));
    TRY(device_download(r->shared.dev, hit, 1, &met));
    if (met.facet != RECORD_NONE)
        TRY(pixel_day_of(r->shared.temperatures, r->shared.rays, hit, out));
out:
    device_release(hit);
    return rc;
}
