#include "ray_pair.h"
#include "ray_queue.h"

#define LANES_WIDTH RAY_LANES
#include "lanes.h"
#include "sun_history.h"

/* Up to so many of a packet wait for those of other suns. */
#define FEW_RAYS (RAY_LANES == 16 ? 11 : 0)

/* Neighbouring points, and their facets as the sun sees them. */
typedef struct lit_points {
    lanes point[3];
    lanes above[3];              /* from a point to where rays leave its facet's outward side */
    lanes normal[3];             /* of the facets, outward */
    uint met, two_sided, ground; /* a bit per lane */
} lit_points;

/* The outward side does not depend on whence the facet is seen. */
static lit_points take_points(const world_record *world, global const facet_record *facets,
                              global const hit_record *hit, const uint count)
{
    lit_points out = {.met = 0};

    for (int k = 0; k < 3; k++) out.point[k] = out.above[k] = out.normal[k] = (lanes)0.0f;
    for (uint i = 0; i < count; i++) {
        const hit_record at = hit[i];
        if (at.facet == RECORD_NONE) continue;
        const facet_record facet = facets[at.facet];
        const float outward = at.normal[0] * facet.normal[0] + at.normal[1] * facet.normal[1] +
                              at.normal[2] * facet.normal[2];
        const float side = outward < 0 ? -1.0f : 1.0f;
        out.met |= 1u << i;
        out.two_sided |= (uint)(facet.two_sided != 0) << i;
        out.ground |= (uint)(at.facet == world->ground_facet) << i;
        for (int k = 0; k < 3; k++) {
            LANES_SET(out.point[k], i, at.point[k]);
            LANES_SET(out.above[k], i, world->offset_m * (side * at.normal[k]));
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

/* Packets of full suns, of which two are cast together. */
typedef struct sun_pair {
    ray_packet packet[2];
    uint faced[2], slot[2], count;
} sun_pair;

static void cast_pair(sun_pair *pair, global const bvh_node *nodes, global const bvh_block *blocks,
                      uint bits[RAY_LANES])
{
    for (uint k = pair->count; k < 2; k++) pair->packet[k].alive = 0;
    const uint met = ray_pair_any(nodes, blocks, pair->packet);

    for (uint k = 0; k < pair->count; k++) {
        const uint lit = pair->faced[k] & ~(met >> 16 * k);
        for (uint i = 0; i < RAY_LANES; i++) bits[i] |= (lit >> i & 1u) << pair->slot[k];
    }
    pair->count = 0;
}

/* Casts the rays that wait, each marked by its slot and, five bits higher, its lane. */
static void cast_queue(ray_queue *waiting, global const bvh_node *nodes,
                       global const bvh_block *blocks, uint bits[RAY_LANES])
{
    const uint reached = ray_queue_cast(waiting, nodes, blocks);

    for (uint i = 0; i < RAY_LANES; i++)
        if (reached >> i & 1) bits[waiting->mark[i] >> 5] |= 1u << (waiting->mark[i] & 31);
}

/* Tells at which steps of a day the sun reaches points: a packet holds neighbouring points and one
 * sun, or where few points face it the rays of several suns.
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
    const uint lanes_here = min((uint)RAY_LANES, count - first);
    uint bits[RAY_LANES] = {0};

    const lit_points points = take_points(&world, facets, hit + first, lanes_here);
    ray_queue waiting = ray_queue_of(&world);
    sun_pair pair = {.count = 0};

    ray_packet_clear(&pair.packet[0], &world);
    ray_packet_clear(&pair.packet[1], &world);
    for (uint slot = 0; slot < 32 && points.met; slot++) {
        float direction[3];
        vstore3(vload4(32 * word + slot, sun).xyz, 0, direction);
        if (direction[2] <= 0) continue;
        ray_packet *packet = &pair.packet[pair.count];
        const uint faced = face_sun(&points, direction, packet);
        if (popcount(packet->alive) > FEW_RAYS) {
            pair.faced[pair.count] = faced;
            pair.slot[pair.count++] = slot;
            if (pair.count == 2) cast_pair(&pair, nodes, blocks, bits);
            continue;
        }
        for (uint i = 0; i < RAY_LANES; i++) {
            bits[i] |= (faced & ~packet->alive) >> i & 1u ? 1u << slot : 0u;
            if (!(packet->alive >> i & 1)) continue;
            const ray r = ray_packet_get(packet, i);
            if (ray_queue_add(&waiting, &r, i << 5 | slot))
                cast_queue(&waiting, nodes, blocks, bits);
        }
    }
    cast_pair(&pair, nodes, blocks, bits);
    cast_queue(&waiting, nodes, blocks, bits);
    for (uint i = 0; i < lanes_here; i++) lit[(size_t)(first + i) * day.stride + word] = bits[i];
}
