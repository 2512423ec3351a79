#include "kernels/rays/ray_packet.h"
#include "kernels/tables.h"

/* Tells which points the sun reaches.
 * Launch: (count / RAY_LANES, rounded up). sun_x, sun_y, sun_z: unit vector towards the sun;
 * hit: (count); out_lit: (count) 0 or 1. */
SHARED_BODY kernel void sunlight(const uint count, const float sun_x, const float sun_y,
                                 const float sun_z, TABLES(TREE_TABLES),
                                 global const hit_record *hit, global float *out_lit)
{
    const uint first = get_global_id(0) * RAY_LANES;
    if (first >= count) return;
    const float sun[3] = {sun_x, sun_y, sun_z};
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    ray_packet packet;
    uint lit = 0;

    ray_packet_clear(&packet, &tree.world);
    for (uint i = 0; i < RAY_LANES && first + i < count; i++) {
        const hit_record at = hit[first + i];
        const ray r = ray_leaving(&tree.world, at.point, at.normal, sun);
        const float facing = at.normal[0] * sun_x + at.normal[1] * sun_y + at.normal[2] * sun_z;
        if (at.facet == RECORD_NONE || !(sun_z > 0 && facing > 0)) continue;
        lit |= 1u << i;
        if (at.facet != tree.world.ground_facet) ray_packet_set(&packet, i, &r);
    }
    lit &= ~ray_packet_any(tree.nodes, tree.blocks, &packet);
    for (uint i = 0; i < RAY_LANES && first + i < count; i++)
        out_lit[first + i] = (float)(lit >> i & 1);
}
