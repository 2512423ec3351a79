#include "render/render_tile.h"

#include "kernels/band_plane.h"
#include "kernels/radiance/lobe.h"

#include "hemisphere/point_order.h"
#include "sunlight/sunlight.h"
#include "thermal/value_check.h"

#include <stdlib.h>
#include <string.h>

enum { TILE_BYTES = 1 << 25, TILE_MOST = 1 << 16, TILE_GROUP = 1 << 6 };

/* Spectra are integrated while they are in a cache. Groups of pixels of a work-group, and the least
 * that are launched at once. */
enum { TERM_BYTES = 1 << 23, GROUPS_TOGETHER = 4, GROUPS_LEAST = 16 };

/* What bodies add to a pixel: its ways, and the shares of its history. */
static uint32_t body_words(const render_shared *r)
{
    return TRANSMISSION_PATHS * (uint32_t)(sizeof(transmission_path) / sizeof(float)) +
           temperature_history_words(r->temperatures);
}

uint32_t render_tile_samples(const render_shared *r)
{
    return r->camera.samples_per_side > 1 ? r->camera.samples_per_side * r->camera.samples_per_side
                                          : 1;
}

uint32_t render_tile_most(const render_shared *r)
{
    const uint64_t words = hemisphere_grid_cell_count(r->grid) + 64u + 2u * r->frame.knot_count +
                           (r->media ? body_words(r) : 0u) +
                           (uint64_t)r->s->band_count * BAND_PLANES;
    const uint64_t limit = (uint64_t)TILE_BYTES / (words * sizeof(float));

    if (limit < TILE_GROUP) return limit > 0 ? (uint32_t)limit : 1;
    return limit > TILE_MOST ? TILE_MOST : (uint32_t)(limit - limit % TILE_GROUP);
}

static bool has_incident(const render_shared *r)
{
    return r->incident_of_pixels && !r->is_coarse;
}

/* What the planes that are averaged over samples are made from. */
static uint32_t wants_of_samples(const render_shared *r, uint32_t wants)
{
    return render_tile_samples(r) > 1 ? wants & ~(1u << BAND_APPARENT | 1u << BAND_STDERR) : wants;
}

static status allocate_bands(render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    const uint32_t wants = wants_of_samples(r, t->wants);
    const size_t row = band_plane_row(t->room);
    const size_t group_floats =
        (size_t)band_plane_terms(wants) * r->frame.sample_count * PIXEL_GROUP;
    size_t groups = TERM_BYTES / (group_floats * sizeof(float)) / GROUPS_TOGETHER * GROUPS_TOGETHER;

    if (groups < GROUPS_LEAST) groups = GROUPS_LEAST;
    if (groups > row / PIXEL_GROUP) groups = row / PIXEL_GROUP;
    t->groups_at_once = (uint32_t)groups;
    TRY(device_allocate(r->dev, &t->terms, groups * group_floats, NULL));
    TRY(device_allocate(r->dev, &t->emissivities, row * 2, NULL));
    TRY(device_allocate(r->dev, &t->band_planes, r->s->band_count * band_plane_count(wants) * row,
                        NULL));
out:
    return rc;
}

static status allocate_media(render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    const size_t n = t->room;

    TRY(device_allocate(r->dev, &t->pixels.paths, n * TRANSMISSION_PATHS, NULL));
    TRY(device_allocate(r->dev, &t->direct, n, NULL));
    TRY(device_allocate(r->dev, &t->background_direct, n, NULL));
out:
    return rc;
}

/* What the planes of pixels need beside those of their samples. */
static status allocate_means(render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    const size_t pixels = t->room / t->samples;

    TRY(device_allocate(r->dev, &t->mean_truth_planes, pixels * (TRUTH_PLANES + SUN_PLANES), NULL));
    TRY(device_allocate(r->dev, &t->mean_band_planes,
                        (size_t)band_plane_row((uint32_t)pixels) * r->s->band_count *
                            band_plane_count(t->wants),
                        NULL));
out:
    return rc;
}

