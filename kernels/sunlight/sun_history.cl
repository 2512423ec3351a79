#include "kernels/rays/ray_beam.h"

#include "kernels/lanes.h"
#include "kernels/sunlight/sun_history.h"
#include "kernels/tables.h"

/* Neighbouring points, and their facets as the sun sees them. */
typedef struct lit_points {
    lanes point[3];
    lanes above[3];              /* from a point to where rays leave its facet's outward side */
    lanes normal[3];             /* of the facets, outward */
    uint met, two_sided, ground; /* a bit per lane */
} lit_points;

/* The outward side does not depend on whence the facet is seen. */
static lit_points take_points(const world_record *world, global const facet_record *facets,
                              global const hit_record *hit, global const uint *order,
                              const uint first, const uint count)
{
    lit_points out = {.met = 0};

    for (int k = 0; k < 3; k++) out.point[k] = out.above[k] = out.normal[k] = (lanes)0.0f;
    for (uint i = 0; i < RAY_LANES && first + i < count; i++) {
        const hit_record at = hit[order ? order[first + i] : first + i];
        if (at.facet == RECORD_NONE) continue;
        const facet_record facet = facets[at.facet];
        const float outward = at.normal[0] * facet.normal[0] + at.normal[1] * facet.normal[1] +
                              at.normal[2] * facet.normal[2];
        const float side = outward < 0 ? -1.0f : 1.0f;
        const float offset_m = ray_offset(world, at.point, at.normal);
        out.met |= 1u << i;
        out.two_sided |= (uint)(facet.two_sided != 0) << i;
        out.ground |= (uint)(at.facet == world->ground_facet) << i;
        for (int k = 0; k < 3; k++) {
            LANES_SET(out.point[k], i, at.point[k]);
            LANES_SET(out.above[k], i, offset_m * (side * at.normal[k]));
            LANES_SET(out.normal[k], i, facet.normal[k]);
        }
    }
    return out;
}

/* Makes the rays from points towards the sun, each from the side of its facet that the sun is on;
 * returns the lanes where the sun shines on a side that it heats. */
static uint face_sun(const lit_points *from, const float sun[3], ray_packet *out)
{
    const lanes facing =
        (from->normal[0] * sun[0] + from->normal[1] * sun[1]) + from->normal[2] * sun[2];
    const uint front = lanes_bits_of(facing > 0.0f), back = lanes_bits_of(facing < 0.0f);
    const uint faced = from->met & (front | (back & from->two_sided));

    out->alive = faced & ~from->ground;
    for (int k = 0; k < 3; k++) {
        const lanes up = facing < 0.0f ? -from->above[k] : from->above[k];
        lanes_write(from->point[k] + up, out->origin[k]);
        lanes_write((lanes)sun[k], out->direction[k]);
    }
    return faced;
}

/* The rays of groups of points towards one sun. */
typedef struct sun_rays {
    ray_packet packet[RAY_GROUPS];
    uint faced[RAY_GROUPS]; /* a bit per lane where the sun shines on a side that it heats */
    uint met[RAY_GROUPS];   /* a bit per lane that something shades */
    uint wait;              /* suns before a beam is tried again */
} sun_rays;

#if RAY_LANES == 16

/* The box of where rays leave the outward sides of facets. */
static ray_beam_box box_outside(const lit_points *points)
{
    lanes origin[3];

    for (int k = 0; k < 3; k++) origin[k] = points->point[k] + points->above[k];
    return ray_beam_box_of(origin, points->met);
}

/* The box of where a group's rays begin.
 *   outside   of all its points */
static ray_beam_box box_of(const lit_points *points, const ray_packet *packet,
                           const ray_beam_box *outside)
{
    lanes origin[3];

    if (!(packet->alive & points->two_sided)) return *outside;
    for (int k = 0; k < 3; k++) origin[k] = lanes_read(packet->origin[k]);
    return ray_beam_box_of(origin, packet->alive);
}

/* Suns without a beam after one that entered too much, as the next ones are likely to do. */
#define WAIT 3

