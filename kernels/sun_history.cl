#include "ray.h"
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

/* Tells at which steps of a day the sun reaches points.
 * Launch: (count, day.word_count).
 * sun: shape (32 day.word_count, 4), by slot: unit vector towards the sun, and 0; z 0 where the sun
 *   is down or the day has no such slot
 * facets: per facet, the ground's too; hit: (count); lit: (count, day.word_count). The ground plane
 *   is never in shadow. */
kernel void sun_history(const uint count, const sun_day day, const world_record world,
                        global const bvh_node *nodes, global const bvh_block *blocks,
                        global const facet_record *facets, global const float *sun,
                        global const hit_record *hit, global uint *lit)
{
    const uint i = get_global_id(0), word = get_global_id(1);
    if (i >= count) return;
    const hit_record at = hit[i];
    uint bits = 0;

    for (uint slot = 0; slot < 32 && at.facet != RECORD_NONE; slot++) {
        const facet_record facet = facets[at.facet];
        float direction[3];
        ray r;
        vstore3(vload4(32 * word + slot, sun).xyz, 0, direction);
        if (direction[2] <= 0 || !towards_sun(&world, &at, &facet, direction, &r)) continue;
        if (at.facet == world.ground_facet || !ray_any(nodes, blocks, &r)) bits |= 1u << slot;
    }
    lit[(size_t)i * day.word_count + word] = bits;
}
