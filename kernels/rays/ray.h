/* Ray: finds what one ray meets, eight boxes or triangles at a time. Layout: records.h. The scalar
 * twin of its triangle test is triangle.h.
 *
 * Nothing is lost to rounding: boxes are wider than the triangles by what the edge test can be off
 * by (8 roundings of the largest coordinate, the scene's added by bvh.c and the origin's here), and
 * a box is entered up to 2^-20 beyond the nearest range. Of equal ranges the lowest facet is taken,
 * so that the answer does not depend on the order of the tree. */
#ifndef RAY_H
#define RAY_H

#include "kernels/mask.h"
#include "kernels/rays/triangle.h"
#include "kernels/records.h"

/* Ranges count in lengths of the direction, which need not be unit. */
typedef struct ray {
    float origin[3], direction[3];
    float limit;    /* met up to this range, and beyond 0 */
    uint cull_back; /* 1: triangles seen clockwise are not met */
} ray;

/* What was met. */
typedef struct ray_hit {
    float range;   /* INFINITY for a miss */
    uint facet;    /* RECORD_NONE for a miss */
    uint triangle; /* block * 8 + lane, and RAY_LONG where it is long */
} ray_hit;

#define RAY_DONE 0xffffffffu
#define RAY_LONG 0x80000000u

/* Boxes are entered up to this many times the nearest range. */
#define RAY_SLACK (1.0f + 9.5367431640625e-7f)

/* How much wider boxes are for a ray, by the largest coordinate of its origin: 8 roundings. */
#define RAY_PAD 4.76837158203125e-7f

/* A ray made ready. A plane of a box at p is passed at p * reciprocal + near or far. */
typedef struct ray_frame {
    triangle_shear shear;
    float origin[3]; /* by the axes of the shear */
    float reciprocal[3], near[3], far[3];
    uint is_negative[3];
    float start[3], direction[3]; /* by those of the world */
    float back;                   /* edges are met from 0 up and from back down */
} ray_frame;

/* The reciprocal of a part of a direction; of 0 a large number. */
static inline float ray_reciprocal(const float d)
{
    return 1.0f / (fabs(d) < 1e-18f ? copysign(1e-18f, d) : d);
}

static inline ray_frame ray_frame_of(const ray *r)
{
    ray_frame f;
    float reach = 0;

    f.shear = triangle_shear_of(r->direction);
    f.origin[0] = r->origin[f.shear.x];
    f.origin[1] = r->origin[f.shear.y];
    f.origin[2] = r->origin[f.shear.z];
    f.back = r->cull_back ? -INFINITY : 0.0f;
    UNROLL
    for (int k = 0; k < 3; k++) {
        reach = fmax(reach, fabs(r->origin[k]));
        f.start[k] = r->origin[k];
        f.direction[k] = r->direction[k];
    }
    UNROLL
    for (int k = 0; k < 3; k++) {
        const float pad = RAY_PAD * reach;
        f.reciprocal[k] = ray_reciprocal(r->direction[k]);
        f.near[k] = -r->origin[k] * f.reciprocal[k] - pad * fabs(f.reciprocal[k]);
        f.far[k] = -r->origin[k] * f.reciprocal[k] + pad * fabs(f.reciprocal[k]);
        f.is_negative[k] = f.reciprocal[k] < 0;
    }
    return f;
}

static inline float8 ray_least(const float8 a, const float8 b)
{
    return a < b ? a : b;
}

static inline float8 ray_most(const float8 a, const float8 b)
{
    return a > b ? a : b;
}

/* Finds the children whose boxes the ray enters before `limit`: a bit each, and where. */
static inline uint ray_enters(const ray_frame *f, global const bvh_node *node, const float limit,
                              float8 *out_range)
{
    float8 from = 0, to = limit;

    UNROLL
    for (int k = 0; k < 3; k++) {
        global const float *low = node->low[k], *high = node->high[k];
        const float8 a = *(global const float8 *)(f->is_negative[k] ? high : low);
        const float8 b = *(global const float8 *)(f->is_negative[k] ? low : high);
        from = ray_most(fma(a, (float8)f->reciprocal[k], (float8)f->near[k]), from);
        to = ray_least(fma(b, (float8)f->reciprocal[k], (float8)f->far[k]), to);
    }
    *out_range = from;
    return mask_of_8(from <= to);
}

