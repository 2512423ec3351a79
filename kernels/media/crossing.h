/* Crossing: where a ray runs inside transmissive bodies. Thesis 2.4.3, Figure 2.4.3-2. Bodies are
 * closed surfaces in a tree of their own; what they hide of each other does not matter.
 *
 * Every crossing of a surface adds its range, with + where the ray leaves and - where it enters; the
 * sum is the way inside, from 0 where the origin is inside. Ranges count from the entry into the box
 * of all bodies, so that a body is as thick from far as from near. */
#ifndef CROSSING_H
#define CROSSING_H

#include "kernels/media/medium_world.h"
#include "kernels/rays/ray.h"

/* Length inside each material, and the integral of the range over it. */
typedef struct crossing_sum {
    float length[TRANSMISSION_MEDIA], moment[TRANSMISSION_MEDIA];
} crossing_sum;

/* What tells the side of an edge between two vertices. A ray through the edge itself counts as
 * running a little beside it, in x before y, so that it crosses one of two neighbours and not both. */
static inline float8 crossing_side(const float8 edge, const float8 xa, const float8 ya,
                                   const float8 xb, const float8 yb)
{
    const float8 beside = ya != yb ? ya - yb : xb - xa;

    return edge != 0.0f ? edge : beside;
}

/* Finds the triangles that the ray's line crosses: a bit each, and where.
 *   leaf   the child word that has the block
 * Returns the mask of entries (seen counter-clockwise) and sets that of exits. */
static inline uint crossing_meets(const ray_frame *f, global const bvh_block *block,
                                  const uint leaf, float8 *out_range, uint *out_exits)
{
    const ray_sight t = ray_see(f, block);
    const int8 is_area = ray_determinant(&t) != 0.0f;
    float8 side[3];

    for (int e = 0; e < 3; e++) {
        const int a = (e + 2) % 3, b = (e + 1) % 3;
        side[e] = crossing_side(t.edge[e], t.x[a], t.y[a], t.x[b], t.y[b]);
    }
    const int8 out = (side[0] < 0.0f) & (side[1] < 0.0f) & (side[2] < 0.0f);
    const int8 in = (side[0] > 0.0f) & (side[1] > 0.0f) & (side[2] > 0.0f);
    const float8 range = ray_ranges(f, &t, block, leaf, mask_of_8((in | out) & is_area), MAXFLOAT);
    const int8 ahead = is_area & (range > 0.0f);
    *out_range = range;
    *out_exits = mask_of_8(out & ahead);
    return mask_of_8(in & ahead);
}

/* Adds the crossings of a leaf. Those behind the limit count at the limit: they tell what the ray is
 * inside of there. */
static inline void crossing_leaf(const ray_frame *f, const medium_tables *medium, const uint leaf,
                                 const float limit, crossing_sum *sum)
{
    const uint first = ray_block_of(leaf), count = leaf & 1;

    for (uint b = first; b < first + count; b++) {
        float8 range;
        float at[8];
        uint exits;
        const uint entries = crossing_meets(f, medium->medium_blocks + b, leaf, &range, &exits);
        vstore8(range, 0, at);
        for (uint mask = entries | exits; mask; mask &= mask - 1) {
            const uint i = 31 - clz(mask & -mask);
            const uint m = medium->medium_row[medium->medium_blocks[b].facet[i]];
            const float range_m = fmin(at[i], limit), sign = exits >> i & 1 ? 1.0f : -1.0f;
            sum->length[m] += sign * range_m;
            sum->moment[m] += sign * 0.5f * range_m * range_m;
        }
    }
}

/* Where ranges begin to count: a little before the ray enters the box of all bodies, and at its origin
 * where that is near, which is then exact; INFINITY where it misses the box. */
static inline float crossing_start(const medium_world *media, const ray *r)
{
    float from = 0.0f, to = INFINITY, size = 0.0f;

    for (int k = 0; k < 3; k++) {
        const float d = r->direction[k];
        const float reciprocal = 1.0f / (fabs(d) < 1e-18f ? copysign(1e-18f, d) : d);
        const float a = (media->low[k] - r->origin[k]) * reciprocal;
        const float b = (media->high[k] - r->origin[k]) * reciprocal;
        from = fmax(from, fmin(a, b));
        to = fmin(to, fmax(a, b));
        size += media->high[k] - media->low[k];
    }
    /* Rounding must neither lose a ray along a side nor an entry where the box begins. */
    const float slack = 1e-6f * from + 1e-3f * size;
    return from > to + slack ? INFINITY : from > 4.0f * size ? from - slack : 0.0f;
}