static status allocate(render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    const size_t n = t->room;

    TRY(device_allocate(r->dev, &t->pixels.hit, n, NULL));
    TRY(device_allocate(r->dev, &t->points.hit, n, NULL));
    TRY(device_allocate(r->dev, &t->points.order, n, NULL));
    TRY(device_allocate(r->dev, &t->points.direction_set, n, NULL));
    TRY(device_allocate(r->dev, &t->points.met,
                        n * (hemisphere_grid_cell_count(r->grid) + NEAR_FACETS), NULL));
    if (has_incident(r))
        TRY(device_allocate(r->dev, &t->points.near_rays, n * 4 * NEAR_FACETS, NULL));
    TRY(device_allocate(r->dev, &t->pixels.sunlit, n, NULL));
    TRY(device_allocate(r->dev, &t->history, n * temperature_history_words(r->temperatures), NULL));
    TRY(device_allocate(r->dev, &t->pixels.temperature_k, n, NULL));
    TRY(device_allocate(r->dev, &t->pixels.background, n, NULL));
    TRY(device_allocate(r->dev, &t->background_hit, n, NULL));
    TRY(device_allocate(r->dev, &t->pixels.background_sunlit, n, NULL));
    if (has_incident(r))
        TRY(device_allocate(r->dev, &t->pixels.incident, n * 2 * r->frame.knot_count, NULL));
    if (has_incident(r) && scene_is_rough(r->s))
        TRY(device_allocate(r->dev, &t->gloss, n * LOBE_RAYS, NULL));
    if (r->media) TRY(allocate_media(t, r));
    TRY(device_allocate(r->dev, &t->truth_planes, n * (TRUTH_PLANES + SUN_PLANES), NULL));
    TRY(allocate_bands(t, r));
    if (t->samples > 1) TRY(allocate_means(t, r));
out:
    return rc;
}

status render_tile_open(render_tile_memory *t, const render_shared *r, uint32_t first,
                        uint32_t count, uint32_t wants)
{
    status rc = STATUS_OK;
    const uint32_t planes = wants | 1u << BAND_RADIANCE, samples = render_tile_samples(r);

    if (count > t->room || planes != t->wants || samples != t->samples ||
        r->is_coarse != t->is_coarse) {
        render_tile_free(t);
        *t = (render_tile_memory){
            .room = count, .wants = planes, .samples = samples, .is_coarse = r->is_coarse};
        TRY(allocate(t, r));
    }
    t->first = first;
    t->count = t->points.count = count;
out:
    if (rc != STATUS_OK) render_tile_free(t);
    return rc;
}

void render_tile_free(render_tile_memory *t)
{
    device_release(t->mean_band_planes);
    device_release(t->mean_truth_planes);
    device_release(t->terms);
    device_release(t->emissivities);
    device_release(t->band_planes);
    device_release(t->truth_planes);
    device_release(t->background_direct);
    device_release(t->direct);
    device_release(t->pixels.paths);
    device_release(t->pixels.incident);
    device_release(t->gloss);
    device_release(t->pixels.background_sunlit);
    device_release(t->background_hit);
    device_release(t->pixels.background);
    device_release(t->pixels.temperature_k);
    device_release(t->history);
    device_release(t->pixels.sunlit);
    device_release(t->points.met);
    device_release(t->points.direction_set);
    device_release(t->points.near_rays);
    device_release(t->points.order);
    device_release(t->points.hit);
    device_release(t->pixels.hit);
    *t = (render_tile_memory){0};
}

