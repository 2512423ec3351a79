#include "ray.h"

/* Finds what the camera sees through the centre of each pixel; thesis 2.5.3.
 * Launch: (count). Pixels are counted along the rows; out_hit: (count), ranges in metres. */
kernel void primary(const uint count, const uint first_pixel, const uint columns,
                    const camera_record camera, const world_record world,
                    global const bvh_node *nodes, global const bvh_block *blocks,
                    global hit_record *out_hit)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const uint column = (first_pixel + i) % columns, row = (first_pixel + i) / columns;
    const float3 direction =
        normalize(vload3(0, camera.corner) + ((float)column + .5f) * vload3(0, camera.across) +
                  ((float)row + .5f) * vload3(0, camera.down));
    ray r = {.limit = MAXFLOAT, .cull_back = world.cull_back};
    vstore3(vload3(0, camera.position), 0, r.origin);
    vstore3(direction, 0, r.direction);
    hit_record record = ray_record(blocks, &r, ray_closest(nodes, blocks, &r));
    if (record.facet == RECORD_NONE) ray_meet_ground(&world, &r, &record);
    out_hit[i] = record;
}
