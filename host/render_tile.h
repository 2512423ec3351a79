/* Render tile: the stages that run for every tile of pixels, and what it holds on the device. */
#ifndef RENDER_TILE_H
#define RENDER_TILE_H

#include "incident.h"
#include "ray_scene.h"
#include "render_tables.h"
#include "shape_factor.h"
#include "temperature.h"

/* What all tiles of a render share. */
typedef struct render_shared {
    const scene *s;
    device *dev;
    ray_scene *rays;
    bodies *bodies; /* NULL: none */
    shape_factor_grid *grid, *coarse_grid;
    bool is_coarse;
    temperature *warmth;
    render_tables tables;
    incident *around;        /* NULL: thesis mode */
    interreflection *lights; /* the same */
    radiometry_record frame;
    air_record air;
    camera_record camera;
    /* Exact mode: spectra of a tile, shape (incident_count, 2, samples). They are kept for the next tile,
     * as fresh memory costs more time than it takes to fill it. */
    device_memory incident;
    uint32_t incident_count;
} render_shared;

/* What one tile holds on the device. */
typedef struct render_tile_memory {
    uint32_t first, count;
    shape_factor_points points;
    device_memory lit, history, temperature_k, background, background_hit, background_lit;
    device_memory gloss;    /* exact mode with rough materials: see gloss.cl */
    device_memory incident; /* the render's; NULL: not wanted */
    device_memory body_paths, direct, background_direct; /* with bodies: see crossing.cl */
    device_memory truth_planes, band_planes;
    device_memory terms; /* see radiometry.cl; NULL: not wanted */
} render_tile_memory;

/* The most pixels that a tile should hold: see render_tile_limit. */
uint32_t render_tile_most(const render_shared *r);

/* Samples of a pixel; where there are several, what follows counts them, and not pixels. */
uint32_t render_tile_samples(const render_shared *r);

/* Takes memory for pixels first .. first + count - 1, but for terms; of the render only the memory that
 * it keeps changes. After a failure too,
 * render_tile_free is due. */
status render_tile_open(render_tile_memory *t, render_shared *r, uint32_t first, uint32_t count);
void render_tile_free(render_tile_memory *t);

/* Computes the planes of the tile: truth_planes, shape (TRUTH_PLANES + SUN_PLANES, count), and
 * band_planes, shape (band_count, BAND_PLANES, count).
 *   wants_parts   the parts of the radiance too */
status render_tile_compute(const render_tile_memory *t, const render_shared *r, bool wants_parts);

/* Puts planes of pixels in the place of those of their samples; the tile holds whole pixels.
 *   categorical   bit k: truth plane k holds numbers of things */
status render_tile_average(render_tile_memory *t, const render_shared *r, uint32_t categorical,
                           bool wants_parts);

#endif
