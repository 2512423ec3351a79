#include "ray.h"

/* Finds the nearest facet along any rays.
 * Launch: (count). ray: (count, 6) origin, direction; out_range: (count) in lengths of the
 * direction, INFINITY for a miss; out_facet: (count). */
kernel void trace(const uint count, const world_record world, global const bvh_node *nodes,
                  global const bvh_block *blocks, global const float *rays, global float *out_range,
                  global uint *out_facet)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    ray r = {.limit = MAXFLOAT, .cull_back = world.cull_back};
    vstore3(vload3(2 * i, rays), 0, r.origin);
    vstore3(vload3(2 * i + 1, rays), 0, r.direction);
    const ray_hit hit = ray_closest(nodes, blocks, &r);
    out_range[i] = hit.range;
    out_facet[i] = hit.facet;
}