/* The first block of a leaf. */
static inline uint ray_block_of(const uint leaf)
{
    return (leaf & ~BVH_LEAF) >> 4;
}

/* How many of the first triangles of a leaf are long: rounding may spoil their ranges. */
static inline uint ray_long_of(const uint leaf)
{
    const uint count = leaf >> 1 & BVH_LONG_LIMIT;

    return count < BVH_LONG_LIMIT ? count : 8;
}

/* What a hit tells of a leaf's triangle. */
static inline uint ray_triangle_of(const uint leaf, const uint lane)
{
    return (ray_block_of(leaf) * 8 + lane) | (lane < ray_long_of(leaf) ? RAY_LONG : 0);
}

/* A triangle of a block. */
static inline void ray_triangle(global const bvh_block *block, const uint lane, float out[3][3])
{
    UNROLL
    for (int v = 0; v < 3; v++) UNROLL
    for (int k = 0; k < 3; k++) out[v][k] = block->vertex[v][k][lane];
}

/* Puts the ranges of those triangles of a block right that are long and the ray is inside of: a bit
 * each. */
RARE float8 ray_ranges_of_long(const ray_frame *f, global const bvh_block *block, uint inside,
                               const float limit, const float8 range)
{
    float better[8], vertex[3][3];

    vstore8(range, 0, better);
    for (; inside; inside &= inside - 1) {
        const uint i = 31 - clz(inside & -inside);
        ray_triangle(block, i, vertex);
        better[i] = triangle_range(vertex, f->start, f->direction, &f->shear, limit);
    }
    return vload8(0, better);
}

/* Eight triangles as a sheared ray sees them: triangle_sight of each. */
typedef struct ray_sight {
    float8 x[3], y[3], z[3], edge[3];
} ray_sight;

static inline ray_sight ray_see(const ray_frame *f, global const bvh_block *block)
{
    const triangle_shear s = f->shear;
    ray_sight t;

    UNROLL
    for (int v = 0; v < 3; v++) {
        t.z[v] = *(global const float8 *)block->vertex[v][s.z] - f->origin[2];
        t.x[v] =
            (*(global const float8 *)block->vertex[v][s.x] - f->origin[0]) - s.slope_x * t.z[v];
        t.y[v] =
            (*(global const float8 *)block->vertex[v][s.y] - f->origin[1]) - s.slope_y * t.z[v];
    }
    t.edge[0] = t.x[2] * t.y[1] - t.y[2] * t.x[1];
    t.edge[1] = t.x[0] * t.y[2] - t.y[0] * t.x[2];
    t.edge[2] = t.x[1] * t.y[0] - t.y[1] * t.x[0];
    return t;
}

static inline float8 ray_determinant(const ray_sight *t)
{
    return (t->edge[0] + t->edge[1]) + t->edge[2];
}

/* The ranges of triangles; those of long ones that the ray is inside of, a bit each, are put right.
 *   leaf   the child word that has the block */
static inline float8 ray_ranges(const ray_frame *f, const ray_sight *t,
                                global const bvh_block *block, const uint leaf, const uint inside,
                                const float limit)
{
    const float8 along = (t->edge[0] * t->z[0] + t->edge[1] * t->z[1]) + t->edge[2] * t->z[2];
    const float8 range = along * f->shear.scale_z / ray_determinant(t);
    const uint among_long = inside & ((1u << ray_long_of(leaf)) - 1);

    return among_long ? ray_ranges_of_long(f, block, among_long, limit, range) : range;
}

/* Finds the triangles that the ray meets up to `limit`: a bit each, and where. */
static inline uint ray_meets(const ray_frame *f, global const bvh_block *block, const uint leaf,
                             const float limit, float8 *out_range)
{
    const ray_sight t = ray_see(f, block);
    const float8 a = t.edge[0], b = t.edge[1], c = t.edge[2];
    const int8 front = ray_least(ray_least(a, b), c) >= 0.0f;
    const int8 back = ray_most(ray_most(a, b), c) <= f->back;
    const uint inside = mask_of_8(front | back);
    if (inside == 0) return 0;
    const float8 range = ray_ranges(f, &t, block, leaf, inside, limit);
    *out_range = range;
    return inside & mask_of_8((range > 0.0f) & (range <= limit));
}

