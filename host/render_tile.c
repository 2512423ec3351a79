#include "render_tile.h"

#include "../kernels/lobe.h"

#include "sunlight.h"

enum { TILE_BYTES = 1 << 25, TILE_LEAST = 1 << 10, TILE_MOST = 1 << 16 };

/* What bodies add to a pixel: its ways, and the shares of its history. */
static uint32_t body_words(const render_shared *r)
{
    return TRANSMISSION_PATHS * (uint32_t)(sizeof(transmission_path) / sizeof(float)) +
           temperature_history_words(r->warmth);
}

uint32_t render_tile_samples(const render_shared *r)
{
    return r->camera.strata > 1 ? r->camera.strata * r->camera.strata : 1;
}

uint32_t render_tile_most(const render_shared *r)
{
    const uint64_t words =
        shape_factor_cell_count(r->grid) + 64u + (r->around ? 2u * r->frame.sample_count : 0u) +
        (r->bodies ? body_words(r) : 0u) + (uint64_t)r->s->band_count * BAND_PLANES;
    const uint64_t limit = ((uint64_t)TILE_BYTES / (words * sizeof(float))) & ~(uint64_t)63;

    return limit < TILE_LEAST ? TILE_LEAST : limit > TILE_MOST ? TILE_MOST : (uint32_t)limit;
}

static bool has_incident(const render_shared *r)
{
    return r->around && !r->is_coarse;
}

/* Sees to it that the spectra of so many pixels have room. */
static status keep_incident(render_shared *r, uint32_t count)
{
    status rc = STATUS_OK;

    if (count <= r->incident_count) goto out;
    device_release(r->incident);
    r->incident = NULL;
    r->incident_count = 0;
    TRY(device_allocate(r->dev, &r->incident,
                        (size_t)count * 2 * r->frame.sample_count * sizeof(float), NULL));
    r->incident_count = count;
out:
    return rc;
}

