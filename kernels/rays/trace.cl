#include "kernels/rays/ray_order.h"
#include "kernels/tables.h"

/* Finds the nearest facet along any rays.
 * Launch: (count / RAY_BATCH, rounded up). rays: (6, stride), stride >= count: origins, directions;
 * out_range: (count) in lengths of the direction, INFINITY for a miss; out_facet: (count). */
SHARED_BODY kernel void trace(const uint count, const uint stride, TABLES(TREE_TABLES),
                              global const float *rays, global float *out_range,
                              global uint *out_facet)
{
    const uint first = get_global_id(0) * RAY_BATCH;
    if (first >= count) return;
    const uint batch = min(count - first, (uint)RAY_BATCH);
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    ushort order[RAY_BATCH];

    const uint sorted = ray_order_of(rays + first + 3 * (size_t)stride, stride, batch, order);
    for (uint at = 0; at < batch; at += RAY_LANES) {
        const uint some = min(batch - at, (uint)RAY_LANES);
        const ray_packet packet =
            ray_order_load(&tree.world, rays + first, stride, sorted, order, at, some);
        ray_packet_hit hit;
        ray_packet_closest(tree.nodes, tree.blocks, &packet, &hit);
        for (uint i = 0; i < some; i++) {
            const uint ray = first + (sorted ? order[at + i] : at + i);
            out_range[ray] = hit.range[i];
            out_facet[ray] = hit.facet[i];
        }
    }
}
