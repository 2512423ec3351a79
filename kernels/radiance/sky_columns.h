/* Sky columns: the sky that reaches neighbouring diffuse surfaces, in columns of those with equal normals
 * and lobes. A surface gets the open sky times the fraction that it sees, and what the cells above the
 * horizon that see the sky count more than that share. Both are the column's, but for the cells that
 * something hides. Device only. */
#ifndef SKY_COLUMNS_H
#define SKY_COLUMNS_H

#include "kernels/radiance/incident_group.h"

#if RAY_LANES == 16

/* Cells of a part, in whole vectors. */
#define SKY_CELLS ((ROUND + LANES_WIDTH - 1u) / LANES_WIDTH * LANES_WIDTH)

/* The cells of a part that a lane has for itself: those above the horizon that are hidden, or where most
 * are, so that nothing remains in a closed room, those that are not; and the sky below the horizon. */
typedef struct sky_odd_cells {
    incident_part part;
    uchar ring[ROUND]; /* of every cell of the part */
    ushort cell[LANES_WIDTH][ROUND];
    float weight[LANES_WIDTH][ROUND];
    uint count[LANES_WIDTH];
} sky_odd_cells;

/* Lanes that see little sky above the horizon. */
static inline lanes_mask sky_is_hidden(const incident_group *g)
{
    return g->view.seen < 0.5f;
}

static inline void sky_find_odd(sky_odd_cells *odd, const incident_group *g,
                                const incident_tables *t, incident_part part)
{
    const uint count = t->frame.pixel_count;
    const lanes of_hidden = sky_is_hidden(g) ? (lanes)0.0f : -g->view.above;
    const lanes of_seen = sky_is_hidden(g) ? g->view.above : (lanes)0.0f;
    lanes direction[3];

    odd->part = part;
    for (uint i = 0; i < LANES_WIDTH; i++) odd->count[i] = 0u;
    for (uint c = part.first; c < part.end; c++) {
        odd->ring[c - part.first] = (uchar)ring_of_cell(t->cells, c);
        const lanes_bits word = lanes_load_bits(t->cells.met + (size_t)c * count, g->first, count);
        const lanes_mask sees = word == RECORD_NONE;
        hemisphere_cell_directions(&g->view.axes, &g->view.sets, t->cells.cell + 4u * c, direction);
        const lanes factor = direction[2] > 0.0f ? (sees ? of_seen : of_hidden)
                                                 : (sees ? g->view.below : (lanes)0.0f);
        const lanes weight = t->cells.cell[4u * c + 3u] * factor;
        for (uint bits = g->diffuse & lanes_bits_of(weight != 0.0f); bits; bits &= bits - 1u) {
            const uint i = incident_first_of(bits), n = odd->count[i]++;
            odd->cell[i][n] = (ushort)(c - part.first);
            odd->weight[i][n] = lane_of(&weight, i);
        }
    }
}

/* Cells of a column: where each lies between the table's directions, and what it counts. */
typedef struct sky_cells {
    float fraction[4][SKY_CELLS] __attribute__((aligned(64)));
    float above[SKY_CELLS] __attribute__((aligned(64))); /* weight; 0: not above the horizon */
    uint direction[4][SKY_CELLS];
    uchar is_odd[SKY_CELLS]; /* 1: for a lane */
} sky_cells;

/* Places in a table of `count` rows from 0 by `step`, as lookup_regular finds one. */
static inline lanes sky_rows_of(lanes value, float step, uint count)
{
    return count < 2u ? (lanes)0.0f : clamp(value / step, 0.0f, (float)(count - 1u));
}

/* Finds LANES_WIDTH cells of the sky.
 *   at   cell of the round to begin with */