/* Asks for the memory of a child that will soon be visited: the five lines of a block, or the four of a
 * node and one more. */
static inline void ray_fetch(global const bvh_node *nodes, global const bvh_block *blocks,
                             const uint word)
{
#if defined(__AVX__) && !defined(RAY_PORTABLE)
    global const char *at = word & BVH_LEAF ? (global const char *)(blocks + ray_block_of(word))
                                            : (global const char *)(nodes + word);
    UNROLL
    for (int line = 0; line < 5; line++) __builtin_prefetch((const void *)(size_t)(at + 64 * line));
#else
    (void)nodes, (void)blocks, (void)word;
#endif
}

/* A stack entry: the range where a box is entered, which orders as its bits do, above its child word.
 * Puts the children of the mask on the stack, the nearest on top. */
static inline uint ray_push_sorted(ulong *stack, const uint depth, global const bvh_node *nodes,
                                   global const bvh_block *blocks, global const uint *child,
                                   const float8 range, uint mask)
{
    float entered[8];
    uint top = depth;

    vstore8(range, 0, entered);
    for (; mask; mask &= mask - 1) {
        const uint i = 31 - clz(mask & -mask);
        const ulong entry = (ulong)as_uint(entered[i]) << 32 | child[i];
        uint place = top++;
        ray_fetch(nodes, blocks, child[i]);
        for (; place > depth && stack[place - 1] < entry; place--) stack[place] = stack[place - 1];
        stack[place] = entry;
    }
    return top;
}

/* Takes the next child that is entered before `limit`; RAY_DONE where there is none. */
static inline uint ray_pop(const ulong *stack, uint *depth, const float limit)
{
    while (*depth > 0) {
        const ulong entry = stack[--*depth];
        if (as_float((uint)(entry >> 32)) <= limit) return (uint)entry;
    }
    return RAY_DONE;
}

/* Looks for nearer triangles in a leaf. */
static inline void ray_visit_leaf(const ray_frame *f, global const bvh_block *blocks,
                                  const uint leaf, const float limit, ray_hit *hit)
{
    const uint first = ray_block_of(leaf), count = leaf & 1;

    for (uint b = first; b < first + count; b++) {
        float8 range;
        uint mask = ray_meets(f, blocks + b, leaf, fmin(hit->range, limit), &range);
        if (mask == 0) continue;
        float met[8];
        vstore8(range, 0, met);
        for (; mask; mask &= mask - 1) {
            const uint i = 31 - clz(mask & -mask);
            const uint facet = blocks[b].facet[i];
            if (met[i] > hit->range || (met[i] == hit->range && facet >= hit->facet)) continue;
            *hit = (ray_hit){met[i], facet, ray_triangle_of(leaf, i)};
        }
    }
}

/* How far boxes are entered where the nearest range is `range`. */
static inline float ray_reach(const float limit, const float range)
{
    return fmin(limit, range) * RAY_SLACK;
}

/* Looks for nearer triangles below a child word. */
static inline void ray_closest_below(const ray_frame *f, global const bvh_node *nodes,
                                     global const bvh_block *blocks, uint word, const float most,
                                     ray_hit *hit)
{
    ulong stack[RAY_STACK_SIZE];
    float limit = ray_reach(most, hit->range);
    uint depth = 0;

    while (word != RAY_DONE) {
        if (word & BVH_LEAF) {
            ray_visit_leaf(f, blocks, word, most, hit);
            limit = ray_reach(most, hit->range);
            word = ray_pop(stack, &depth, limit);
            continue;
        }
        float8 range;
        const uint mask = ray_enters(f, nodes + word, limit, &range);
        global const uint *child = nodes[word].child;
        if (mask == 0) {
            word = ray_pop(stack, &depth, limit);
        } else if ((mask & (mask - 1)) == 0) {
            word = child[31 - clz(mask)];
        } else {
            depth = ray_push_sorted(stack, depth, nodes, blocks, child, range, mask);
            word = (uint)stack[--depth];
        }
    }
}

/* Finds the nearest triangle. */
static inline ray_hit ray_closest(global const bvh_node *nodes, global const bvh_block *blocks,
                                  const ray *r)
{
    const ray_frame f = ray_frame_of(r);
    ray_hit hit = {INFINITY, RECORD_NONE, 0};

    ray_closest_below(&f, nodes, blocks, 0, r->limit, &hit);
    return hit;
}