status render_tile_open(render_tile_memory *t, render_shared *r, uint32_t first, uint32_t count)
{
    status rc = STATUS_OK;
    const size_t n = count;

    *t = (render_tile_memory){.first = first, .count = count, .points = {.count = count}};
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
    if (has_incident(r)) {
        TRY(keep_incident(r, count));
        t->incident = r->incident;
    }
    if (has_incident(r) && scene_is_rough(r->s))
        TRY(device_allocate(r->dev, &t->gloss, n * LOBE_RAYS * sizeof(uint32_t), NULL));
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

void render_tile_free(render_tile_memory *t)
{
    device_release(t->terms);
    device_release(t->band_planes);
    device_release(t->truth_planes);
    device_release(t->background_direct);
    device_release(t->direct);
    device_release(t->body_paths);
    device_release(t->gloss);
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
static status trace(const render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    const device_memory facet_k = temperature_of_facets(r->warmth);
    const shape_factor_tables tables = {r->tables.facets, facet_k, r->tables.materials};
    const device_memory nodes = ray_scene_nodes(r->rays), blocks = ray_scene_blocks(r->rays);
    const world_record world = ray_scene_world(r->rays);

    TRY(ray_scene_primary(r->rays, &r->camera, r->frame.columns, t->first, t->count,
                          t->points.hit));
    TRY(sunlight_run(r->rays, r->frame.sun, t->count, t->points.hit, t->lit));
    TRY(shape_factor_run(r->is_coarse ? r->coarse_grid : r->grid, r->rays, &tables,
                         has_incident(r) ? r->frame.sun : NULL, &t->points, t->background));
    TRY(device_run(r->dev, "mirror", shape1(t->count), ARG(t->count), ARG(r->camera), ARG(world),
                   ARG(nodes), ARG(blocks), ARG(r->tables.facets), ARG(facet_k),
                   ARG(r->tables.materials), ARG(t->points.hit), ARG(t->background)));
    TRY(device_run(r->dev, "background_hit", shape1(t->count), ARG(t->count), ARG(t->background),
                   ARG(t->background_hit)));
    TRY(sunlight_run(r->rays, r->frame.sun, t->count, t->background_hit, t->background_lit));
out:
    return rc;
}

/* What stands on the pixels' ways to sensor, sun and background. */
static status cross_bodies(const render_tile_memory *t, const render_shared *r,
                           const radiometry_record *frame)
{
    status rc = STATUS_OK;
    const world_record world = ray_scene_world(r->rays);
    const crossing_world around = bodies_world(r->bodies);
    const device_memory nodes = bodies_nodes(r->bodies), blocks = bodies_blocks(r->bodies);
    const device_memory medium = bodies_medium(r->bodies), levels = bodies_levels(r->bodies);
    const device_memory facet_k = temperature_of_facets(r->warmth);

    if (bodies_scatter(r->bodies))
        TRY(device_run(r->dev, "cloud_ground", shape1(frame->sample_count), ARG(*frame), ARG(world),
                       ARG(r->tables.facets), ARG(r->tables.materials), ARG(facet_k),
                       ARG(r->tables.spectrum_rows), ARG(r->tables.emissivity_rows),
                       ARG(r->tables.extinction_rows)));
    TRY(device_run(r->dev, "crossing", shape1(t->count), ARG(*frame), ARG(r->camera), ARG(world),
                   ARG(around), ARG(nodes), ARG(blocks), ARG(medium), ARG(levels),
                   ARG(t->points.hit), ARG(t->background_hit), ARG(t->lit), ARG(t->background_lit),
                   ARG(t->body_paths), ARG(t->direct), ARG(t->background_direct)));
out:
    return rc;
}

/* The rays of rough surfaces. */
static status cast_gloss(const render_tile_memory *t, const render_shared *r,
                         const radiometry_record *frame)
{
    const world_record world = ray_scene_world(r->rays);
    const device_memory nodes = ray_scene_nodes(r->rays), blocks = ray_scene_blocks(r->rays);

    return device_run(r->dev, "gloss", shape2(t->count, LOBE_RAYS), ARG(*frame), ARG(r->camera),
                      ARG(world), ARG(nodes), ARG(blocks), ARG(r->tables.facets),
                      ARG(r->tables.materials), ARG(t->points.hit), ARG(t->gloss));
}

static status colour(const render_tile_memory *t, const render_shared *r, bool wants_parts)
{
    status rc = STATUS_OK;
    radiometry_record frame = r->frame;

    frame.first_pixel = t->first;
    frame.pixel_count = t->count;
    frame.wants_parts = wants_parts;
    if (r->bodies) TRY(cross_bodies(t, r, &frame));
    const device_memory direct = r->bodies ? t->direct : t->lit;
    const device_memory behind = r->bodies ? t->background_direct : t->background_lit;
    TRY(device_run(r->dev, "truth", shape1(t->count), ARG(frame), ARG(r->camera),
                   ARG(r->tables.facets), ARG(r->tables.facet_ids), ARG(r->tables.materials),
                   ARG(t->temperature_k), ARG(t->points.hit), ARG(t->background), ARG(direct),
                   ARG(behind), ARG(t->truth_planes)));
    if (has_incident(r)) {
        TRY(interreflection_set_sun(r->lights, &r->frame));
        if (t->gloss) TRY(cast_gloss(t, r, &frame));
        const incident_pixels pixels = {
            .frame = frame,
            .camera = r->camera,
            .points = t->points,
            .background = t->background,
            .background_lit = t->background_lit,
            .gloss = t->gloss,
            .facet_background = interreflection_background(r->lights),
            .light = interreflection_rows(r->lights),
            .light_length = r->tables.blocks.sample_count,
            .spectra = r->tables.spectrum_rows,
            .emissivity = r->tables.emissivity_rows,
            .bodies = r->bodies,
            .extinction = r->tables.extinction_rows,
        };
        TRY(incident_run(r->around, &pixels, t->incident));
    }
    TRY(device_run(r->dev, "radiometry", shape1(t->count), ARG(frame), ARG(r->air), ARG(r->camera),
                   ARG(r->tables.facets), ARG(r->tables.materials), ARG(t->temperature_k),
                   ARG(t->points.hit), ARG(t->background), ARG(t->lit), ARG(t->background_lit),
                   ARG(r->tables.spectrum_rows), ARG(r->tables.emissivity_rows), ARG(t->incident),
                   ARG(r->tables.extinction_rows), ARG(t->body_paths), ARG(r->tables.band_records),
                   ARG(r->tables.band_weights), ARG(r->tables.bands_between),
                   ARG(r->tables.ln_radiance), ARG(t->terms), ARG(t->band_planes)));
out:
    return rc;
}

status render_tile_compute(const render_tile_memory *t, const render_shared *r, bool wants_parts)
{
    status rc = STATUS_OK;

    TRY(trace(t, r));
    if (r->is_coarse)
        TRY(temperature_of_hits(r->warmth, t->count, t->points.hit, TRUTH_PLANES, t->temperature_k,
                                t->truth_planes));
    else
        TRY(temperature_of_pixels(r->warmth, r->rays, t->count, t->points.hit, TRUTH_PLANES,
                                  t->history, t->temperature_k, t->truth_planes));
    TRY(colour(t, r, wants_parts));
out:
    return rc;
}

static void swap(device_memory *one, device_memory *other)
{
    const device_memory kept = *one;

    *one = *other;
    *other = kept;
}

status render_tile_average(render_tile_memory *t, const render_shared *r, uint32_t categorical,
                           bool wants_parts)
{
    status rc = STATUS_OK;
    const uint32_t per_pixel = render_tile_samples(r), pixels = t->count / per_pixel;
    const uint32_t parts = wants_parts;
    const uint32_t truth_count = TRUTH_PLANES + SUN_PLANES, band_count = r->s->band_count;
    device_memory truth = NULL, bands = NULL;

    TRY(device_allocate(r->dev, &truth, (size_t)pixels * truth_count * sizeof(float), NULL));
    TRY(device_allocate(r->dev, &bands, (size_t)pixels * band_count * BAND_PLANES * sizeof(float),
                        NULL));
    TRY(device_run(r->dev, "truth_mean", shape2(pixels, truth_count), ARG(pixels), ARG(per_pixel),
                   ARG(categorical), ARG(t->truth_planes), ARG(truth)));
    TRY(device_run(r->dev, "band_mean", shape2(pixels, band_count), ARG(pixels), ARG(per_pixel),
                   ARG(parts), ARG(r->tables.band_records), ARG(r->tables.ln_radiance),
                   ARG(t->band_planes), ARG(bands)));
    swap(&t->truth_planes, &truth);
    swap(&t->band_planes, &bands);
out:
    device_release(bands);
    device_release(truth);
    return rc;
}
