#include "ray.h"

/* Tells which of any rays meet something.
 * Launch: (count). ray: (count, 6) origin, direction; out_met: (count) 0 or 1. */
kernel void occluded(const uint count, const world_record world, global const bvh_node *nodes,
                     global const bvh_block *blocks, global const float *rays,
                     global uchar *out_met)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    ray r = {.limit = MAXFLOAT, .cull_back = world.cull_back};
    vstore3(vload3(2 * i, rays), 0, r.origin);
    vstore3(vload3(2 * i + 1, rays), 0, r.direction);
    out_met[i] = (uchar)ray_any(nodes, blocks, &r);
}