static inline void sky_place_cells(sky_cells *out, radiometry_record frame, const lanes *direction,
                                   uint at)
{
    const float degree = 180.0f / PI_F;
    const lanes turn = atan2(direction[0], direction[1]) * degree;
    const lanes azimuth = turn < 0.0f ? turn + 360.0f : turn;
    const lanes zenith = acos(clamp(direction[2], -1.0f, 1.0f)) * degree;
    const lanes upper = sky_rows_of(zenith, frame.zenith_step_deg, frame.zenith_count);
    const lanes right = sky_rows_of(azimuth, frame.azimuth_step_deg, frame.azimuth_count);
    const lanes row = floor(upper), column = floor(right);
    const lanes up = upper - row, along = right - column;

    lanes_write((1.0f - up) * (1.0f - along), &out->fraction[0][at]);
    lanes_write((1.0f - up) * along, &out->fraction[1][at]);
    lanes_write(up * (1.0f - along), &out->fraction[2][at]);
    lanes_write(up * along, &out->fraction[3][at]);
    for (uint i = 0; i < LANES_WIDTH; i++) {
        const uint low = (uint)lane_of(&row, i), left = (uint)lane_of(&column, i);
        const uint high = min(low + 1u, frame.zenith_count - 1u);
        const uint next = min(left + 1u, frame.azimuth_count - 1u);
        out->direction[0][at + i] = low * frame.azimuth_count + left;
        out->direction[1][at + i] = low * frame.azimuth_count + next;
        out->direction[2][at + i] = high * frame.azimuth_count + left;
        out->direction[3][at + i] = high * frame.azimuth_count + next;
    }
}

/* Finds the cells of the column of a lane. */
static inline void sky_find_cells(sky_cells *out, const incident_group *g, uint lane,
                                  const incident_tables *t, incident_part part)
{
    const hemisphere_lanes *axes = &g->view.axes;
    global const float *cell = t->cells.cell + ((const uint *)&g->view.sets.first)[lane];
    lanes in_frame[4], direction[3];

    for (uint at = 0; at < part.end - part.first; at += LANES_WIDTH) {
        for (uint i = 0; i < LANES_WIDTH; i++) {
            const uint c = min(part.first + at + i, part.end - 1u);
            for (uint k = 0; k < 4u; k++) LANES_SET(in_frame[k], i, cell[4u * c + k]);
        }
        UNROLL
        for (uint k = 0; k < 3u; k++)
            direction[k] = (in_frame[0] * lane_of(&axes->upslope[k], lane) +
                            in_frame[1] * lane_of(&axes->across[k], lane)) +
                           in_frame[2] * lane_of(&axes->normal[k], lane);
        const lanes weight = in_frame[3] * lane_of(&g->view.above, lane);
        lanes_write(direction[2] > 0.0f ? weight : (lanes)0.0f, &out->above[at]);
        sky_place_cells(out, t->frame, direction, at);
    }
}

/* How much of the table's directions reaches a column, by the ring of its hemisphere that they lie in. */
#define SKY_WEIGHTS (INCIDENT_WEIGHTS + LOBE_RINGS * LANES_WIDTH)
typedef struct sky_weights {
    float open[SKY_WEIGHTS];  /* of the dome */
    float above[SKY_WEIGHTS]; /* of the cells above the horizon */
    ushort direction[SKY_WEIGHTS];
    uint end[LOBE_RINGS]; /* of the rings, in turn */
    float of_lobe
        [LOBE_RINGS]; /* what the dome's points count more where a ring has a factor of its own: as many of
                                * them lie in it as happens */
} sky_weights;

/* Floats of a ring before those that are 0 are left out. */
static inline uint sky_stride(radiometry_record frame)
{
    return (frame.zenith_count * frame.azimuth_count + LANES_WIDTH - 1u) / LANES_WIDTH *
           LANES_WIDTH;
}

/* Sines of the elevations that the rings of a hemisphere begin at. */
static inline lanes sky_ring_bounds(uint ring_count)
{
    lanes ring;

    for (uint i = 0; i < LANES_WIDTH; i++) LANES_SET(ring, i, (float)i);
    return sqrt(fmin(ring / (float)ring_count, 1.0f));
}

/* Adds LANES_WIDTH points of the dome.
 *   facing   what they count, 0 for those that the column does not face; ring: that they lie in */
