/* Ray packet: finds what RAY_LANES neighbouring rays meet, with the answers of ray.h, bit for bit. On
 * CPUs a work-item has 16 rays, each a lane of float16; on GPUs it has one (RAY_LANES 1, ray.h).
 *
 * A node is first tested against the bounds of the packet, then each of its children against all
 * rays. Where few rays are left they go on one by one. A ray's answer never depends on its
 * neighbours: only tests that lose nothing (ray.h) are shared. */
#ifndef RAY_PACKET_H
#define RAY_PACKET_H

#include "kernels/rays/ray.h"

/* Groups of RAY_LANES points of a work-item that looks at several. */
#define RAY_GROUPS (RAY_LANES == 16 ? RAY_BUNDLE / 16 : 1)

/* Rays that share a world; a bit in `alive` per lane in use. */
typedef struct ray_packet {
    float origin[3][RAY_LANES] __attribute__((aligned(64)));
    float direction[3][RAY_LANES] __attribute__((aligned(64)));
    uint alive;
    uint cull_back;
    uint loose; /* 1: the rays soon part, so that single rays take over early */
} ray_packet;

/* What the lanes met, as ray_hit has it. */
typedef struct ray_packet_hit {
    float range[RAY_LANES] __attribute__((aligned(64)));
    uint facet[RAY_LANES] __attribute__((aligned(64)));
    uint triangle[RAY_LANES] __attribute__((aligned(64)));
} ray_packet_hit;

static inline void ray_packet_clear(ray_packet *p, const world_record *world)
{
    p->alive = 0;
    p->cull_back = world->cull_back;
    p->loose = 0;
}

static inline void ray_packet_set(ray_packet *p, const uint lane, const ray *r)
{
    UNROLL
    for (int k = 0; k < 3; k++) {
        p->origin[k][lane] = r->origin[k];
        p->direction[k][lane] = r->direction[k];
    }
    p->alive |= 1u << lane;
}

/* Takes RAY_LANES rays that lie by component, `stride` numbers each.
 *   rays   (6, stride), moved to the first of them: origins, directions */
static inline ray_packet ray_packet_load(const world_record *world, global const float *rays,
                                         const uint stride)
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = (1u << RAY_LANES) - 1;
    UNROLL
    for (uint k = 0; k < 3; k++) {
#if RAY_LANES == 16
        *(float16 *)p.origin[k] = vload16(0, rays + (size_t)k * stride);
        *(float16 *)p.direction[k] = vload16(0, rays + (size_t)(k + 3) * stride);
#else
        p.origin[k][0] = rays[(size_t)k * stride];
        p.direction[k][0] = rays[(size_t)(k + 3) * stride];
#endif
    }
    return p;
}

static inline ray ray_packet_get(const ray_packet *p, const uint lane)
{
    ray r = {.limit = MAXFLOAT, .cull_back = p->cull_back};

    UNROLL
    for (int k = 0; k < 3; k++) {
        r.origin[k] = p->origin[k][lane];
        r.direction[k] = p->direction[k][lane];
    }
    return r;
}

static inline ray_hit ray_packet_hit_of(const ray_packet_hit *hit, const uint lane)
{
    return (ray_hit){hit->range[lane], hit->facet[lane], hit->triangle[lane]};
}

#if RAY_LANES == 16

#include "kernels/rays/ray_leaf.h"

/* Where this many rays are left they go on one by one: below a node, and in a leaf. Measured: packets
 * that point to several octants, or were sorted, part sooner than those of neighbouring pixels. */
static inline uint ray_packet_few(const uint together, const uint in_leaf)
{
    if (together) return in_leaf ? 1 : 0;
    return 4;
}

/* A packet on its way through the tree; frames of single rays are made when they are needed. */
typedef struct ray_packet_walk {
    ray_lanes lanes;
    const ray_packet *packet;
    ray_frame frame[16];
    uint framed; /* a bit per frame that is made */
    uint together;
} ray_packet_walk;

/* Makes a packet ready; bounded: see ray_lanes_of. */
INLINE ray_packet_walk ray_packet_start(const ray_packet *p, const uint bounded)
{
    ray_packet_walk w;

    w.lanes = ray_lanes_of(p->origin, p->direction, p->alive, p->cull_back, bounded);
    w.packet = p;
    w.framed = 0;
    w.together = w.lanes.coherent && !p->loose;
    return w;
}

static inline const ray_frame *ray_packet_frame(ray_packet_walk *w, const uint lane)
{
    if (!(w->framed >> lane & 1)) {
        const ray r = ray_packet_get(w->packet, lane);
        w->frame[lane] = ray_frame_of(&r);
        w->framed |= 1u << lane;
    }
    return &w->frame[lane];
}