/* What the pixels see, what lights them, and what stands around them. */
static status trace(const render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    const point_tile where = {.first = t->first,
                              .count = t->count,
                              .columns = r->frame.columns,
                              .samples = t->samples,
                              .first_column = r->camera.first_column,
                              .first_row = r->camera.first_row,
                              .seed = r->camera.seed,
                              .has_sets = hemisphere_grid_set_count(r->grid) > 1};

    TRY(ray_scene_primary(r->rays, &r->camera, r->frame.columns, t->first, t->count,
                          t->pixels.hit));
    TRY(sunlight_cast(r->rays, r->frame.sun, t->count, t->pixels.hit, t->pixels.sunlit));
    TRY(point_order_run(r->dev, t->pixels.hit, r->tables.facet, &where, t->points.order,
                        t->points.direction_set, t->points.hit));
    TRY(shape_factor_run(r->is_coarse ? r->coarse_grid : r->grid, r->rays, &r->surfaces,
                         has_incident(r) ? r->frame.sun : NULL, &t->points, t->pixels.background));
    TRY(mirror_run(r->dev, shape1(t->count),
                   &(mirror_args){.count = t->count,
                                  .camera = r->camera,
                                  .tree = ray_scene_tree(r->rays),
                                  .surface = r->surfaces,
                                  .hit = t->pixels.hit,
                                  .background = t->pixels.background}));
    TRY(background_hit_run(r->dev, shape1(t->count),
                           &(background_hit_args){.count = t->count,
                                                  .background = t->pixels.background,
                                                  .hit = t->background_hit}));
    TRY(sunlight_cast(r->rays, r->frame.sun, t->count, t->background_hit,
                      t->pixels.background_sunlit));
out:
    return rc;
}

/* What stands on the pixels' ways to sensor, sun and background. */
static status cross_media(const render_tile_memory *t, const render_shared *r,
                          const radiometry_record *frame)
{
    status rc = STATUS_OK;

    if (media_scatter(r->media))
        TRY(cloud_ground_run(r->dev, shape1(frame->sample_count),
                             &(cloud_ground_args){.frame = *frame,
                                                  .world = ray_scene_tree(r->rays).world,
                                                  .surface = r->surfaces,
                                                  .spectra = r->tables.spectra,
                                                  .out_extinction = r->tables.spectra.extinction}));
    TRY(crossing_run(r->dev, shape1(t->count),
                     &(crossing_args){.frame = *frame,
                                      .camera = r->camera,
                                      .world = ray_scene_tree(r->rays).world,
                                      .medium = media_tables(r->media),
                                      .pixel = t->pixels,
                                      .out_paths = t->pixels.paths,
                                      .direct = t->direct,
                                      .background_direct = t->background_direct}));
out:
    return rc;
}

/* The rays of rough surfaces. */
static status cast_gloss(const render_tile_memory *t, const render_shared *r,
                         const radiometry_record *frame)
{
    return gloss_run(r->dev, shape2(t->count, LOBE_RAYS),
                     &(gloss_args){.frame = *frame,
                                   .camera = r->camera,
                                   .tree = ray_scene_tree(r->rays),
                                   .surface = r->surfaces,
                                   .hit = t->pixels.hit,
                                   .out_met = t->gloss});
}

/* Spectra, and the planes of the bands from them. */
static status integrate(const render_tile_memory *t, const render_shared *r,
                        radiometry_record frame)
{
    status rc = STATUS_OK;
    const uint32_t groups = band_plane_row(t->count) / PIXEL_GROUP;

    for (frame.first_group = 0; frame.first_group < groups;
         frame.first_group += t->groups_at_once) {
        const uint32_t left = groups - frame.first_group;
        const uint32_t some = left < t->groups_at_once ? left : t->groups_at_once;
        const device_shape shape = device_ray_shape(r->dev, some * PIXEL_GROUP, 1);
        TRY(radiometry_run(r->dev, shape,
                           &(radiometry_args){.frame = frame,
                                              .air = r->air,
                                              .camera = r->camera,
                                              .surface = r->surfaces,
                                              .pixel = t->pixels,
                                              .spectra = r->tables.spectra,
                                              .emissivities = t->emissivities,
                                              .terms = t->terms}));
        TRY(band_planes_run(r->dev, shape,
                            &(band_planes_args){.frame = frame,
                                                .bands = r->tables.band_records,
                                                .weights = r->tables.band_weights,
                                                .band_emissivity = r->tables.band_emissivity,
                                                .ln_radiance = r->tables.ln_radiance,
                                                .emissivities = t->emissivities,
                                                .terms = t->terms,
                                                .planes = t->band_planes}));
    }
out:
    return rc;
}

