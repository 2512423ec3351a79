#include "kernels/rays/camera.h"
#include "kernels/rays/ray_packet.h"
#include "kernels/tables.h"

/* The pixels of a ray packet: a square of 4 x 4, which keeps the rays together. */
#define PRIMARY_SIDE (RAY_LANES == 16 ? 4u : 1u)

/* Finds what the camera sees through each pixel; thesis 2.5.3.
 * Launch: (columns, rows) / PRIMARY_SIDE, rounded up; rows: those that hold pixels first_pixel ..
 * first_pixel + count - 1, counted along the rows. Of several samples a pixel: (count / RAY_LANES,
 * rounded up). out_hit: (count), ranges in metres. */
SHARED_BODY kernel void primary(const uint count, const uint first_pixel, const uint columns,
                                const camera_record camera, TABLES(TREE_TABLES),
                                global hit_record *out_hit)
{
    const uint left = get_global_id(0) * PRIMARY_SIDE;
    const uint top = first_pixel / columns + get_global_id(1) * PRIMARY_SIDE;
    const uint is_sampled = camera.samples_per_side > 1u;
    if (!is_sampled && left >= columns) return;
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    ray_packet packet;
    ray_packet_hit hit;
    uint pixel[RAY_LANES];

    ray_packet_clear(&packet, &tree.world);
    for (uint i = 0; i < RAY_LANES; i++) {
        const uint column = left + i % PRIMARY_SIDE, row = top + i / PRIMARY_SIDE;
        pixel[i] =
            is_sampled ? get_global_id(0) * RAY_LANES + i : row * columns + column - first_pixel;
        if ((!is_sampled && column >= columns) || pixel[i] >= count) continue;
        ray r = {.limit = MAXFLOAT, .cull_back = tree.world.cull_back};
        camera_origin(camera, columns, first_pixel + pixel[i], r.origin);
        camera_direction(camera, columns, first_pixel + pixel[i], r.direction);
        vstore3(normalize(vload3(0, r.direction)), 0, r.direction);
        ray_packet_set(&packet, i, &r);
    }
    ray_packet_closest(tree.nodes, tree.blocks, &packet, &hit);
    for (uint i = 0; i < RAY_LANES; i++) {
        if (!(packet.alive >> i & 1)) continue;
        const ray r = ray_packet_get(&packet, i);
        hit_record record = ray_record(tree.blocks, &r, ray_packet_hit_of(&hit, i));
        if (record.facet == RECORD_NONE) ray_meet_ground(&tree.world, &r, &record);
        out_hit[pixel[i]] = record;
    }
}