static inline void sky_weigh_points(float *open, const incident_tables *t, uint point, lanes facing,
                                    lanes_bits ring)
{
    const uint count = t->params.dome_count;
    const lanes_bits base = ring * sky_stride(t->frame);
    lanes weight[4];
    lanes_bits place[4];

    UNROLL
    for (uint k = 0; k < 4u; k++) {
        global const float *corner = t->dome + (DOME_CORNERS + k) * count + point;
        place[k] = base + convert_uint16(vload16(0, corner));
        weight[k] = facing * vload16(0, corner + 4u * count);
    }
    for (uint bits = lanes_bits_of(facing > 0.0f); bits; bits &= bits - 1u) {
        const uint i = incident_first_of(bits);
        UNROLL
        for (uint k = 0; k < 4u; k++) open[((const uint *)&place[k])[i]] += lane_of(&weight[k], i);
    }
}

/* Adds the points of the dome that the column of a lane faces.
 *   open   shape (ring_count, sky_stride), 0; of_lobe: shape (ring_count) */
static inline void sky_weigh_dome(float *open, float *of_lobe, const incident_group *g, uint lane,
                                  const incident_tables *t)
{
    const uint count = t->params.dome_count, rings = t->cells.ring_count;
    const lanes *normal = g->view.axes.normal, bound = sky_ring_bounds(rings);
    lanes sum = (lanes)0.0f;

    for (uint point = 0; point < count; point += LANES_WIDTH) {
        global const float *at = t->dome + point;
        const lanes cosine = vload16(0, at) * lane_of(&normal[0], lane) +
                             vload16(0, at + count) * lane_of(&normal[1], lane) +
                             vload16(0, at + 2u * count) * lane_of(&normal[2], lane);
        const lanes facing = fmax(cosine * vload16(0, at + DOME_SOLID_ANGLE * count), 0.0f);
        lanes_mask ring = 0;
        for (uint r = 1; r < rings; r++) ring -= cosine > lane_of(&bound, r);
        sum += facing;
        sky_weigh_points(open, t, point, facing, as_uint16(ring));
    }
    const float whole = spectrum_sum(sum);
    const float scale = whole > 0.0f ? lane_of(&g->view.open, lane) / whole : 0.0f;
    for (uint r = 0; r < rings; r++) {
        float *ring = open + r * sky_stride(t->frame), all = 0.0f;
        for (uint d = 0; d < sky_stride(t->frame); d++) {
            ring[d] *= scale;
            all += ring[d];
        }
        of_lobe[r] = all > 0.0f ? lane_of(&g->view.high[r], lane) / all : 1.0f;
    }
}

/* Leaves out what is 0. */
static inline void sky_pack(sky_weights *w, uint stride, uint ring_count)
{
    uint n = 0;

    for (uint r = 0; r < ring_count; r++) {
        for (uint d = 0; d < stride; d += LANES_WIDTH) {
            const lanes open = lanes_read(w->open + r * stride + d);
            const lanes above = lanes_read(w->above + r * stride + d);
            uint bits = lanes_bits_of((open != 0.0f) | (above != 0.0f));
            for (; bits; bits &= bits - 1u) {
                const uint i = incident_first_of(bits);
                w->open[n] = lane_of(&open, i);
                w->above[n] = lane_of(&above, i);
                w->direction[n++] = (ushort)(d + i);
            }
        }
        w->end[r] = n;
    }
}

/* Lanes with equal normals, sets of directions and lobes. Cells and weights are those of a part of the hemisphere above any
 * surface of that normal. */
typedef struct sky_column {
    uint lanes; /* a bit each */
    float normal[3];
    uint set;
    incident_part part; /* end 0: of none yet */
    sky_cells cells;
    sky_weights weights;
} sky_column;

