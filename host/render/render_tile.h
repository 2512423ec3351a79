/* Render tile: the stages that run for every tile of pixels, and what it holds on the device. */
#ifndef RENDER_TILE_H
#define RENDER_TILE_H

#include "hemisphere/shape_factor.h"
#include "radiance/incident.h"
#include "rays/ray_scene.h"
#include "render/render_plane.h"
#include "render/render_tables.h"
#include "thermal/temperature.h"

/* What all tiles of a render share. */
typedef struct render_shared {
    const scene *s;
    device *dev;
    ray_scene *rays;
    media *media; /* NULL: none */
    hemisphere_grid *grid, *facet_grid, *coarse_grid;
    bool is_coarse;
    temperature_solver *temperatures;
    render_tables tables;
    surface_tables surfaces;
    incident *incident_of_pixels;     /* NULL: thesis mode */
    incident *incident_of_facets;     /* the same */
    interreflection *interreflection; /* the same */
    radiometry_record frame;
    air_record air;
    camera_record camera;
} render_shared;

/* What one tile holds on the device. Starts zeroed; render_tile_free is then safe at any time. */
typedef struct render_tile_memory {
    uint32_t first, count;
    uint32_t room, samples; /* that there is memory for; of a pixel */
    bool is_coarse;
    pixel_tables pixels;
    shape_factor_points points; /* the same hits, in an order of their own */
    uint_buffer history;
    hit_record_buffer background_hit;
    uint_buffer gloss;                      /* exact mode with rough materials: see gloss.cl */
    float_buffer direct, background_direct; /* with bodies: see crossing.cl */
    uint32_t wants;                         /* planes of the bands, see band_plane.h */
    float_buffer truth_planes, band_planes;
    float_buffer mean_truth_planes, mean_band_planes; /* with several samples a pixel */
    emissivity_record_buffer emissivities;
    float_buffer terms; /* of groups_at_once: see radiometry.cl */
    uint32_t groups_at_once;
} render_tile_memory;

/* The most samples that a tile should hold, at least 1: see render_tile_limit. */
uint32_t render_tile_most(const render_shared *r);

/* Samples of a pixel; where there are several, what follows counts them, and not pixels. */
uint32_t render_tile_samples(const render_shared *r);

/* Makes ready for pixels first .. first + count - 1; memory that is there already is used again where
 * it fits, as fresh memory costs as much time as many a kernel.
 *   wants   planes of the bands, see band_plane.h; the radiance always */
status render_tile_open(render_tile_memory *t, const render_shared *r, uint32_t first,
                        uint32_t count, uint32_t wants);
/* Releases the memory; due before what the tiles share changes, but for its look. */
void render_tile_free(render_tile_memory *t);

/* Computes the planes of the tile: truth_planes, shape (TRUTH_PLANES + SUN_PLANES, count), and
 * band_planes, see band_plane.h. */
status render_tile_compute(const render_tile_memory *t, const render_shared *r);

/* Computes the planes of pixels from those of their samples; the tile holds whole pixels.
 *   categorical   bit k: truth plane k holds numbers of things */
status render_tile_average(const render_tile_memory *t, const render_shared *r,
                           uint32_t categorical);

/* Takes the wanted planes of the tile's pixels to where they belong. Fails with STATUS_ARGUMENT, and
 * the name of the facet, where a value is not finite or no surface can have a temperature.
 *   planes, values   shape (plane_count); values and store: as render_tile has them */
status render_tile_store(const render_tile_memory *t, const render_shared *r,
                         const render_plane *planes, size_t plane_count, float *const *values,
                         const render_store *store);

#endif
