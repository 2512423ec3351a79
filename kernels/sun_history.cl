#include "ray_packet.h"
#include "sun_history.h"

/* The ray from a point towards the sun, from the side of the facet that the sun is on; returns 0
 * where the sun does not shine on a side that it heats. The outward side does not depend on whence
 * the facet is seen. */
static uint towards_sun(const world_record *world, const hit_record *at, const facet_record *facet,
                        const float sun[3], ray *out)
{
    const float outward = at->normal[0] * facet->normal[0] + at->normal[1] * facet->normal[1] +
                          at->normal[2] * facet->normal[2];
    const float facing =
        facet->normal[0] * sun[0] + facet->normal[1] * sun[1] + facet->normal[2] * sun[2];
    const float side = (outward < 0) == (facing < 0) ? 1.0f : -1.0f;
    const float normal[3] = {side * at->normal[0], side * at->normal[1], side * at->normal[2]};

    *out = ray_leaving(world, at->point, normal, sun);
    return facet->two_sided ? facing != 0 : facing > 0;
}

/* Tells at which steps of a day the sun reaches points: a packet holds neighbouring points and one
 * sun.
 * Launch: (count / RAY_LANES, rounded up; day.word_count).
 * sun: shape (32 day.word_count, 4), by slot: unit vector towards the sun, and 0; z 0 where the sun
 *   is down or the day has no such slot
 * facets: per facet, the ground's too; hit: (count); lit: (count, day.stride), the bits of which are
 *   written. The ground plane is never in shadow. */
kernel void sun_history(const uint count, const sun_day day, const world_record world,
                        global const bvh_node *nodes, global const bvh_block *blocks,
                        global const facet_record *facets, global const float *sun,
                        global const hit_record *hit, global uint *lit)
{
    const uint first = get_global_id(0) * RAY_LANES, word = get_global_id(1);
    if (first >= count) return;
    const uint lanes = min((uint)RAY_LANES, count - first);
    uint bits[RAY_LANES] = {0};

    for (uint slot = 0; slot < 32; slot++) {
        ray_packet packet;
        float direction[3];
        uint faced = 0;
        vstore3(vload4(32 * word + slot, sun).xyz, 0, direction);
        if (direction[2] <= 0) continue;
        ray_packet_clear(&packet, &world);
        for (uint i = 0; i < lanes; i++) {
            const hit_record at = hit[first + i];
            ray r;
            if (at.facet == RECORD_NONE) continue;
            const facet_record facet = facets[at.facet];
            if (!towards_sun(&world, &at, &facet, direction, &r)) continue;
            faced |= 1u << i;
            if (at.facet != world.ground_facet) ray_packet_set(&packet, i, &r);
        }
        if (faced == 0) continue;
        const uint reached = faced & ~ray_packet_any(nodes, blocks, &packet);
        for (uint i = 0; i < lanes; i++) bits[i] |= (reached >> i & 1u) << slot;
    }
    for (uint i = 0; i < lanes; i++) lit[(size_t)(first + i) * day.stride + word] = bits[i];
}