/* Lets single rays look for nearer triangles below a child word. */
static inline void ray_packet_closest_single(ray_packet_walk *w, global const bvh_node *nodes,
                                             global const bvh_block *blocks, const uint word,
                                             uint active, ray_leaf_nearest *best)
{
    const ray_leaf_nearest before = *best;

    while (active) {
        const uint lane = ray_lanes_next(&active);
        const ray_frame *f = ray_packet_frame(w, lane);
        ray_hit hit = ray_leaf_get(&before, lane);
        ray_closest_below(f, nodes, blocks, word, MAXFLOAT, &hit);
        ray_leaf_set(best, lane, hit);
    }
}

/* Looks for nearer triangles of the active lanes in a leaf. */
INLINE void ray_packet_closest_leaf(ray_packet_walk *w, global const bvh_node *nodes,
                                    global const bvh_block *blocks, const uint leaf,
                                    const int16 active, const uint rays, ray_leaf_nearest *best)
{
    const ray_lanes *f = &w->lanes;

    if (w->together && f->axis < 3 && popcount(rays) <= RAY_LEAF_FEW)
        ray_leaf_closest_two(f, blocks, leaf, f->axis, rays, best);
    else if (popcount(rays) <= ray_packet_few(w->together, 1))
        ray_packet_closest_single(w, nodes, blocks, leaf, rays, best);
    else if (f->axis == 3)
        ray_leaf_closest(f, blocks, leaf, 3, active, rays, best);
    else
        ray_leaf_closest(f, blocks, leaf, f->axis % 3, active, rays, best);
}

/* What is still to be visited: child words, and where the lanes enter them, nan where they do not. */
typedef struct ray_packet_stack {
    float16 entered[RAY_STACK_SIZE];
    uint word[RAY_STACK_SIZE];
} ray_packet_stack;

/* Puts the children that a lane enters on the stack, the nearest on top; returns its depth. */
INLINE uint ray_packet_open(const ray_lanes *f, global const bvh_node *nodes,
                            global const bvh_block *blocks, const uint word, const uint coherent,
                            const float16 limit, ray_packet_stack *stack, uint depth)
{
    global const bvh_node *node = nodes + word;
    const uint order = node->order[f->octant];
    const uint mask = coherent ? ray_lanes_reach(f, node) : 0xff;

    UNROLL
    for (int i = 28; i >= 0; i -= 4) {
        const uint child = order >> i & 7;
        if (!(mask >> child & 1)) continue;
        float16 range;
        const int16 enters = ray_lanes_enter(f, node, child, coherent, limit, &range);
        if (mask_of_16(enters) == 0) continue;
        ray_fetch(nodes, blocks, node->child[child]);
        stack->word[depth] = node->child[child];
        stack->entered[depth++] = enters ? range : (float16)NAN;
    }
    return depth;
}

/* Writes what the lanes met. */
static inline void ray_packet_write(const ray_leaf_nearest *best, ray_packet_hit *out)
{
    *(float16 *)out->range = as_int16(best->facet) == -1 ? (float16)INFINITY : best->range;
    *(uint16 *)out->facet = best->facet;
    *(uint16 *)out->triangle = best->triangle;
}

/* Finds the nearest triangle of each lane. */
static inline void ray_packet_closest(global const bvh_node *nodes, global const bvh_block *blocks,
                                      const ray_packet *p, ray_packet_hit *out)
{
    ray_packet_walk w;
    ray_packet_stack stack;
    ray_leaf_nearest best = {MAXFLOAT, RECORD_NONE, 0};
    int16 active = ray_lanes_of_mask(p->alive);
    uint word = 0, depth = 0;

    if (p->alive == 0) return;
    w = ray_packet_start(p, 1);
    best.range = active ? (float16)MAXFLOAT : (float16)-1.0f;
    for (;;) {
        const uint rays = mask_of_16(active);
        const float16 limit = best.range * RAY_SLACK;
        if (word & BVH_LEAF)
            ray_packet_closest_leaf(&w, nodes, blocks, word, active, rays, &best);
        else if (popcount(rays) <= ray_packet_few(w.together, 0))
            ray_packet_closest_single(&w, nodes, blocks, word, rays, &best);
        else if (w.lanes.coherent)
            depth = ray_packet_open(&w.lanes, nodes, blocks, word, 1, limit, &stack, depth);
        else
            depth = ray_packet_open(&w.lanes, nodes, blocks, word, 0, limit, &stack, depth);
        do {
            if (depth == 0) goto done;
            active = stack.entered[--depth] <= best.range * RAY_SLACK;
        } while (mask_of_16(active) == 0);
        word = stack.word[depth];
    }
done:
    ray_packet_write(&best, out);
}

