/* Incident near: what the rays of pixels' hemispheres brought too little of the facets near them (near_facets.cl), put
 * right. Each near facet comes as a ray more; what rays brought beside near facets counts as much less, above and below
 * the horizon apart, so that all weights together stay 1: an enclosure of one temperature stays black, and no sky comes
 * into a closed room. Device only. */
#ifndef INCIDENT_NEAR_H
#define INCIDENT_NEAR_H

#include "kernels/radiance/incident_rays.h"

/* A row of floats as the lanes have it. */
static inline lanes incident_near_at(const incident_group *g, const incident_tables *t, uint row)
{
    const uint count = t->frame.pixel_count;
    global const float *at = t->cells.near + (size_t)row * count;

    return as_lanes(lanes_load_bits((global const uint *)at, g->first, count));
}

/* What rays brought beside near facets on one side of the horizon: all of it, what of that is sky, and what is
 * lacking of near facets. */
typedef struct incident_rest {
    lanes all, sky, lacks;
} incident_rest;

/* Reads the near facets of the lanes. */
static inline void incident_near_read(incident_near *near, const incident_group *g,
                                      const incident_tables *t)
{
    const uint count = t->frame.pixel_count;
    const lanes *normal = g->view.axes.normal, rings = (lanes)(float)t->cells.ring_count;

    near->rows = 0u;
    if (!t->cells.near) return;
    for (uint k = 0; k < NEAR_FACETS; k++) {
        global const uint *met = t->cells.met + (size_t)(t->cells.count + k) * count;
        const lanes weight = incident_near_at(g, t, 4u * k);
        if (!(g->diffuse & lanes_bits_of(weight != 0.0f))) continue;
        near->weight[near->rows] = weight;
        near->word[near->rows] = lanes_load_bits(met, g->first, count);
        for (uint axis = 0; axis < 3u; axis++)
            near->direction[near->rows][axis] = incident_near_at(g, t, 4u * k + axis + 1u);
        const lanes *to = near->direction[near->rows];
        const lanes cosine = normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2];
        const lanes ring = clamp(rings * cosine * cosine, (lanes)0.0f, rings - 0.5f);
        near->ring[near->rows++] = lanes_bits_from(ring);
    }
}

/* What the rays brought beside near facets.
 *   side   0 below the horizon, 1 above */
static inline incident_rest incident_rest_of(const incident_near *near, const incident_group *g,
                                             const incident_tables *t, uint side)
{
    const lanes none = (lanes)0.0f;
    incident_rest rest = {none, none, none};

    for (uint c = 0; c < t->cells.count; c++) {
        const incident_view view = incident_look_plain(g, t, c);
        const lanes_mask is_above = view.direction[2] > 0.0f;
        const lanes_mask counts =
            (side ? is_above : !is_above) & !incident_is_near(near, view.word);
        rest.all += counts ? view.weight : none;
        rest.sky += (counts & (view.word == RECORD_NONE)) ? view.weight : none;
    }
    for (uint k = 0; k < near->rows; k++) {
        const lanes_mask is_above = near->direction[k][2] > 0.0f;
        const lanes_mask counts = (side ? is_above : !is_above) & (near->weight[k] != 0.0f);
        rest.lacks += counts ? near->weight[k] : none;
    }
    return rest;
}

/* Adds what near facets change of the weights of the lobes' rings.
 *   side   0 below the horizon, 1 above */
static inline void incident_near_weigh(incident_near *near, const incident_group *g,
                                       const incident_tables *t, uint side)
{
    const lanes none = (lanes)0.0f, one = (lanes)1.0f;

    for (uint c = 0; c < t->cells.count; c++) {
        const incident_view view = incident_look_plain(g, t, c);
        const lanes_mask is_above = view.direction[2] > 0.0f;
        const lanes_mask counts = (side ? is_above : !is_above) & (view.word != RECORD_NONE) &
                                  !incident_is_near(near, view.word);
        near->change[ring_of_cell(t->cells, c)] +=
            counts ? view.weight * (near->rest[side] - one) : none;
    }
    for (uint k = 0; k < near->rows; k++) {
        const lanes_mask is_above = near->direction[k][2] > 0.0f;
        const lanes_mask counts = (side ? is_above : !is_above) & (near->weight[k] != 0.0f);
        const lanes weight = counts ? near->weight[k] * (one - near->sky[side]) : none;
        for (uint r = 0; r < t->cells.ring_count; r++)
            near->change[r] += near->ring[k] == r ? weight : none;
    }
}

