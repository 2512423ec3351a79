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

/* Where the sets of directions of LANES_WIDTH points begin in the table of cells, in floats. */
typedef struct hemisphere_sets {
    lanes_bits first;
    uint are_one;
} hemisphere_sets;

/*   direction_set   NULL: the first for all; first, count: as lanes_load_bits has them */
static inline hemisphere_sets hemisphere_sets_of(global const uint *direction_set, uint cell_count,
                                                 uint first, uint count)
{
    hemisphere_sets sets = {.first = 0u, .are_one = 1u};

    if (!direction_set) return sets;
    sets.first = 4u * cell_count * lanes_load_bits(direction_set, first, count);
    sets.are_one = !lanes_any(sets.first != ((const uint *)&sets.first)[0]);
    return sets;
}

/* The world's directions of a cell, each of its point's own set.
 *   cell   of the first set */
static inline void hemisphere_cell_directions(const hemisphere_lanes *f,
                                              const hemisphere_sets *sets, global const float *cell,
                                              lanes out[3])
{
    lanes in_frame[3];

    if (sets->are_one) {
        hemisphere_lanes_direction(f, cell + ((const uint *)&sets->first)[0], out);
        return;
    }
    for (uint k = 0; k < 3; k++) in_frame[k] = lanes_gather(cell + k, sets->first);
    UNROLL
    for (int k = 0; k < 3; k++)
        out[k] =
            (in_frame[0] * f->upslope[k] + in_frame[1] * f->across[k]) + in_frame[2] * f->normal[k];
}

/* Factors of the weights of cells above and below the horizon, which give both their exact shares of what is above a
 * tilted surface. */
typedef struct hemisphere_shares {
    lanes above, below;
} hemisphere_shares;

/*   up      third component of the normal; above: the weights of the cells above the horizon */
static inline hemisphere_shares hemisphere_share(lanes up, lanes above)
{
    const lanes_mask has_both = (above > 1e-6f) & (above < 1.0f - 1e-6f);
    const lanes fraction = 0.5f * (1.0f + up);
    hemisphere_shares shares;

    shares.above = has_both ? fraction / above : (lanes)1.0f;
    shares.below = has_both ? (1.0f - fraction) / (1.0f - above) : (lanes)1.0f;
    return shares;
}

static inline hemisphere_shares hemisphere_shares_of(const hemisphere_lanes *axes,
                                                     const hemisphere_sets *sets,
                                                     global const float *cell, uint cell_count)
{
    lanes above = (lanes)0.0f, direction[3];

    for (uint c = 0; c < cell_count; c++) {
        hemisphere_cell_directions(axes, sets, cell + 4 * c, direction);
        above += direction[2] > 0.0f ? (lanes)cell[4 * c + 3] : (lanes)0.0f;
    }
    return hemisphere_share(axes->normal[2], above);
}

#endif
