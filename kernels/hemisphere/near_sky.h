/* Near sky: what near facets (near_facets.cl) change of the sky that points see; the counterpart of what
 * kernels/radiance/incident_near.h does to radiances. Device only. */
#ifndef NEAR_SKY_H
#define NEAR_SKY_H

#include "kernels/hemisphere/hemisphere_lanes.h"

/* Near facets of LANES_WIDTH points: what rays brought too little of each, and the third component of its direction. */
typedef struct near_sky {
    lanes weight[NEAR_FACETS], up[NEAR_FACETS];
    lanes_bits word[NEAR_FACETS];
    uint rows;
} near_sky;

static inline near_sky near_sky_read(const hemisphere_tables *rays, uint cell_count, uint first,
                                     uint count)
{
    global const uint *near = (global const uint *)rays->near_rays;
    near_sky out = {.rows = 0u};

    for (uint k = 0; k < NEAR_FACETS; k++) {
        const size_t row = (size_t)4u * k * count;
        const lanes weight = as_lanes(lanes_load_bits(near + row, first, count));
        if (!lanes_any(weight != 0.0f)) continue;
        out.weight[out.rows] = weight;
        out.up[out.rows] = as_lanes(lanes_load_bits(near + row + (size_t)3u * count, first, count));
        out.word[out.rows++] =
            lanes_load_bits(rays->met + (size_t)(cell_count + k) * count, first, count);
    }
    return out;
}

/* The share of the sky that near facets hide more than the rays told.
 *   normal   of the points' horizons */
static inline lanes near_sky_hidden(const hemisphere_tables *rays, const lanes normal[3],
                                    uint cell_count, uint first, uint count)
{
    const lanes none = (lanes)0.0f, one = (lanes)1.0f;
    const near_sky near = near_sky_read(rays, cell_count, first, count);
    const hemisphere_lanes axes = hemisphere_lanes_of(normal);
    const hemisphere_sets sets = hemisphere_sets_of(rays->direction_set, cell_count, first, count);
    lanes all[2] = {none, none}, sky[2] = {none, none}, lacks[2] = {none, none}, hidden = none;

    if (near.rows == 0u) return none;
    for (uint c = 0; c < cell_count; c++) {
        const lanes_bits word = lanes_load_bits(rays->met + (size_t)c * count, first, count);
        lanes_mask is_near = (lanes_mask)0;
        lanes direction[3];
        hemisphere_cell_directions(&axes, &sets, rays->cell + 4u * c, direction);
        for (uint k = 0; k < near.rows; k++)
            is_near |= (near.weight[k] != none) & (((near.word[k] ^ word) & ~HEMISPHERE_LIT) == 0u);
        const lanes weight = is_near ? none : (lanes)rays->cell[4u * c + 3u];
        const lanes up = direction[2] > none ? weight : none;
        all[1] += up;
        all[0] += weight - up;
        sky[1] += word == RECORD_NONE ? up : none;
        sky[0] += word == RECORD_NONE ? weight - up : none;
    }
    for (uint k = 0; k < near.rows; k++) {
        const lanes weight = near.weight[k] != none ? near.weight[k] : none;
        lacks[1] += near.up[k] > none ? weight : none;
        lacks[0] += near.up[k] > none ? none : weight;
    }
    for (uint side = 0; side < 2u; side++)
        hidden += all[side] > 1e-6f ? fmin(lacks[side] / all[side], one) * sky[side] : none;
    return hidden;
}

#endif
