#include "hemisphere.h"

/* Casts the rays of the hemisphere above points.
 * Launch: (count / RAY_LANES, rounded up, cell_count). sun_x, sun_y, sun_z: unit vector towards the
 * sun; at or below the horizon, and (0, 0, 0), nothing is lit. cell: (cell_count, 4) direction along
 * upslope, across and normal, weight; hit: (count);
 * out_met: (cell_count, count) the facet met, with HEMISPHERE_LIT where the sun reaches the point
 * met; RECORD_NONE for the sky and for points without a facet. */
kernel void hemisphere(const uint count, const uint cell_count, const float sun_x,
                       const float sun_y, const float sun_z, const world_record world,
                       global const bvh_node *nodes, global const bvh_block *blocks,
                       global const float *cell, global const hit_record *hit, global uint *out_met)
{
    const uint first = get_global_id(0) * RAY_LANES, c = get_global_id(1);
    if (first >= count || c >= cell_count) return;
    const float sun[3] = {sun_x, sun_y, sun_z};
    ray_packet packet, shadow;
    ray_packet_hit met;
    uint lit = 0;

    ray_packet_clear(&packet, &world);
    for (uint i = 0; i < RAY_LANES && first + i < count; i++) {
        const hit_record at = hit[first + i];
        if (at.facet == RECORD_NONE) continue;
        const ray r = hemisphere_ray(&at, cell, c, &world);
        ray_packet_set(&packet, i, &r);
    }
    ray_packet_closest(nodes, blocks, &packet, &met);
    ray_packet_clear(&shadow, &world);
    for (uint i = 0; i < RAY_LANES; i++) {
        if (!(packet.alive >> i & 1)) continue;
        const ray r = ray_packet_get(&packet, i);
        const hit_record record = hemisphere_record(&r, ray_packet_hit_of(&met, i), &world, blocks);
        const float facing =
            record.normal[0] * sun_x + record.normal[1] * sun_y + record.normal[2] * sun_z;
        met.facet[i] = record.facet;
        if (record.facet == RECORD_NONE || !(sun_z > 0 && facing > 0)) continue;
        lit |= 1u << i;
        const ray towards_sun = ray_leaving(&world, record.point, record.normal, sun);
        if (record.facet != world.ground_facet) ray_packet_set(&shadow, i, &towards_sun);
    }
    lit &= ~ray_packet_any(nodes, blocks, &shadow);
    for (uint i = 0; i < RAY_LANES && first + i < count; i++) {
        const uint word = met.facet[i] | (lit >> i & 1 ? HEMISPHERE_LIT : 0);
        out_met[(size_t)c * count + first + i] = packet.alive >> i & 1 ? word : RECORD_NONE;
    }
}
