/* Sky pixel: the sky that reaches one diffuse surface, for work-items of one pixel: the scalar twin of
 * sky_columns.h. Device only. */
#ifndef SKY_PIXEL_H
#define SKY_PIXEL_H

#include "kernels/radiance/incident_group.h"

#if RAY_LANES == 1

/* What every direction of the table counts in every ring of the hemisphere: shape (ring_count,
 * sky_direction_count). */
typedef struct sky_column {
    float weight[INCIDENT_WEIGHTS];
} sky_column;

static inline void sky_forget(sky_column *column)
{
    (void)column;
}

static inline uint sky_direction_count(radiometry_record frame)
{
    return frame.zenith_count * frame.azimuth_count;
}

/* Ring of the hemisphere that a direction lies in; the lowest first.
 *   cosine   of its angle from the normal */
static inline uint sky_ring_of(float cosine, uint ring_count)
{
    uint ring = 0u;

    for (uint r = 1; r < ring_count; r++) ring += cosine > sqrt((float)r / (float)ring_count);
    return ring;
}

/* Weighs the open sky by the points of the dome, as far as the surface sees it. */
static inline void sky_weigh_dome(sky_column *out, const incident_group *g,
                                  const incident_tables *t)
{
    const uint count = t->params.dome_count, rings = t->cells.ring_count;
    const uint directions = sky_direction_count(t->frame);
    const lanes *normal = g->view.axes.normal;
    float whole = 0.0f;

    for (uint d = 0; d < rings * directions; d++) out->weight[d] = 0.0f;
    for (uint point = 0; point < count; point++) {
        global const float *at = t->dome + point, *corner = at + DOME_CORNERS * count;
        const float cosine = at[0] * normal[0] + at[count] * normal[1] + at[2u * count] * normal[2];
        const float facing = cosine * at[DOME_SOLID_ANGLE * count];
        if (!(facing > 0.0f)) continue;
        float *ring = out->weight + sky_ring_of(cosine, rings) * directions;
        for (uint k = 0; k < 4u; k++)
            ring[(uint)corner[k * count]] += facing * corner[(4u + k) * count];
        whole += facing;
    }
    const float scale = whole > 0.0f ? g->view.seen * g->view.open / whole : 0.0f;
    for (uint r = 0; r < rings; r++) {
        float *ring = out->weight + r * directions, all = 0.0f;
        for (uint d = 0; d < directions; d++) all += ring[d];
        const float own = g->view.high[r] * g->view.seen;
        const float factor = g->lobe[0] == RECORD_NONE || !(all > 0.0f) ? scale : own / all;
        for (uint d = 0; d < directions; d++) ring[d] *= factor;
    }
}

/* What a cell counts beside its fraction of the open sky. */
static inline float sky_cell_weight(const incident_group *g, const incident_tables *t, uint c,
                                    const lanes *direction)
{
    const uint word = t->cells.met[(size_t)c * t->frame.pixel_count + g->first];
    const float sees = word == RECORD_NONE ? 1.0f : 0.0f;

    return t->cells.cell[4u * c + 3u] *
           (direction[2] > 0.0f ? g->view.above * (sees - g->view.seen) : g->view.below * sees);
}

/* Adds the cells: to the table's directions around each. */
static inline void sky_weigh_cells(sky_column *out, const incident_group *g,
                                   const incident_tables *t)
{
    lanes direction[3];

    for (uint c = 0; c < t->cells.count; c++) {
        hemisphere_cell_directions(&g->view.axes, &g->view.sets, t->cells.cell + 4u * c, direction);
        const float weight = sky_cell_weight(g, t, c, direction);
        const sky_lookup at = sky_find(t->frame, direction[0], direction[1], direction[2]);
        float *low = out->weight + ring_of_cell(t->cells, c) * sky_direction_count(t->frame);
        float *high = low + at.zenith.high * t->frame.azimuth_count;
        low += at.zenith.low * t->frame.azimuth_count;
        low[at.azimuth.low] += weight * (1.0f - at.zenith.fraction) * (1.0f - at.azimuth.fraction);
        low[at.azimuth.high] += weight * (1.0f - at.zenith.fraction) * at.azimuth.fraction;
        high[at.azimuth.low] += weight * at.zenith.fraction * (1.0f - at.azimuth.fraction);
        high[at.azimuth.high] += weight * at.zenith.fraction * at.azimuth.fraction;
    }
}

/* The sky in a block of samples, through the surface's lobe. */
static inline spectrum sky_arriving(const sky_column *sky, const incident_lobe *lobe,
                                    const incident_tables *t, uint block)
{
    const uint row = t->frame.sample_count, directions = sky_direction_count(t->frame);
    global const float *table =
        t->spectra.rows + (size_t)(SPECTRA_PATHS + 2u * t->frame.path_count) * row;
    spectrum total = (spectrum)0.0f;

    for (uint r = 0; r < t->cells.ring_count; r++) {
        spectrum sum = (spectrum)0.0f;
        for (uint d = 0; d < directions; d++) {
            const float weight = sky->weight[r * directions + d];
            if (weight == 0.0f) continue;
            sum = fma((spectrum)weight, spectrum_load(table + (size_t)d * row, block), sum);
        }
        total = fma(lobe->ring[r][0], sum, total);
    }
    return total;
}

/* Adds the sky that the surface sees, all of it with the first part of its cells.
 *   out   of pixel 0 */
static inline void sky_add(sky_column *column, const incident_group *g, const incident_tables *t,
                           incident_part part, global float *out)
{
    global float *own = incident_rows_of(g, 0u, t, out);
    incident_lobe lobe;

    if (part.first > 0u) return;
    sky_weigh_dome(column, g, t);
    sky_weigh_cells(column, g, t);
    for (uint block = 0; block < t->frame.sample_count / SPECTRUM_WIDTH; block++) {
        incident_find_lobe(&lobe, g, 0u, t, block, 1u);
        incident_add(sky_arriving(column, &lobe, t, block), 1.0f - g->specular[0], part, own,
                     block);
    }
}

#endif

#endif
