#include "ray_packet.h"

/* Finds the nearest facet along any rays.
 * Launch: (count / RAY_LANES, rounded up). rays: (6, stride), stride >= count: origins, directions;
 * out_range: (count) in lengths of the direction, INFINITY for a miss; out_facet: (count). */
kernel void trace(const uint count, const uint stride, const world_record world,
                  global const bvh_node *nodes, global const bvh_block *blocks,
                  global const float *rays, global float *out_range, global uint *out_facet)
{
    const uint first = get_global_id(0) * RAY_LANES;
    if (first >= count) return;
    const ray_packet packet = ray_packet_load(&world, rays + first, stride, count - first);
    ray_packet_hit hit;

    ray_packet_closest(nodes, blocks, &packet, &hit);
    for (uint i = 0; i < RAY_LANES && first + i < count; i++) {
        out_range[first + i] = hit.range[i];
        out_facet[first + i] = hit.facet[i];
    }
}
