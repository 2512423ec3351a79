#include "kernels/rays/ray_order.h"
#include "kernels/rays/ray_pair.h"
#include "kernels/tables.h"

/* Tells which of any rays meet something.
 * Launch: (count / RAY_BATCH, rounded up). rays: (6, stride), stride >= count: origins, directions;
 * out_met: (count) 0 or 1. */
SHARED_BODY kernel void occluded(const uint count, const uint stride, TABLES(TREE_TABLES),
                                 global const float *rays, global uchar *out_met)
{
    const uint first = get_global_id(0) * RAY_BATCH;
    if (first >= count) return;
    const uint batch = min(count - first, (uint)RAY_BATCH);
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    ushort order[RAY_BATCH];

    const uint sorted = ray_order_of(rays + first + 3 * (size_t)stride, stride, batch, order);
    for (uint at = 0; at < batch; at += 2 * RAY_LANES) {
        ray_packet packet[2];
        for (uint k = 0; k < 2; k++) {
            const uint from = at + k * RAY_LANES;
            const uint some = from < batch ? min(batch - from, (uint)RAY_LANES) : 0;
            packet[k] =
                ray_order_load(&tree.world, rays + first, stride, sorted, order, from, some);
        }
        const uint met = ray_pair_any(tree.nodes, tree.blocks, packet);
        for (uint i = 0; i < 2 * RAY_LANES && at + i < batch; i++) {
            const uint is_met = met >> (i / RAY_LANES * 16 + i % RAY_LANES) & 1;
            out_met[first + (sorted ? order[at + i] : at + i)] = (uchar)is_met;
        }
    }
}