/* Puts the children that an active lane enters on the stack, the lanes above the word. */
INLINE uint ray_packet_open_any(const ray_lanes *f, global const bvh_node *nodes,
                                global const bvh_block *blocks, const uint word,
                                const uint coherent, const uint active, ulong *stack, uint depth)
{
    global const bvh_node *node = nodes + word;
    uint mask = coherent ? ray_lanes_reach(f, node) : 0xff;

    while (mask) {
        const uint child = ray_lanes_next(&mask);
        float16 range;
        const int16 enters = ray_lanes_enter(f, node, child, coherent, MAXFLOAT, &range);
        const uint lanes = active & mask_of_16(enters);
        ray_fetch(nodes, blocks, node->child[child]);
        stack[depth] = (ulong)lanes << 32 | node->child[child];
        depth += lanes != 0;
    }
    return depth;
}

/* Lets single rays look for any triangle below a child word; a bit for each that met one. */
static inline uint ray_packet_any_single(ray_packet_walk *w, global const bvh_node *nodes,
                                         global const bvh_block *blocks, const uint word,
                                         uint active)
{
    uint met = 0;

    while (active) {
        const uint lane = ray_lanes_next(&active);
        const ray_frame *f = ray_packet_frame(w, lane);
        met |= ray_any_below(f, nodes, blocks, word, MAXFLOAT) << lane;
    }
    return met;
}

/* Tells which of the active lanes meet anything in a leaf: a bit each. */
INLINE uint ray_packet_any_leaf(ray_packet_walk *w, global const bvh_node *nodes,
                                global const bvh_block *blocks, const uint leaf, const uint active)
{
    const ray_lanes *f = &w->lanes;

    if (w->together && f->axis < 3 && popcount(active) <= RAY_LEAF_FEW)
        return ray_leaf_any_two(f, blocks, leaf, f->axis, active);
    if (popcount(active) <= ray_packet_few(w->together, 1))
        return ray_packet_any_single(w, nodes, blocks, leaf, active);
    if (f->axis == 3) return ray_leaf_any(f, blocks, leaf, 3, active);
    return ray_leaf_any(f, blocks, leaf, f->axis % 3, active);
}

/* Tells which lanes of a packet that was started meet anything: a bit each. */
static inline uint ray_packet_any_of(ray_packet_walk *w, global const bvh_node *nodes,
                                     global const bvh_block *blocks)
{
    const uint alive = w->packet->alive;
    ulong stack[RAY_STACK_SIZE];
    uint depth = 0, word = 0, active = alive, met = 0;

    for (;;) {
        if (word & BVH_LEAF)
            met |= ray_packet_any_leaf(w, nodes, blocks, word, active);
        else if (popcount(active) <= ray_packet_few(w->together, 0))
            met |= ray_packet_any_single(w, nodes, blocks, word, active);
        else if (w->lanes.coherent)
            depth = ray_packet_open_any(&w->lanes, nodes, blocks, word, 1, active, stack, depth);
        else
            depth = ray_packet_open_any(&w->lanes, nodes, blocks, word, 0, active, stack, depth);
        do {
            if (depth == 0 || met == alive) return met;
            active = (uint)(stack[--depth] >> 32) & ~met;
        } while (active == 0);
        word = (uint)stack[depth];
    }
}

/* Tells which lanes meet anything: a bit each. */
static inline uint ray_packet_any(global const bvh_node *nodes, global const bvh_block *blocks,
                                  const ray_packet *p)
{
    ray_packet_walk w;

    if (p->alive == 0) return 0;
    w = ray_packet_start(p, 1);
    return ray_packet_any_of(&w, nodes, blocks);
}

#else

static inline void ray_packet_closest(global const bvh_node *nodes, global const bvh_block *blocks,
                                      const ray_packet *p, ray_packet_hit *out)
{
    const ray r = ray_packet_get(p, 0);
    const ray_hit hit = ray_closest(nodes, blocks, &r);

    out->range[0] = hit.range;
    out->facet[0] = hit.facet;
    out->triangle[0] = hit.triangle;
}

static inline uint ray_packet_any(global const bvh_node *nodes, global const bvh_block *blocks,
                                  const ray_packet *p)
{
    const ray r = ray_packet_get(p, 0);

    return p->alive ? ray_any(nodes, blocks, &r) : 0;
}

#endif

#endif
