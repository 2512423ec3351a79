#include "ray_packet.h"

/* Tells which of any rays meet something.
 * Launch: (count / RAY_LANES, rounded up). rays: (6, stride), stride >= count: origins, directions;
 * out_met: (count) 0 or 1. */
kernel void occluded(const uint count, const uint stride, const world_record world,
                     global const bvh_node *nodes, global const bvh_block *blocks,
                     global const float *rays, global uchar *out_met)
{
    const uint first = get_global_id(0) * RAY_LANES;
    if (first >= count) return;
    const ray_packet packet = ray_packet_load(&world, rays + first, stride, count - first);
    const uint met = ray_packet_any(nodes, blocks, &packet);

    for (uint i = 0; i < RAY_LANES && first + i < count; i++)
        out_met[first + i] = (uchar)(met >> i & 1);
}