/* Casts the rays as a beam: it lists what they may meet, unless that is too much. */
static void cast(sun_rays *rays, const lit_points *points, const ray_beam_box *outside,
                 const uint groups, const float sun[3], const tree_tables *tree)
{
    ray_beam_box box[RAY_GROUPS], all;
    ray_beam_list list;
    uint some = 0;

    for (uint g = 0; g < groups; g++) {
        rays->met[g] = 0;
        if (rays->packet[g].alive == 0) continue;
        box[g] = box_of(&points[g], &rays->packet[g], &outside[g]);
        all = some++ ? ray_beam_join(&all, &box[g]) : box[g];
    }
    if (some == 0) return;
    const ray_beam beam = ray_beam_of(&all, sun);
    const uint listed = rays->wait == 0 && ray_beam_collect(&beam, tree->nodes, &list);
    rays->wait = listed ? 0 : rays->wait ? rays->wait - 1 : WAIT;
    if (listed && list.count == 0) return;
    for (uint g = 0; g < groups; g++) {
        if (rays->packet[g].alive == 0) continue;
        const ray_beam own = ray_beam_from(beam, &box[g]);
        rays->met[g] = listed
                           ? ray_beam_any(&own, &list, tree->nodes, tree->blocks, &rays->packet[g])
                           : ray_packet_any(tree->nodes, tree->blocks, &rays->packet[g]);
    }
}

#endif

/* Tells at which steps of a day the sun reaches points: neighbouring points go together, one sun after
 * the other.
 * Launch: (count / RAY_BUNDLE where RAY_LANES is 16, else count, rounded up; day.word_count).
 * sun: shape (32 day.word_count, 4), by slot: unit vector towards the sun, and 0; z 0 where the sun
 *   is down or the day has no such slot
 * facets: per facet, the ground's too; hit: (count); order: (count), which points stand side by side,
 *   NULL: as they are; lit: (count, day.stride), the bits of which are written. The ground plane is
 *   never in shadow. */
SHARED_BODY kernel void sun_history(const uint count, const sun_day day, TABLES(TREE_TABLES),
                                    global const facet_record *facets, global const float *sun,
                                    global const hit_record *hit, OPTIONAL global const uint *order,
                                    global uint *lit)
{
    const uint first = get_global_id(0) * RAY_GROUPS * RAY_LANES, word = get_global_id(1);
    if (first >= count) return;
    const uint left = min((uint)(RAY_GROUPS * RAY_LANES), count - first);
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    uint bits[RAY_GROUPS * RAY_LANES] = {0};
    lit_points points[RAY_GROUPS];
    sun_rays rays = {.wait = 0};
    uint groups = 0;

    for (; groups * RAY_LANES < left; groups++)
        points[groups] =
            take_points(&tree.world, facets, hit, order, first + groups * RAY_LANES, count);
#if RAY_LANES == 16
    ray_beam_box outside[RAY_GROUPS];
    for (uint g = 0; g < groups; g++)
        if (points[g].met) outside[g] = box_outside(&points[g]);
#endif
    for (uint slot = 0; slot < 32; slot++) {
        float direction[3];
        vstore3(vload4(32 * word + slot, sun).xyz, 0, direction);
        if (direction[2] <= 0) continue;
        for (uint g = 0; g < groups; g++) {
            ray_packet_clear(&rays.packet[g], &tree.world);
            rays.faced[g] = face_sun(&points[g], direction, &rays.packet[g]);
        }
#if RAY_LANES == 16
        cast(&rays, points, outside, groups, direction, &tree);
#else
        rays.met[0] = ray_packet_any(tree.nodes, tree.blocks, &rays.packet[0]);
#endif
        for (uint i = 0; i < left; i++) {
            const uint g = i / RAY_LANES, is_lit = rays.faced[g] & ~rays.met[g];
            bits[i] |= (is_lit >> i % RAY_LANES & 1u) << slot;
        }
    }
    for (uint i = 0; i < left; i++) {
        const uint point = order ? order[first + i] : first + i;
        lit[(size_t)point * day.stride + word] = bits[i];
    }
}
