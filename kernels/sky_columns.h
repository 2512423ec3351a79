/* Sky columns: the sky's radiance by the weights of its directions. Neighbouring surfaces that weigh
 * it alike share a column of weights, and its sum. Device only. */
#ifndef SKY_COLUMNS_H
#define SKY_COLUMNS_H

#include "sky_weights.h"

/* Columns that are summed at once. */
#define SKY_COLUMNS 8u

/* The weights that are not 0 for all lanes, and which lanes have equal ones. */
typedef struct sky_columns {
    ushort used[INCIDENT_WEIGHTS]; /* rows of the weights */
    uint used_end[LOBE_RINGS];     /* of the rings, in turn */
    uint used_count;
    uint count;
    uint lane[LANES_WIDTH];    /* the first of each column */
    uint of_lane[LANES_WIDTH]; /* column of each lane */
} sky_columns;

static inline void sky_list_used(sky_columns *columns, const lanes *weights, uint ring_count,
                                 uint directions)
{
    uint count = 0;

    for (uint r = 0; r < ring_count; r++) {
        for (uint d = r * directions; d < (r + 1u) * directions; d++) {
            columns->used[count] = (ushort)d;
            count += lanes_any(weights[d] != 0.0f);
        }
        columns->used_end[r] = count;
    }
    columns->used_count = count;
}

/* Lanes of `left` that have the weights and the lobe of one of them. */
static inline uint sky_same(const sky_columns *columns, const lanes *weights,
                            const incident_group *g, uint lane, uint left)
{
    uint same = 0u;

    for (uint i = 0; i < g->lane_count; i++) same |= (uint)(g->lobe[i] == g->lobe[lane]) << i;
    same &= left;
    for (uint u = 0; u < columns->used_count && (same & (same - 1u)); u++) {
        const lanes weight = weights[columns->used[u]];
        same &= lanes_bits_of(weight == lane_of(&weight, lane));
    }
    return same | 1u << lane;
}

static inline void sky_find_columns(sky_columns *columns, const lanes *weights,
                                    const incident_group *g)
{
    columns->count = 0u;
    for (uint left = (1u << g->lane_count) - 1u; left;) {
        const uint lane = 31u - clz(left & -left);
        const uint same = sky_same(columns, weights, g, lane, left);
        for (uint i = lane; i < g->lane_count; i++)
            if (same >> i & 1u) columns->of_lane[i] = columns->count;
        columns->lane[columns->count++] = lane;
        left &= ~same;
    }
}

/* The weights of SKY_COLUMNS columns side by side; past the last, it again. */
static inline void sky_pack(const sky_columns *columns, const lanes *weights, uint first,
                            const incident_group *g, float *out_weight, uint *out_lobe)
{
    uint lane[SKY_COLUMNS];

    for (uint c = 0; c < SKY_COLUMNS; c++) {
        lane[c] = columns->lane[min(first + c, columns->count - 1u)];
        out_lobe[c] = g->lobe[lane[c]];
    }
    for (uint u = 0; u < columns->used_count; u++) {
        const float *row = (const float *)&weights[columns->used[u]];
        UNROLL
        for (uint c = 0; c < SKY_COLUMNS; c++) out_weight[u * SKY_COLUMNS + c] = row[lane[c]];
    }
}

/* Radiance of the sky in a block of samples, of SKY_COLUMNS columns.
 *   weight   shape (used_count, SKY_COLUMNS)
 *   sky      shape (directions, row_length) */
static inline void sky_sum(const sky_columns *columns, const float *weight, const uint *lobe,
                           uint ring_count, uint directions, global const float *sky,
                           global const float *emissivity, uint row_length, uint block,
                           spectrum *out)
{
    spectrum total[SKY_COLUMNS];
    uint u = 0;

    UNROLL
    for (uint c = 0; c < SKY_COLUMNS; c++) total[c] = (spectrum)0.0f;
    for (uint r = 0; r < ring_count; r++) {
        spectrum sum[SKY_COLUMNS];
        if (u == columns->used_end[r]) continue;
        UNROLL
        for (uint c = 0; c < SKY_COLUMNS; c++) sum[c] = (spectrum)0.0f;
        for (; u < columns->used_end[r]; u++) {
            const uint direction = columns->used[u] - r * directions;
            const spectrum radiance = spectrum_load(sky + (size_t)direction * row_length, block);
            UNROLL
            for (uint c = 0; c < SKY_COLUMNS; c++)
                sum[c] = fma((spectrum)weight[u * SKY_COLUMNS + c], radiance, sum[c]);
        }
        UNROLL
        for (uint c = 0; c < SKY_COLUMNS; c++)
            total[c] += sum[c] * lobe_of_ring(emissivity, row_length, lobe[c], r, block);
    }
    UNROLL
    for (uint c = 0; c < SKY_COLUMNS; c++) out[c] = total[c];
}

#endif
