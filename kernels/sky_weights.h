/* Sky weights: how much of each direction of the sky's table reaches neighbouring diffuse surfaces.
 * Device only. */
#ifndef SKY_WEIGHTS_H
#define SKY_WEIGHTS_H

#include "surroundings.h"

/* LANES_WIDTH neighbouring pixels; a lane past the end is a missed one. */
typedef struct incident_group {
    uint first, lane_count;
    uint diffuse;                /* a bit per lane that is, wholly or partly */
    float specular[LANES_WIDTH]; /* share */
    uint lobe[LANES_WIDTH];      /* first row of the diffuse lobe, RECORD_NONE: Lambertian */
    diffuse_view view;
} incident_group;

static inline lanes lanes_of_bit(uint bits)
{
    lanes out = (lanes)0.0f;

    for (uint i = 0; i < LANES_WIDTH; i++) LANES_SET(out, i, (float)(bits >> i & 1u));
    return out;
}

/* Places of the lanes in a table of `count` rows from 0 by `step`, as lookup_regular finds one. */
static inline lanes sky_rows_of(lanes value, float step, uint count)
{
    return count < 2u ? (lanes)0.0f : clamp(value / step, 0.0f, (float)(count - 1u));
}

/* Place `row` of such a table. */
static inline lookup sky_row(float row, uint count)
{
    const uint low = (uint)row;

    return (lookup){low, min(low + 1u, count - 1u), row - (float)low};
}

/* Adds to the weights of the table's directions what the cells that see the sky count more than
 * their share of it, and those that do not less. */
static inline void sky_weigh_cells(lanes *weights, radiometry_record frame, const incident_group *g,
                                   incident_cells cells)
{
    const lanes is_diffuse = lanes_of_bit(g->diffuse);
    const float degree = 180.0f / PI_F;
    const uint directions = frame.zenith_count * frame.azimuth_count;
    lanes direction[3];

    for (uint c = 0; c < cells.count; c++) {
        const lanes_bits word =
            lanes_load_bits(cells.met + (size_t)c * frame.pixel_count, g->first, frame.pixel_count);
        const lanes sees = word == RECORD_NONE ? (lanes)1.0f : (lanes)0.0f;
        hemisphere_lanes_direction(&g->view.axes, cells.cell + 4u * c, direction);
        const lanes weight =
            is_diffuse * cells.cell[4u * c + 3u] *
            (direction[2] > 0.0f ? g->view.above * (sees - g->view.seen) : g->view.below * sees);
        if (!lanes_any(weight != 0.0f)) continue;
        const lanes turn = atan2(direction[0], direction[1]) * degree;
        const lanes azimuth = turn < 0.0f ? turn + 360.0f : turn;
        const lanes zenith = acos(clamp(direction[2], -1.0f, 1.0f)) * degree;
        const lanes upper = sky_rows_of(zenith, frame.zenith_step_deg, frame.zenith_count);
        const lanes right = sky_rows_of(azimuth, frame.azimuth_step_deg, frame.azimuth_count);
        float *ring = (float *)(weights + (size_t)ring_of_cell(cells, c) * directions);
        for (uint i = 0; i < LANES_WIDTH; i++) {
            if (lane_of(&weight, i) == 0.0f) continue;
            const sky_lookup at = {sky_row(lane_of(&upper, i), frame.zenith_count),
                                   sky_row(lane_of(&right, i), frame.azimuth_count)};
            incident_add_sky(ring + i, LANES_WIDTH, frame, at, lane_of(&weight, i));
        }
    }
}

/* Adds a point of the sky to the weights of the table's directions.
 *   at   of the dome; facing: what it counts */
static inline void sky_weigh_point(lanes *weights, radiometry_record frame, float8 at, lanes facing)
{
    const uint low = (uint)at.s4, left = (uint)at.s6;
    lanes *lower = weights + low * frame.azimuth_count;
    lanes *upper = weights + min(low + 1u, frame.zenith_count - 1u) * frame.azimuth_count;
    const uint right = min(left + 1u, frame.azimuth_count - 1u);

    lower[left] += facing * ((1.0f - at.s5) * (1.0f - at.s7));
    lower[right] += facing * ((1.0f - at.s5) * at.s7);
    upper[left] += facing * (at.s5 * (1.0f - at.s7));
    upper[right] += facing * (at.s5 * at.s7);
}

/* Weights of the open sky's directions, before they are scaled, by the ring of the surface's lobe that
 * they lie in. Returns their sum. */
static inline lanes sky_weigh_dome(lanes *weights, radiometry_record frame, const lanes *normal,
                                   uint ring_count, uint dome_count, global const float *dome)
{
    const uint directions = frame.zenith_count * frame.azimuth_count;
    float bound[LOBE_RINGS + 1]; /* sines of the rings' elevations */
    lanes open = (lanes)0.0f;

    for (uint r = 0; r < ring_count; r++)
        bound[r] = sin(0.5f * PI_F * (float)r / (float)ring_count);
    bound[ring_count] = 2.0f;
    for (uint d = 0; d < dome_count; d++) {
        const float8 at = vload8(d, dome);
        const lanes cosine = at.s0 * normal[0] + at.s1 * normal[1] + at.s2 * normal[2];
        const lanes facing = fmax(cosine * at.s3, 0.0f);
        open += facing;
        for (uint r = 0; r < ring_count; r++) {
            const lanes_mask inside = (cosine > bound[r]) & (cosine <= bound[r + 1u]);
            if (!lanes_any(inside)) continue;
            sky_weigh_point(weights + (size_t)r * directions, frame, at,
                            inside ? facing : (lanes)0.0f);
        }
    }
    return open;
}

/* Weights of the sky's directions for diffuse surfaces, 0 for others. The cells that see the sky
 * count what they weigh; what the cells above the horizon miss of the open sky's integral is added by
 * the share of the sky that is seen.
 *   weights   shape (cells.ring_count, directions)
 *   dome      (dome_count, 8): direction, solid angle, and its place in the table: rows and shares of
 *             zenith and azimuth */
static inline void sky_weigh(lanes *weights, radiometry_record frame, const incident_group *g,
                             incident_cells cells, uint dome_count, global const float *dome)
{
    const uint count = cells.ring_count * frame.zenith_count * frame.azimuth_count;

    for (uint d = 0; d < count; d++) weights[d] = (lanes)0.0f;
    if (!g->diffuse) return;
    const lanes open =
        sky_weigh_dome(weights, frame, g->view.axes.normal, cells.ring_count, dome_count, dome);
    const lanes scale =
        lanes_of_bit(g->diffuse) * (open > 0.0f ? g->view.open * g->view.seen / open : (lanes)0.0f);
    for (uint d = 0; d < count; d++) weights[d] *= scale;
    sky_weigh_cells(weights, frame, g, cells);
}

#endif
