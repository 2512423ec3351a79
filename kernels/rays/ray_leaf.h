/* Ray leaf: what the lanes of a packet meet in a leaf: one triangle at a time for all of them, or where
 * few are left all triangles for two at a time. The answers are the same, and those of ray.h. */
#ifndef RAY_LEAF_H
#define RAY_LEAF_H

#include "kernels/rays/ray_lanes.h"

/* Up to so many lanes go two at a time. Measured: 4 and 8 are slower on some mesh. */
#define RAY_LEAF_FEW 6

/* The nearest that the lanes have met so far. */
typedef struct ray_leaf_nearest {
    float16 range; /* MAXFLOAT where nothing was met, below 0 in lanes that are not alive */
    uint16 facet, triangle;
} ray_leaf_nearest;

/* Changes the nearest of one lane. */
static inline void ray_leaf_set(ray_leaf_nearest *best, const uint lane, const ray_hit hit)
{
    const int16 lanes = {0, 1, 2, 3, 4, 5, 6, 7, 8, 9, 10, 11, 12, 13, 14, 15};
    const int16 is_lane = lanes == (int)lane;

    best->range = is_lane ? hit.range : best->range;
    best->facet = as_uint16(is_lane) ? hit.facet : best->facet;
    best->triangle = as_uint16(is_lane) ? hit.triangle : best->triangle;
}

static inline ray_hit ray_leaf_get(const ray_leaf_nearest *best, const uint lane)
{
    return (ray_hit){((const float *)&best->range)[lane], ((const uint *)&best->facet)[lane],
                     ((const uint *)&best->triangle)[lane]};
}

/* Takes what is nearer on a triangle. */
INLINE void ray_leaf_take(ray_leaf_nearest *best, const float16 range, const int16 inside,
                          const uint triangle, const uint facet)
{
    const int16 met = inside & (range > 0.0f) & (range <= best->range);
    const int16 nearer = met & ((range < best->range) | ((uint16)facet < best->facet));

    best->range = nearer ? range : best->range;
    best->facet = as_uint16(nearer) ? (uint16)facet : best->facet;
    best->triangle = as_uint16(nearer) ? (uint16)triangle : best->triangle;
}

/* Looks for nearer triangles, all lanes at once.
 *   active, rays   the lanes that look: all bits of a lane, and a bit each */
INLINE void ray_leaf_closest(const ray_lanes *f, global const bvh_block *blocks, const uint leaf,
                             const uint axis, const int16 active, const uint rays,
                             ray_leaf_nearest *best)
{
    const uint b = ray_block_of(leaf), long_count = ray_long_of(leaf);

    for (uint i = 0; i < 8 && blocks[b].facet[i] != RECORD_NONE; i += 2) {
        ray_lanes_edges e[2];
        int16 inside[2];
        UNROLL
        for (uint k = 0; k < 2; k++) {
            e[k] = ray_lanes_edges_of_one(f, blocks + b, i + k, axis);
            inside[k] = ray_lanes_inside(&e[k], f->front, f->back);
        }
        if ((mask_of_16(inside[0] | inside[1]) & rays) == 0) continue;
        UNROLL
        for (uint k = 0; k < 2; k++) {
            const int16 own = active & inside[k];
            const float16 range = i + k < long_count
                                      ? ray_lanes_range(f, blocks + b, i + k, own, best->range)
                                      : e[k].distance / e[k].determinant;
            ray_leaf_take(best, range, own, ray_triangle_of(leaf, i + k), blocks[b].facet[i + k]);
        }
    }
}

/* Tells which lanes meet anything: a bit each.
 *   rays   of the lanes that look */