/* Finds the near facets of the lanes, and what the rest counts. What is lacking beyond all of the rest is left out. */
static inline void incident_near_find(incident_near *near, const incident_group *g,
                                      const incident_tables *t)
{
    const lanes none = (lanes)0.0f, one = (lanes)1.0f;

    incident_near_read(near, g, t);
    for (uint r = 0; r < t->cells.ring_count; r++) near->change[r] = none;
    for (uint side = 0; side < 2u && near->rows > 0u; side++) {
        const incident_rest rest = incident_rest_of(near, g, t, side);
        const lanes_mask is_little = (rest.all <= 1e-6f) | (rest.lacks > rest.all);
        const lanes taken = rest.lacks > none ? fmin(rest.all / rest.lacks, one) : none;
        const lanes part = is_little ? taken : one;
        const lanes all = rest.all > 1e-6f ? rest.all : one;
        near->rest[side] = one - part * rest.lacks / all;
        near->sky[side] = rest.sky / all;
        for (uint k = 0; k < near->rows; k++) {
            const lanes_mask is_above = near->direction[k][2] > 0.0f;
            near->weight[k] *= (side ? is_above : !is_above) ? part : one;
        }
        incident_near_weigh(near, g, t, side);
    }
}

/* What a ring of a lane's hemisphere counts. */
static inline spectrum incident_lobe_at(const incident_group *g, uint lane,
                                        const incident_tables *t, uint ring, uint block)
{
    global const float *emissivity = t->spectra.emissivity;
    const uint row = t->frame.sample_count, lobe = g->lobe[lane];

    return lobe_of_ring(emissivity, row, lobe, ring, block) /
           lobe_sum(&g->view, lane, t->cells.ring_count, emissivity, row, lobe, block);
}

/* Takes the sky away that near facets hide more of.
 *   out   of pixel 0 */
static inline void incident_near_sky(const incident_group *g, const incident_tables *t,
                                     global float *out)
{
    const incident_near *near = &g->near;
    const uint row = t->frame.sample_count;
    global const float *sky =
        t->spectra.rows + (size_t)(SPECTRA_PATHS + 2u * t->frame.path_count) * row;

    for (uint k = 0; k < near->rows; k++) {
        const lanes_mask is_above = near->direction[k][2] > 0.0f;
        const lanes weight = near->weight[k] * (is_above ? near->sky[1] : near->sky[0]);
        uint bits = g->diffuse & lanes_bits_of((near->weight[k] != 0.0f) & (weight != 0.0f));
        for (; bits; bits &= bits - 1u) {
            const uint i = incident_first_of(bits);
            const sky_lookup at =
                sky_find(t->frame, lane_of(&near->direction[k][0], i),
                         lane_of(&near->direction[k][1], i), lane_of(&near->direction[k][2], i));
            const float share = (g->specular[i] - 1.0f) * lane_of(&weight, i);
            global float *own = incident_rows_of(g, i, t, out);
            const uint ring = ((const uint *)&near->ring[k])[i];
            for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
                const spectrum count =
                    incident_lobe_at(g, i, t, ring, block) * sky_radiance(sky, t->frame, at, block);
                spectrum_store(spectrum_load(own, block) + share * count, own, block);
            }
        }
    }
}

/* Makes the weights of the lobes with all that near facets change add up to 1 again.
 *   out   of pixel 0 */
static inline void incident_near_even(const incident_group *g, const incident_tables *t,
                                      global float *out)
{
    const uint row = t->frame.sample_count, blocks = row / SPECTRUM_WIDTH;

    for (uint bits = g->diffuse; bits; bits &= bits - 1u) {
        const uint i = incident_first_of(bits);
        global float *own = incident_rows_of(g, i, t, out);
        if (g->lobe[i] == RECORD_NONE) continue;
        for (uint block = 0; block < blocks; block++) {
            spectrum sum = (spectrum)1.0f;
            for (uint r = 0; r < t->cells.ring_count; r++)
                sum += lane_of(&g->near.change[r], i) * incident_lobe_at(g, i, t, r, block);
            for (uint part = 0; part < 2u; part++)
                spectrum_store(spectrum_load(own + part * row, block) / sum, own + part * row,
                               block);
        }
    }
}

#endif
