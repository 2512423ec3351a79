#include "ray.h"

/* Tells which points the sun reaches.
 * Launch: (count). sun_x, sun_y, sun_z: unit vector towards the sun; hit: (count);
 * out_lit: (count) 0 or 1. */
kernel void sunlight(const uint count, const float sun_x, const float sun_y, const float sun_z,
                     const world_record world, global const bvh_node *nodes,
                     global const bvh_block *blocks, global const hit_record *hit,
                     global float *out_lit)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const hit_record at = hit[i];
    const float sun[3] = {sun_x, sun_y, sun_z};
    const ray r = ray_leaving(&world, at.point, at.normal, sun);
    const float facing = at.normal[0] * sun_x + at.normal[1] * sun_y + at.normal[2] * sun_z;
    uint lit = at.facet != RECORD_NONE && sun_z > 0 && facing > 0;
    if (lit && at.facet != world.ground_facet) lit = !ray_any(nodes, blocks, &r);
    out_lit[i] = (float)lit;
}
