/* Near rest: near facets of points (near_facets.cl), and what rays brought beside them. What a set of directions brought
 * too little of near facets the rest counts less for, above and below the horizon apart. Device only. */
#ifndef NEAR_REST_H
#define NEAR_REST_H

#include "kernels/hemisphere/hemisphere_lanes.h"

/* Near facets of LANES_WIDTH points. */
typedef struct near_rays {
    uint rows; /* facets a lane, at most */
    lanes weight[NEAR_FACETS],
        direction[NEAR_FACETS][3]; /* what is lacking, 0: none in this lane */
    lanes_bits word[NEAR_FACETS];  /* see hemisphere.cl */
} near_rays;

/* Reads those of points first .. first + LANES_WIDTH - 1 of `count`.
 *   near   shape (NEAR_FACETS, 4, count), NULL: none; met: shape (NEAR_FACETS, count), their words
 *   used   a bit per lane that counts */
static inline near_rays near_rays_read(global const float *near, global const uint *met, uint first,
                                       uint count, uint used)
{
    near_rays out = {.rows = 0u};

    for (uint k = 0; near && k < NEAR_FACETS; k++) {
        global const uint *row = (global const uint *)near + (size_t)4u * k * count;
        const lanes weight = as_lanes(lanes_load_bits(row, first, count));
        if (!(used & lanes_bits_of(weight != 0.0f))) continue;
        out.weight[out.rows] = weight;
        for (uint axis = 0; axis < 3u; axis++)
            out.direction[out.rows][axis] =
                as_lanes(lanes_load_bits(row + (size_t)(axis + 1u) * count, first, count));
        const lanes_bits word = lanes_load_bits(met + (size_t)k * count, first, count);
        const lanes_bits nothing = RECORD_NONE - 1u;
        out.word[out.rows++] = weight != 0.0f ? word : nothing;
    }
    return out;
}

/* Which of the lanes met a near facet of theirs. */
static inline lanes_mask near_rays_met(const near_rays *near, lanes_bits word)
{
    lanes_mask is_near = (lanes_mask)0;

    for (uint k = 0; k < near->rows; k++)
        is_near |= ((near->word[k] ^ word) & ~HEMISPHERE_LIT) == 0u;
    return is_near;
}

/* Below the horizon and above it: all that rays brought beside near facets, what of that is sky, and what is lacking of
 * near facets. */
typedef struct near_rest {
    lanes all[2], sky[2], lacks[2];
} near_rest;

/* Begins with what is lacking. */
static inline near_rest near_rest_of(const near_rays *near)
{
    const lanes none = (lanes)0.0f;
    near_rest rest = {{none, none}, {none, none}, {none, none}};

    for (uint k = 0; k < near->rows; k++) {
        const lanes weight = near->weight[k] != none ? near->weight[k] : none;
        rest.lacks[1] += near->direction[k][2] > none ? weight : none;
        rest.lacks[0] += near->direction[k][2] > none ? none : weight;
    }
    return rest;
}

/* Adds a cell.
 *   up   third component of its direction */
static inline void near_rest_add(near_rest *rest, const near_rays *near, lanes_bits word, lanes up,
                                 lanes weight)
{
    const lanes none = (lanes)0.0f, counts = near_rays_met(near, word) ? none : weight;
    const lanes above = up > none ? counts : none, below = up > none ? none : counts;

    rest->all[0] += below;
    rest->all[1] += above;
    rest->sky[0] += word == RECORD_NONE ? below : none;
    rest->sky[1] += word == RECORD_NONE ? above : none;
}

/* The part of what is lacking that the rest can give: no more than it has. */
static inline lanes near_rest_part(const near_rest *rest, uint side)
{
    const lanes none = (lanes)0.0f, one = (lanes)1.0f, all = rest->all[side];
    const lanes given = rest->lacks[side] > none ? fmin(all / rest->lacks[side], one) : none;

    return ((all <= 1e-6f) | (rest->lacks[side] > all)) ? given : one;
}

/* What of the rest that is. */
static inline lanes near_rest_taken(const near_rest *rest, uint side)
{
    const lanes one = (lanes)1.0f, all = rest->all[side] > 1e-6f ? rest->all[side] : one;

    return near_rest_part(rest, side) * rest->lacks[side] / all;
}

#endif
