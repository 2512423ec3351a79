/* Ray pair: two packets of rays that ask whether anything stands in their way go through the tree
 * together. A node that both visit is opened once, and what one waits for is time for the other. The
 * answers are those of ray_packet.h. */
#ifndef RAY_PAIR_H
#define RAY_PAIR_H

#include "kernels/rays/ray_packet.h"

#if RAY_LANES == 16

/* The bounds of both packets, the first's in the low half. */
typedef struct ray_pair_bound {
    float16 reciprocal[2], near[2], far[2];
} ray_pair_bound;

/* Two packets of one octant on their way. */
typedef struct ray_pair_walk {
    ray_packet_walk of[2];
    ray_pair_bound bound[3];
} ray_pair_walk;

static inline void ray_pair_set_bounds(ray_pair_walk *w)
{
    UNROLL
    for (int k = 0; k < 3; k++) {
        const ray_lanes_bound *a = &w->of[0].lanes.bound[k], *b = &w->of[1].lanes.bound[k];
        ray_pair_bound *both = &w->bound[k];
        UNROLL
        for (int i = 0; i < 2; i++) {
            both->reciprocal[i] = (float16)((float8)a->reciprocal[i], (float8)b->reciprocal[i]);
            both->near[i] = (float16)((float8)a->near[i], (float8)b->near[i]);
            both->far[i] = (float16)((float8)a->far[i], (float8)b->far[i]);
        }
    }
}

/* Finds the children that a ray of either packet may enter: ray_lanes_reach for both. */
INLINE uint ray_pair_reach(const ray_pair_walk *w, global const bvh_node *node)
{
    const ray_lanes *f = &w->of[0].lanes;
    float16 from = 0, to = MAXFLOAT;

    UNROLL
    for (int k = 0; k < 3; k++) {
        const float8 near = *(global const float8 *)(node->low[0] + f->near_plane[k]);
        const float8 far = *(global const float8 *)(node->low[0] + f->far_plane[k]);
        const float16 a = (float16)(near, near), b = (float16)(far, far);
        const ray_pair_bound *n = &w->bound[k];
        from = ray_lanes_most(ray_lanes_least(fma(a, n->reciprocal[0], n->near[0]),
                                              fma(a, n->reciprocal[1], n->near[1])),
                              from);
        to = ray_lanes_least(ray_lanes_most(fma(b, n->reciprocal[0], n->far[0]),
                                            fma(b, n->reciprocal[1], n->far[1])),
                             to);
    }
    const uint mask = mask_of_16(from <= to);
    return (mask | mask >> 8) & 0xff;
}

/* Puts the children that an active lane enters on the stack, the lanes above the word. */
INLINE uint ray_pair_open(const ray_pair_walk *w, global const bvh_node *nodes,
                          global const bvh_block *blocks, const uint word, const uint active,
                          ulong *stack, uint depth)
{
    global const bvh_node *node = nodes + word;
    uint mask = ray_pair_reach(w, node);

    while (mask) {
        const uint child = ray_lanes_next(&mask);
        float16 range;
        const uint a =
            mask_of_16(ray_lanes_enter(&w->of[0].lanes, node, child, 1, MAXFLOAT, &range));
        const uint b =
            mask_of_16(ray_lanes_enter(&w->of[1].lanes, node, child, 1, MAXFLOAT, &range));
        const uint lanes = active & (a | b << 16);
        ray_fetch(nodes, blocks, node->child[child]);
        stack[depth] = (ulong)lanes << 32 | node->child[child];
        depth += lanes != 0;
    }
    return depth;
}

/* Tells which lanes meet anything in a leaf: a bit each. */
INLINE uint ray_pair_any_leaf(ray_pair_walk *w, global const bvh_node *nodes,
                              global const bvh_block *blocks, const uint leaf, const uint active)
{
    const uint a = active & 0xffff, b = active >> 16;
    uint met = 0;

    if (a) met = ray_packet_any_leaf(&w->of[0], nodes, blocks, leaf, a);
    if (b) met |= ray_packet_any_leaf(&w->of[1], nodes, blocks, leaf, b) << 16;
    return met;
}

/* Tells which lanes of two packets meet anything: a bit each, those of the second in the high half. */
static inline uint ray_pair_any(global const bvh_node *nodes, global const bvh_block *blocks,
                                const ray_packet *p)
{
    const uint alive = p[0].alive | p[1].alive << 16;
    ray_pair_walk w;
    ulong stack[RAY_STACK_SIZE];
    uint depth = 0, word = 0, active = alive, met = 0;

    if (p[0].alive == 0 || p[1].alive == 0)
        return ray_packet_any(nodes, blocks, &p[0]) | ray_packet_any(nodes, blocks, &p[1]) << 16;
    w.of[0] = ray_packet_start(&p[0], 1);
    w.of[1] = ray_packet_start(&p[1], 1);
    if (!(w.of[0].together && w.of[1].together && w.of[0].lanes.octant == w.of[1].lanes.octant))
        return ray_packet_any_of(&w.of[0], nodes, blocks) |
               ray_packet_any_of(&w.of[1], nodes, blocks) << 16;
    ray_pair_set_bounds(&w);
    for (;;) {
        if (word & BVH_LEAF)
            met |= ray_pair_any_leaf(&w, nodes, blocks, word, active);
        else
            depth = ray_pair_open(&w, nodes, blocks, word, active, stack, depth);
        do {
            if (depth == 0 || met == alive) return met;
            active = (uint)(stack[--depth] >> 32) & ~met;
        } while (active == 0);
        word = (uint)stack[depth];
    }
}

#else

static inline uint ray_pair_any(global const bvh_node *nodes, global const bvh_block *blocks,
                                const ray_packet *p)
{
    return ray_packet_any(nodes, blocks, &p[0]) | ray_packet_any(nodes, blocks, &p[1]) << 16;
}

#endif

#endif
