/* Ray beam: what parallel rays of neighbouring points meet. A beam as wide as all of them goes through
 * the tree once, eight boxes at a time, and lists the leaves on its way; packets of its rays then look
 * at these leaves alone. The answers are those of ray_packet.h. */
#ifndef RAY_BEAM_H
#define RAY_BEAM_H

#include "kernels/rays/ray_packet.h"

#if RAY_LANES == 16

/* Leaves of a list. */
#define RAY_BEAM_LEAVES 64

/* Where the rays of a beam begin, twice a ray's pad wider. */
typedef struct ray_beam_box {
    float low[3], high[3];
} ray_beam_box;

/* A beam made ready, as ray_frame has a ray. */
typedef struct ray_beam {
    float reciprocal[3], near[3], far[3];
    uint near_plane[3], far_plane[3]; /* where a node has them, counted in floats */
} ray_beam;

/* Leaves that a beam enters: the planes of their boxes that it meets first and last, and the child of
 * a node that each is. */
typedef struct ray_beam_list {
    float near[3][RAY_BEAM_LEAVES + 8], far[3][RAY_BEAM_LEAVES + 8];
    uint node[RAY_BEAM_LEAVES], child[RAY_BEAM_LEAVES];
    uint count;
} ray_beam_list;

/* The box of a packet's origins. */
static inline ray_beam_box ray_beam_box_of(const float16 origin[3], const uint alive)
{
    const uint first = 31 - clz(alive & -alive);
    const int16 in_use = ray_lanes_of_mask(alive);
    float16 all[8] = {0};
    float lowest[8], reach = 0;
    ray_beam_box box;

    UNROLL
    for (int k = 0; k < 3; k++) {
        const float some = ((const float *)&origin[k])[first];
        all[k] = in_use ? origin[k] : some;
        all[3 + k] = -all[k];
    }
    vstore8(ray_lanes_lowest(all), 0, lowest);
    UNROLL
    for (int k = 0; k < 6; k++) reach = fmax(reach, -lowest[k]);
    const float pad = 2.0f * RAY_PAD * reach;
    UNROLL
    for (int k = 0; k < 3; k++) {
        box.low[k] = lowest[k] - pad;
        box.high[k] = pad - lowest[3 + k];
    }
    return box;
}

static inline ray_beam_box ray_beam_join(const ray_beam_box *a, const ray_beam_box *b)
{
    ray_beam_box box;

    UNROLL
    for (int k = 0; k < 3; k++) {
        box.low[k] = fmin(a->low[k], b->low[k]);
        box.high[k] = fmax(a->high[k], b->high[k]);
    }
    return box;
}

/* A beam of the same direction from another box. */
static inline ray_beam ray_beam_from(ray_beam b, const ray_beam_box *box)
{
    UNROLL
    for (int k = 0; k < 3; k++) {
        const uint negative = b.reciprocal[k] < 0.0f;
        b.near[k] = -(negative ? box->low[k] : box->high[k]) * b.reciprocal[k];
        b.far[k] = -(negative ? box->high[k] : box->low[k]) * b.reciprocal[k];
    }
    return b;
}

static inline ray_beam ray_beam_of(const ray_beam_box *box, const float direction[3])
{
    ray_beam b;

    UNROLL
    for (int k = 0; k < 3; k++) {
        b.reciprocal[k] = ray_reciprocal(direction[k]);
        b.near_plane[k] = 8 * k + 24 * (b.reciprocal[k] < 0.0f);
        b.far_plane[k] = 8 * k + 24 * !(b.reciprocal[k] < 0.0f);
    }
    return ray_beam_from(b, box);
}

/* Finds which of eight boxes a ray of the beam may enter: a bit each, and where. */
static inline uint ray_beam_enters(const ray_beam *b, const float8 near[3], const float8 far[3],
                                   float8 *out_range)
{
    float8 from = 0, to = MAXFLOAT;

    UNROLL
    for (int k = 0; k < 3; k++) {
        from = ray_most(fma(near[k], (float8)b->reciprocal[k], (float8)b->near[k]), from);
        to = ray_least(fma(far[k], (float8)b->reciprocal[k], (float8)b->far[k]), to);
    }
    *out_range = from;
    return mask_of_8(from <= to);
}

/* Lists the leaves that rays of the beam may enter. Returns 0 where there are too many. */
static inline uint ray_beam_collect(const ray_beam *b, global const bvh_node *nodes,
                                    ray_beam_list *list)
{
    uint stack[RAY_STACK_SIZE];
    uint depth = 0, word = 0;

    list->count = 0;
    for (;;) {
        global const bvh_node *node = nodes + word;
        global const float *planes = node->low[0];
        float8 near[3], far[3], range;
        UNROLL
        for (int k = 0; k < 3; k++) {
            near[k] = *(global const float8 *)(planes + b->near_plane[k]);
            far[k] = *(global const float8 *)(planes + b->far_plane[k]);
        }
        const uint mask = ray_beam_enters(b, near, far, &range);
        const uint is_leaf = mask_of_8(*(global const int8 *)node->child);
        for (uint inner = mask & ~is_leaf; inner;)
            stack[depth++] = node->child[ray_lanes_next(&inner)];
        for (uint leaves = mask & is_leaf; leaves;) {
            const uint child = ray_lanes_next(&leaves);
            if (list->count == RAY_BEAM_LEAVES) return 0;
            UNROLL
            for (int k = 0; k < 3; k++) {
                list->near[k][list->count] = planes[b->near_plane[k] + child];
                list->far[k][list->count] = planes[b->far_plane[k] + child];
            }
            list->node[list->count] = word;
            list->child[list->count++] = child;
        }
        if (depth == 0) return 1;
        word = stack[--depth];
    }
}