/* What arrives at the pixels, ray by ray. */
static status collect_incident(const render_tile_memory *t, const render_shared *r,
                               const radiometry_record *frame)
{
    status rc = STATUS_OK;
    const bool all_are_knots = frame->knot_span == 0;
    incident_pixels pixels = {
        .frame = *frame,
        .camera = r->camera,
        .points = t->points,
        .background = t->pixels.background,
        .background_lit = t->pixels.background_sunlit,
        .gloss = t->gloss,
        .light_length = r->tables.blocks.sample_count,
        .spectra = all_are_knots ? r->tables.spectra : r->tables.knot_spectra,
        .media = r->media,
    };

    TRY(interreflection_set_sun(r->interreflection, &r->frame));
    if (t->gloss.memory) TRY(cast_gloss(t, r, frame));
    pixels.frame.sample_count = frame->knot_count;
    pixels.light = interreflection_light(r->interreflection);
    TRY(incident_compute(r->incident_of_pixels, &pixels, t->pixels.incident));
out:
    return rc;
}

/* The planes of the tile. */
static status colour(const render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;
    radiometry_record frame = r->frame;
    pixel_tables pixels = t->pixels;

    frame.first_pixel = t->first;
    frame.pixel_count = t->count;
    frame.wants = wants_of_samples(r, t->wants);
    if (r->media) {
        TRY(cross_media(t, r, &frame));
        pixels.sunlit = t->direct;
        pixels.background_sunlit = t->background_direct;
    }
    TRY(truth_run(r->dev, shape1(t->count),
                  &(truth_args){.frame = frame,
                                .camera = r->camera,
                                .surface = r->surfaces,
                                .facet_id = r->tables.facet_ids,
                                .pixel = pixels,
                                .planes = t->truth_planes}));
    if (has_incident(r)) TRY(collect_incident(t, r, &frame));
    TRY(integrate(t, r, frame));
out:
    return rc;
}

status render_tile_compute(const render_tile_memory *t, const render_shared *r)
{
    status rc = STATUS_OK;

    const temperature_pixels pixels = {.count = t->count,
                                       .hit = t->pixels.hit,
                                       .order = t->points.order,
                                       .history = t->history,
                                       .temperature_k = t->pixels.temperature_k,
                                       .first_plane = TRUTH_PLANES,
                                       .planes = t->truth_planes};

    TRY(trace(t, r));
    TRY(r->is_coarse ? temperature_of_hits(r->temperatures, &pixels)
                     : temperature_of_pixels(r->temperatures, r->rays, &pixels));
    TRY(colour(t, r));
out:
    return rc;
}

status render_tile_average(const render_tile_memory *t, const render_shared *r,
                           uint32_t categorical)
{
    status rc = STATUS_OK;
    const uint32_t pixels = t->count / t->samples;

    TRY(truth_mean_run(r->dev, shape2(pixels, TRUTH_PLANES + SUN_PLANES),
                       &(truth_mean_args){.pixel_count = pixels,
                                          .sample_count = t->samples,
                                          .categorical = categorical,
                                          .samples = t->truth_planes,
                                          .planes = t->mean_truth_planes}));
    TRY(band_mean_run(r->dev, shape2(pixels, r->s->band_count),
                      &(band_mean_args){.pixel_count = pixels,
                                        .sample_count = t->samples,
                                        .wants = t->wants,
                                        .has = wants_of_samples(r, t->wants),
                                        .bands = r->tables.band_records,
                                        .ln_radiance = r->tables.ln_radiance,
                                        .samples = t->band_planes,
                                        .planes = t->mean_band_planes}));
out:
    return rc;
}