/* Weighs the sky for a column: the cells of a part, and with the first the open sky. */
static inline void sky_weigh(sky_column *column, const sky_odd_cells *odd, const incident_group *g,
                             const incident_tables *t)
{
    const uint stride = sky_stride(t->frame), rings = t->cells.ring_count;
    const incident_part part = odd->part;
    const sky_cells *cells = &column->cells;
    sky_weights *w = &column->weights;

    for (uint d = 0; d < rings * stride; d++) w->open[d] = w->above[d] = 0.0f;
    if (part.first == 0u)
        sky_weigh_dome(w->open, w->of_lobe, g, incident_first_of(column->lanes), t);
    for (uint c = 0; c < part.end - part.first; c++)
        for (uint k = 0; k < 4u; k++)
            w->above[odd->ring[c] * stride + cells->direction[k][c]] +=
                cells->above[c] * cells->fraction[k][c];
    sky_pack(w, stride, rings);
}

/* The sky of a column in `side` blocks of samples.
 *   has_lobe   0: the surface is Lambertian; sky: row of the table's first direction */
INLINE void sky_sum(const sky_weights *weights, const incident_lobe *lobe, uint has_lobe,
                    const incident_tables *t, global const float *sky, uint block, const uint side,
                    spectrum *out_open, spectrum *out_above)
{
    uint n = 0;

    UNROLL
    for (uint b = 0; b < side; b++) out_open[b] = out_above[b] = (spectrum)0.0f;
    for (uint r = 0; r < t->cells.ring_count; r++) {
        spectrum open[SIDE], above[SIDE];
        UNROLL
        for (uint b = 0; b < side; b++) open[b] = above[b] = (spectrum)0.0f;
        for (; n < weights->end[r]; n++) {
            global const float *row = sky + (size_t)weights->direction[n] * t->frame.sample_count;
            const float of_open = weights->open[n], of_above = weights->above[n];
            UNROLL
            for (uint b = 0; b < side; b++) {
                const spectrum radiance = spectrum_load(row, block + b);
                open[b] = fma((spectrum)of_open, radiance, open[b]);
                above[b] = fma((spectrum)of_above, radiance, above[b]);
            }
        }
        UNROLL
        for (uint b = 0; b < side; b++) {
            const spectrum count = has_lobe ? weights->of_lobe[r] * lobe->ring[r][b] : 1.0f;
            out_open[b] = fma(count, open[b], out_open[b]);
            out_above[b] = fma(lobe->ring[r][b], above[b], out_above[b]);
        }
    }
}

/* The sky through the odd cells of a column in `side` blocks of samples.
 *   out   shape (cells of the part, SIDE) */
INLINE void sky_through_cells(const sky_cells *cells, const sky_odd_cells *odd,
                              const incident_lobe *lobe, const incident_tables *t,
                              global const float *sky, uint block, const uint side,
                              spectrum (*out)[SIDE])
{
    for (uint c = 0; c < odd->part.end - odd->part.first; c++) {
        if (!cells->is_odd[c]) continue;
        UNROLL
        for (uint b = 0; b < side; b++) out[c][b] = (spectrum)0.0f;
        for (uint k = 0; k < 4u; k++) {
            global const float *row = sky + (size_t)cells->direction[k][c] * t->frame.sample_count;
            const float fraction = cells->fraction[k][c];
            UNROLL
            for (uint b = 0; b < side; b++)
                out[c][b] = fma((spectrum)fraction, spectrum_load(row, block + b), out[c][b]);
        }
        UNROLL
        for (uint b = 0; b < side; b++) out[c][b] *= lobe->ring[odd->ring[c]][b];
    }
}

