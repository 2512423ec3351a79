#include "hemisphere.h"

/* Casts the rays of the hemisphere above points.
 * Launch: (count, cell_count). sun_x, sun_y, sun_z: unit vector towards the sun; at or below the
 * horizon, and (0, 0, 0), nothing is lit. cell: (cell_count, 4) direction along upslope, across and
 * normal, weight; hit: (count);
 * out_met: (cell_count, count) the facet met, with HEMISPHERE_LIT where the sun reaches the point
 * met; RECORD_NONE for the sky and for points without a facet. */
kernel void hemisphere(const uint count, const uint cell_count, const float sun_x,
                       const float sun_y, const float sun_z, const world_record world,
                       global const bvh_node *nodes, global const bvh_block *blocks,
                       global const float *cell, global const hit_record *hit, global uint *out_met)
{
    const uint i = get_global_id(0), c = get_global_id(1);
    if (i >= count) return;
    const hit_record at = hit[i];
    const hemisphere_frame frame = hemisphere_frame_of(at.normal);
    const float sun[3] = {sun_x, sun_y, sun_z};
    uint met = RECORD_NONE;

    if (at.facet != RECORD_NONE) {
        const hit_record record = hemisphere_cast(&frame, &at, cell, c, &world, nodes, blocks);
        const float facing =
            record.normal[0] * sun_x + record.normal[1] * sun_y + record.normal[2] * sun_z;
        met = record.facet;
        if (met != RECORD_NONE && sun_z > 0.0f && facing > 0.0f) {
            const ray r = ray_leaving(&world, record.point, record.normal, sun);
            if (met == world.ground_facet || !ray_any(nodes, blocks, &r)) met |= HEMISPHERE_LIT;
        }
    }
    out_met[(size_t)c * count + i] = met;
}