INLINE uint ray_leaf_any(const ray_lanes *f, global const bvh_block *blocks, const uint leaf,
                         const uint axis, const uint rays)
{
    global const bvh_block *block = blocks + ray_block_of(leaf);
    const uint long_count = ray_long_of(leaf);
    int16 met = 0;

    for (uint i = 0; i < 8 && block->facet[i] != RECORD_NONE; i++) {
        const ray_lanes_edges e = ray_lanes_edges_of_one(f, block, i, axis);
        const int16 inside = ray_lanes_inside(&e, f->front, f->back);
        if (i >= long_count)
            met |= inside & ray_lanes_before(&e);
        else if (mask_of_16(inside) & rays)
            met |= inside & (ray_lanes_range(f, block, i, inside, 0) > 0.0f);
    }
    return mask_of_16(met) & rays;
}

/* Looks for nearer triangles, two lanes at a time.
 *   rays   a bit per lane that looks */
INLINE void ray_leaf_closest_two(const ray_lanes *f, global const bvh_block *blocks,
                                 const uint leaf, const uint axis, uint rays,
                                 ray_leaf_nearest *best)
{
    const uint b = ray_block_of(leaf), among_long = ((1u << ray_long_of(leaf)) - 1) * 0x101;
    const ray_leaf_nearest before = *best;

    while (rays) {
        uint lane[2];
        lane[0] = ray_lanes_next(&rays);
        lane[1] = rays ? ray_lanes_next(&rays) : lane[0];
        const ray_lanes_edges e = ray_lanes_edges_of_two(f, blocks + b, lane[0], lane[1], axis);
        const float16 range = e.distance / e.determinant;
        const int16 inside = ray_lanes_inside(&e, ray_lanes_two(&f->front, lane[0], lane[1]),
                                              ray_lanes_two(&f->back, lane[0], lane[1]));
        const float16 limit = ray_lanes_two(&before.range, lane[0], lane[1]);
        uint met = mask_of_16(inside & (range > 0.0f) & (range <= limit));
        if (among_long) met |= mask_of_16(inside) & among_long;
        while (met) {
            const uint i = ray_lanes_next(&met), side = i / 8;
            ray_hit hit = {((const float *)&range)[i], blocks[b].facet[i % 8],
                           ray_triangle_of(leaf, i % 8)};
            if (among_long >> i & 1)
                hit.range = ray_lanes_range_of_one(f, blocks + b, lane[side], axis, i % 8,
                                                   ray_leaf_get(best, lane[side]).range);
            if (!(hit.range > 0.0f)) continue;
            const ray_hit now = ray_leaf_get(best, lane[side]);
            if (hit.range < now.range || (hit.range == now.range && hit.facet < now.facet))
                ray_leaf_set(best, lane[side], hit);
        }
    }
}

/* Tells which lanes meet anything, two at a time: a bit each. */
INLINE uint ray_leaf_any_two(const ray_lanes *f, global const bvh_block *blocks, const uint leaf,
                             const uint axis, uint rays)
{
    global const bvh_block *block = blocks + ray_block_of(leaf);
    const uint among_long = ((1u << ray_long_of(leaf)) - 1) * 0x101;
    uint met = 0;

    while (rays) {
        const uint a = ray_lanes_next(&rays), b = rays ? ray_lanes_next(&rays) : a;
        const ray_lanes_edges e = ray_lanes_edges_of_two(f, block, a, b, axis);
        const int16 inside =
            ray_lanes_inside(&e, ray_lanes_two(&f->front, a, b), ray_lanes_two(&f->back, a, b));
        uint own = mask_of_16(inside & ray_lanes_before(&e));
        for (uint left = among_long ? mask_of_16(inside) & among_long : 0; left;) {
            const uint i = ray_lanes_next(&left);
            const float range = ray_lanes_range_of_one(f, block, i < 8 ? a : b, axis, i % 8, 0.0f);
            own = (own & ~(1u << i)) | (uint)(range > 0.0f) << i;
        }
        met |= (uint)((own & 0xff) != 0) << a | (uint)(own >> 8 != 0) << b;
    }
    return met;
}

#endif