/* Tells whether the ray meets anything below a child word. */
static inline uint ray_any_below(const ray_frame *f, global const bvh_node *nodes,
                                 global const bvh_block *blocks, const uint top, const float limit)
{
    uint stack[RAY_STACK_SIZE];
    uint depth = 1;

    stack[0] = top;
    while (depth > 0) {
        const uint word = stack[--depth];
        float8 range;
        if (word & BVH_LEAF) {
            const uint first = ray_block_of(word), count = word & 1;
            for (uint b = first; b < first + count; b++)
                if (ray_meets(f, blocks + b, word, limit, &range)) return 1;
            continue;
        }
        uint mask = ray_enters(f, nodes + word, limit, &range);
        for (; mask; mask &= mask - 1) stack[depth++] = nodes[word].child[31 - clz(mask & -mask)];
    }
    return 0;
}

/* Tells whether the ray meets anything: a bit, because which triangle it would meet first depends on
 * the order of the tree. */
static inline uint ray_any(global const bvh_node *nodes, global const bvh_block *blocks,
                           const ray *r)
{
    const ray_frame f = ray_frame_of(r);

    return ray_any_below(&f, nodes, blocks, 0, r->limit);
}

/* The record of a hit: its point from the weights of the vertices, which is nearer to the facet than
 * any point along a long ray; but that of a long triangle may be nearer along the ray. */
static inline hit_record ray_record(global const bvh_block *blocks, const ray *r, const ray_hit hit)
{
    const triangle_shear shear = triangle_shear_of(r->direction);
    hit_record record = {{0, 0, 0}, hit.range, hit.facet, {0, 0, 0}};
    float vertex[3][3], weight[3], range, along = 0;

    if (hit.facet == RECORD_NONE) return record;
    ray_triangle(blocks + (hit.triangle & ~RAY_LONG) / 8, hit.triangle % 8, vertex);
    triangle_meet(vertex, r->origin, &shear, &range, weight);
    triangle_normal(vertex, record.normal);
    UNROLL
    for (int k = 0; k < 3; k++) {
        record.point[k] =
            (weight[0] * vertex[0][k] + weight[1] * vertex[1][k]) + weight[2] * vertex[2][k];
        along += record.normal[k] * r->direction[k];
    }
    if (hit.triangle & RAY_LONG)
        triangle_point(vertex, r->origin, r->direction, &shear, record.point);
    UNROLL
    for (int k = 0; k < 3 && along > 0; k++) record.normal[k] = -record.normal[k];
    return record;
}

/* How far above a surface a ray starts that leaves it: by more than the rounding of its point, and of the
 * ranges of facets that are not long, so that a plane does not meet itself. */
static inline float ray_offset(const world_record *world, const float point[3],
                               const float normal[3])
{
    const float size =
        (fabs(point[0] * normal[0]) + fabs(point[1] * normal[1])) + fabs(point[2] * normal[2]);

    return fmax(world->offset_m, RAY_PAD * size);
}

/* A ray that leaves a surface. */
static inline ray ray_leaving(const world_record *world, const float point[3],
                              const float normal[3], const float direction[3])
{
    const float offset_m = ray_offset(world, point, normal);
    ray r = {.limit = MAXFLOAT, .cull_back = world->cull_back};

    UNROLL
    for (int k = 0; k < 3; k++) {
        r.origin[k] = point[k] + offset_m * normal[k];
        r.direction[k] = direction[k];
    }
    return r;
}

/* What goes down by no more than this of its direction counts as level: it meets no endless plane. */
#define RAY_LEVEL 1e-6f

/* Lets what missed the geometry and goes down meet the endless plane; returns 1 where it did. */
static inline uint ray_meet_ground(const world_record *world, const ray *r, hit_record *record)
{
    const float down = -r->direction[2];

    if (world->ground_facet == RECORD_NONE || down <= RAY_LEVEL) return 0;
    record->range_m = fmax((r->origin[2] - world->ground_z_m) / down, 0.0f);
    record->facet = world->ground_facet;
    UNROLL
    for (int k = 0; k < 3; k++) {
        record->point[k] = r->origin[k] + record->range_m * r->direction[k];
        record->normal[k] = k == 2;
    }
    record->point[2] = world->ground_z_m;
    return 1;
}

#endif