/* Sums up the crossings of a ray with a unit direction.
 *   out_start   range where the sums begin to count; the lengths are inside up to the limit */
static inline crossing_sum crossing_along(const medium_tables *medium, const ray *r,
                                          float *out_start)
{
    crossing_sum sum = {{0.0f}, {0.0f}};
    const float start = crossing_start(&medium->media, r);
    uint stack[RAY_STACK_SIZE], depth = 1;
    ray near = *r;

    *out_start = start;
    if (!(start < r->limit)) return sum;
    for (int k = 0; k < 3; k++) near.origin[k] = fma(start, r->direction[k], r->origin[k]);
    const ray_frame f = ray_frame_of(&near);
    stack[0] = 0;
    while (depth > 0) {
        const uint word = stack[--depth];
        float8 range;
        if (word & BVH_LEAF) {
            crossing_leaf(&f, medium, word, r->limit - start, &sum);
            continue;
        }
        uint mask = ray_enters(&f, medium->medium_nodes + word, MAXFLOAT, &range);
        for (; mask; mask &= mask - 1)
            stack[depth++] = medium->medium_nodes[word].child[31 - clz(mask & -mask)];
    }
    return sum;
}

/* Temperature of the air, linear between levels, the nearest outside.
 *   level   shape (count, 2): altitude m, temperature K; altitudes ascend */
static inline float crossing_air_k(global const float *level, const uint count,
                                   const float altitude_m)
{
    uint i = 0;

    if (count == 0 || altitude_m <= level[0]) return count ? level[1] : 0.0f;
    while (i + 1 < count && level[2 * i + 2] < altitude_m) i++;
    if (i + 1 == count) return level[2 * i + 1];
    const float fraction = (altitude_m - level[2 * i]) / (level[2 * i + 2] - level[2 * i]);
    return level[2 * i + 1] + fraction * (level[2 * i + 3] - level[2 * i + 1]);
}

/* The bodies on a ray's way up to its limit. Its direction is unit. */
static inline transmission_path crossing_path(const medium_tables *medium, const ray *r)
{
    const medium_world *media = &medium->media;
    transmission_path path = {{0.0f}, {0.0f}, {0.0f}, {0.0f}, {0}};
    float start;
    const crossing_sum sum = crossing_along(medium, r, &start);
    uint count = 0;

    for (uint m = 0; m < TRANSMISSION_MEDIA; m++) {
        uint place = count;
        if (!(sum.length[m] > 0.0f)) continue;
        const float at = fmax(fmin(start + sum.moment[m] / sum.length[m], r->limit), start);
        for (; place > 0 && path.middle_m[place - 1] > at; place--) {
            path.middle_m[place] = path.middle_m[place - 1];
            path.length_m[place] = path.length_m[place - 1];
            path.medium[place] = path.medium[place - 1];
        }
        path.middle_m[place] = at;
        path.length_m[place] = sum.length[m];
        path.medium[place] = m;
        count++;
    }
    for (uint i = 0; i < count; i++) {
        const float altitude_m =
            media->altitude_m + r->origin[2] + path.middle_m[i] * r->direction[2];
        const float stated_k = media->stated_k[path.medium[i]];
        path.temperature_k[i] =
            stated_k > 0.0f ? stated_k
                            : crossing_air_k(medium->air_level, media->level_count, altitude_m);
    }
    return path;
}

/* Sets how thick the materials that scatter are, straight up through the middle of the ray's way in
 * them; where that lies between two bodies of a material, as thick as the way is long. */
static inline void crossing_set_vertical(const medium_tables *medium, const ray *r,
                                         transmission_path *path)
{
    const medium_world *media = &medium->media;

    for (uint i = 0; i < TRANSMISSION_MEDIA && path->length_m[i] > 0.0f; i++) {
        ray up = {.direction = {0.0f, 0.0f, 1.0f}, .limit = INFINITY};
        float start;
        if (!media->scatters[path->medium[i]]) continue;
        for (int k = 0; k < 2; k++)
            up.origin[k] = fma(path->middle_m[i], r->direction[k], r->origin[k]);
        up.origin[2] = media->low[2] - 1.0f;
        const crossing_sum sum = crossing_along(medium, &up, &start);
        const float through = sum.length[path->medium[i]];
        path->vertical_m[i] = through > 0.0f ? through : path->length_m[i];
    }
}

#endif