/* Finds which leaves first .. first + 7 of a list rays of the beam may enter: a bit each, and where. */
static inline uint ray_beam_pick(const ray_beam *b, const ray_beam_list *list, const uint first,
                                 float8 *out_range)
{
    const uint left = list->count - first;
    float8 near[3], far[3];

    UNROLL
    for (int k = 0; k < 3; k++) {
        near[k] = vload8(0, list->near[k] + first);
        far[k] = vload8(0, list->far[k] + first);
    }
    return ray_beam_enters(b, near, far, out_range) & (left < 8 ? (1u << left) - 1 : 0xff);
}

/* Puts those leaves of a list in order that rays of the beam may enter, the nearest first: the range
 * above the number of the leaf. Returns how many these are. */
static inline uint ray_beam_sort(const ray_beam *b, const ray_beam_list *list,
                                 ulong out[RAY_BEAM_LEAVES])
{
    uint count = 0;

    for (uint first = 0; first < list->count; first += 8) {
        float8 range;
        float entered[8];
        uint mask = ray_beam_pick(b, list, first, &range);
        vstore8(range, 0, entered);
        while (mask) {
            const uint i = ray_lanes_next(&mask);
            const ulong entry = (ulong)as_uint(entered[i]) << 32 | (first + i);
            uint place = count++;
            for (; place > 0 && out[place - 1] > entry; place--) out[place] = out[place - 1];
            out[place] = entry;
        }
    }
    return count;
}

/* The farthest of the lanes. */
static inline float ray_beam_farthest(const float16 range)
{
    const float16 eights = ray_lanes_most(range, range.s89abcdef01234567);
    const float16 fours = ray_lanes_most(eights, eights.s4567012389abcdef);

    return fmax(fmax(fours.s0, fours.s1), fmax(fours.s2, fours.s3));
}

/* Finds the nearest triangle of each lane of a packet.
 *   leaf   `count` leaves of a list that holds the packet's rays, as ray_beam_sort has them */
static inline void ray_beam_closest(const ray_beam_list *list, const ulong *leaf, const uint count,
                                    global const bvh_node *nodes, global const bvh_block *blocks,
                                    const ray_packet *p, ray_packet_hit *out)
{
    const int16 alive = ray_lanes_of_mask(p->alive);
    ray_leaf_nearest best = {MAXFLOAT, RECORD_NONE, 0};
    ray_packet_walk w = ray_packet_start(p, 0);
    float limit = MAXFLOAT;

    best.range = alive ? (float16)MAXFLOAT : (float16)-1.0f;
    for (uint i = 0; i < count && as_float((uint)(leaf[i] >> 32)) <= limit; i++) {
        const uint at = (uint)leaf[i], child = list->child[at];
        global const bvh_node *node = nodes + list->node[at];
        float16 range;
        const int16 active =
            alive & ray_lanes_enter(&w.lanes, node, child, 1, best.range * RAY_SLACK, &range);
        const uint rays = mask_of_16(active);
        if (rays == 0) continue;
        ray_packet_closest_leaf(&w, nodes, blocks, node->child[child], active, rays, &best);
        limit = ray_beam_farthest(best.range) * RAY_SLACK;
    }
    ray_packet_write(&best, out);
}

/* Tells which lanes of a packet meet anything: a bit each.
 *   b   as wide as the packet's rays; list: of a beam that holds them */
static inline uint ray_beam_any(const ray_beam *b, const ray_beam_list *list,
                                global const bvh_node *nodes, global const bvh_block *blocks,
                                const ray_packet *p)
{
    ray_packet_walk w;
    uint met = 0, started = 0;

    for (uint first = 0; first < list->count && met != p->alive; first += 8) {
        float8 range;
        uint mask = ray_beam_pick(b, list, first, &range);
        while (mask && met != p->alive) {
            const uint at = first + ray_lanes_next(&mask), child = list->child[at];
            global const bvh_node *node = nodes + list->node[at];
            float16 from;
            if (!started) w = ray_packet_start(p, 0);
            started = 1;
            const uint active =
                p->alive & ~met &
                mask_of_16(ray_lanes_enter(&w.lanes, node, child, 1, MAXFLOAT, &from));
            if (active) met |= ray_packet_any_leaf(&w, nodes, blocks, node->child[child], active);
        }
    }
    return met;
}

#endif

#endif