/* What the planes of a tile are, as the host sees them. */
typedef struct tile_view {
    uint32_t first, count, wants;
    const float *truth, *bands;
} tile_view;

static const float *plane_in(const tile_view *v, const render_plane *p)
{
    const uint32_t place = band_plane_place(v->wants, p->source % BAND_PLANES);
    const size_t before = (size_t)(p->source / BAND_PLANES) * band_plane_count(v->wants);

    return p->is_of_band ? v->bands + (before + place) * band_plane_row(v->count)
                         : v->truth + (size_t)p->source * v->count;
}

/* Fails for what a pixel shows: the facet of the first of its samples that met one. */
static status refuse(const render_tile_memory *t, const render_shared *r, const render_plane *p,
                     uint32_t pixel, float value)
{
    status rc = STATUS_OK;
    const size_t first = (size_t)pixel * t->samples, end = first + t->samples;
    hit_record *met = malloc(end * sizeof *met);
    uint32_t facet = RECORD_NONE;
    char text[1024] = "the sky";

    NEED(met, STATUS_MEMORY, "no memory for the samples of a pixel");
    TRY(device_download(r->dev, t->pixels.hit, end, met));
    for (size_t i = first; i < end && facet == RECORD_NONE; i++) facet = met[i].facet;
    if (facet != RECORD_NONE) scene_facet_text(r->s, facet, text, sizeof text);
    rc = status_set(STATUS_ARGUMENT, "%s: found %g in the plane %s, expected %s", text,
                    (double)value, p->name,
                    p->is_surface_c ? "a temperature of " VALUE_CHECK_RANGE : "a finite number");
out:
    free(met);
    return rc;
}

/* Whether the wanted planes can be what they say. */
static status check_planes(const render_tile_memory *t, const render_shared *r, const tile_view *v,
                           const render_plane *planes, size_t plane_count, float *const *values)
{
    for (size_t i = 0; i < plane_count; i++) {
        if (!values[i]) continue;
        const float *from = plane_in(v, &planes[i]);
        const size_t at = planes[i].is_surface_c ? value_check_celsius(from, v->count)
                                                 : value_check_finite(from, v->count);
        if (at < v->count) return refuse(t, r, &planes[i], (uint32_t)at, from[at]);
    }
    return STATUS_OK;
}

static status store_planes(const tile_view *v, const render_plane *planes, size_t plane_count,
                           float *const *values, const render_store *store)
{
    status rc = STATUS_OK;

    for (size_t i = 0; i < plane_count; i++) {
        if (!values[i]) continue;
        const float *from = plane_in(v, &planes[i]);
        if (store)
            TRY(store->write(store->self, i, v->first, v->count, from));
        else
            memcpy(values[i] + v->first, from, v->count * sizeof *from);
    }
out:
    return rc;
}

status render_tile_store(const render_tile_memory *t, const render_shared *r,
                         const render_plane *planes, size_t plane_count, float *const *values,
                         const render_store *store)
{
    status rc = STATUS_OK;
    const float_buffer truth = t->samples > 1 ? t->mean_truth_planes : t->truth_planes;
    const float_buffer bands = t->samples > 1 ? t->mean_band_planes : t->band_planes;
    tile_view v = {
        .first = t->first / t->samples, .count = t->count / t->samples, .wants = t->wants};
    const size_t truth_length = (size_t)(TRUTH_PLANES + SUN_PLANES) * v.count;
    const size_t rows = (size_t)r->s->band_count * band_plane_count(t->wants);

    TRY(device_map(r->dev, truth, truth_length, &v.truth));
    TRY(device_map(r->dev, bands, rows * band_plane_row(v.count), &v.bands));
    TRY(check_planes(t, r, &v, planes, plane_count, values));
    TRY(store_planes(&v, planes, plane_count, values, store));
out:
    device_unmap(r->dev, bands, v.bands);
    device_unmap(r->dev, truth, v.truth);
    return rc;
}