/* Adds the sky of a column to `side` blocks of samples of its lanes. */
INLINE void sky_add_blocks(const sky_column *column, const sky_odd_cells *odd,
                           const incident_group *g, const incident_tables *t, uint block,
                           const uint side, global float *out)
{
    const uint row = t->frame.sample_count, hidden = lanes_bits_of(sky_is_hidden(g));
    global const float *sky =
        t->spectra.rows + (size_t)(SPECTRA_PATHS + 2u * t->frame.path_count) * row;
    incident_lobe lobe;
    spectrum open[SIDE], above[SIDE], cell[ROUND][SIDE];

    incident_find_lobe(&lobe, g, incident_first_of(column->lanes), t, block, side);
    const uint has_lobe = g->lobe[incident_first_of(column->lanes)] != RECORD_NONE;
    sky_sum(&column->weights, &lobe, has_lobe, t, sky, block, side, open, above);
    sky_through_cells(&column->cells, odd, &lobe, t, sky, block, side, cell);
    for (uint left = column->lanes; left; left &= left - 1u) {
        const uint i = incident_first_of(left);
        const float seen = lane_of(&g->view.seen, i), whole = hidden >> i & 1u ? 0.0f : 1.0f;
        spectrum sum[SIDE];
        UNROLL
        for (uint b = 0; b < side; b++)
            sum[b] = fma((spectrum)seen, open[b] - above[b], whole * above[b]);
        for (uint n = 0; n < odd->count[i]; n++) {
            const spectrum *of_cell = cell[odd->cell[i][n]];
            const float weight = odd->weight[i][n];
            UNROLL
            for (uint b = 0; b < side; b++) sum[b] = fma((spectrum)weight, of_cell[b], sum[b]);
        }
        UNROLL
        for (uint b = 0; b < side; b++)
            incident_add(sum[b], 1.0f - g->specular[i], odd->part, incident_rows_of(g, i, t, out),
                         block + b);
    }
}

/* Adds the sky of a column to every sample of its lanes. */
static inline void sky_add_column(const sky_column *column, const sky_odd_cells *odd,
                                  const incident_group *g, const incident_tables *t,
                                  global float *out)
{
    const uint blocks = t->frame.sample_count / SPECTRUM_WIDTH;
    uint block = 0;

    for (; block + SIDE <= blocks; block += SIDE)
        sky_add_blocks(column, odd, g, t, block, SIDE, out);
    for (; block < blocks; block++) sky_add_blocks(column, odd, g, t, block, 1u, out);
}

/* Marks the cells that are odd for a lane of a column. */
static inline void sky_mark_odd(sky_column *column, const sky_odd_cells *odd)
{
    for (uint c = 0; c < SKY_CELLS; c++) column->cells.is_odd[c] = 0u;
    for (uint bits = column->lanes; bits; bits &= bits - 1u) {
        const uint i = incident_first_of(bits);
        for (uint n = 0; n < odd->count[i]; n++) column->cells.is_odd[odd->cell[i][n]] = 1u;
    }
}

/* Turns a column to some lanes of a group: it stays as it is where they have its normal. */
static inline void sky_turn(sky_column *column, uint lanes, const sky_odd_cells *odd,
                            const incident_group *g, const incident_tables *t)
{
    const uint lane = incident_first_of(lanes);
    const uint set = ((const uint *)&g->view.sets.first)[lane];
    uint differs = column->part.first != odd->part.first || column->part.end != odd->part.end ||
                   column->set != set;

    column->lanes = lanes;
    column->set = set;
    for (uint k = 0; k < 3u; k++) {
        const float normal = lane_of(&g->view.axes.normal[k], lane);
        differs |= column->normal[k] != normal;
        column->normal[k] = normal;
    }
    if (differs) {
        column->part = odd->part;
        sky_find_cells(&column->cells, g, lane, t, odd->part);
        sky_weigh(column, odd, g, t);
    }
    sky_mark_odd(column, odd);
}

/* Forgets the column of the group before. */
static inline void sky_forget(sky_column *column)
{
    column->part.end = 0u;
}

/* Adds the sky that the lanes see.
 *   column   the last one of the group before
 *   out      of pixel 0 */
static inline void sky_add(sky_column *column, const incident_group *g, const incident_tables *t,
                           incident_part part, global float *out)
{
    sky_odd_cells odd;

    sky_find_odd(&odd, g, t, part);
    for (uint k = 0; k < g->column_count; k++) {
        sky_turn(column, g->column[k], &odd, g, t);
        sky_add_column(column, &odd, g, t, out);
    }
}

#endif

#endif
