/* Hemisphere lanes: the frames of LANES_WIDTH facets, computed as hemisphere.h computes one, operation
 * by operation. */
#ifndef HEMISPHERE_LANES_H
#define HEMISPHERE_LANES_H

#include "kernels/hemisphere/hemisphere.h"
#include "kernels/lanes.h"

/* Which point stands at a place: points may be looked at in an order of their own.
 *   order   NULL: they stand as they are */
static inline uint hemisphere_point(global const uint *order, uint place)
{
    return order ? order[place] : place;
}

typedef struct hemisphere_lanes {
    lanes upslope[3], across[3], normal[3];
} hemisphere_lanes;

static inline hemisphere_lanes hemisphere_lanes_of(const lanes normal[3])
{
    const lanes level = sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
    const lanes_mask is_level = level < HEMISPHERE_LEVEL;
    hemisphere_lanes f;

    UNROLL
    for (int k = 0; k < 3; k++) f.normal[k] = normal[k];
    f.upslope[0] = is_level ? (lanes)0.0f : -normal[2] * normal[0] / level;
    f.upslope[1] = is_level ? (lanes)1.0f : -normal[2] * normal[1] / level;
    f.upslope[2] = is_level ? (lanes)0.0f : level;
    UNROLL
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        f.across[k] = f.upslope[a] * normal[b] - f.upslope[b] * normal[a];
    }
    return f;
}

/* Adds to those sums of many small weights that are told, without losing their last digits (Kahan).
 *   sum   the sums, and what their rounding lost */
static inline void hemisphere_lanes_add(lanes sum[2], const lanes_mask where, const float weight)
{
    const lanes term = weight - sum[1], next = sum[0] + term;

    sum[1] = where ? (next - sum[0]) - term : sum[1];
    sum[0] = where ? next : sum[0];
}

/* Turns a direction of the grid (upslope, across, normal) into the world's. */
static inline void hemisphere_lanes_direction(const hemisphere_lanes *f,
                                              global const float *in_frame, lanes out[3])
{
    UNROLL
    for (int k = 0; k < 3; k++)
        out[k] =
            (in_frame[0] * f->upslope[k] + in_frame[1] * f->across[k]) + in_frame[2] * f->normal[k];
}

#endif
