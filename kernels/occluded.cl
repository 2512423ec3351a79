#include "ray_order.h"

/* Tells which of any rays meet something.
 * Launch: (count / RAY_BATCH, rounded up). rays: (6, stride), stride >= count: origins, directions;
 * out_met: (count) 0 or 1. */
kernel void occluded(const uint count, const uint stride, const world_record world,
                     global const bvh_node *nodes, global const bvh_block *blocks,
                     global const float *rays, global uchar *out_met)
{
    const uint first = get_global_id(0) * RAY_BATCH;
    if (first >= count) return;
    const uint batch = min(count - first, (uint)RAY_BATCH);
    ushort order[RAY_BATCH];

    const uint sorted = ray_order_of(rays + first + 3 * (size_t)stride, stride, batch, order);
    for (uint at = 0; at < batch; at += RAY_LANES) {
        const uint some = min(batch - at, (uint)RAY_LANES);
        const ray_packet packet =
            ray_order_load(&world, rays + first, stride, sorted, order, at, some);
        const uint met = ray_packet_any(nodes, blocks, &packet);
        for (uint i = 0; i < some; i++)
            out_met[first + (sorted ? order[at + i] : at + i)] = (uchar)(met >> i & 1);
    }
}
