/* Incident near: what the rays of pixels' hemispheres brought too little of the facets near them (near_facets.cl), put
 * right. Each near facet comes as a ray more; what rays brought beside near facets counts as much less, above and below
 * the horizon apart, so that all weights together stay 1: an enclosure of one temperature stays black, and no sky comes
 * into a closed room. Device only. */
#ifndef INCIDENT_NEAR_H
#define INCIDENT_NEAR_H

#include "kernels/radiance/incident_rays.h"

/* Finds which rings of the lobes near facets lie in. */
static inline void incident_near_rings(incident_near *near, const incident_group *g,
                                       const incident_tables *t)
{
    const lanes *normal = g->view.axes.normal, rings = (lanes)(float)t->cells.ring_count;

    for (uint k = 0; k < near->rays.rows; k++) {
        const lanes *to = near->rays.direction[k];
        const lanes cosine = normal[0] * to[0] + normal[1] * to[1] + normal[2] * to[2];
        near->ring[k] = lanes_bits_from(clamp(rings * cosine * cosine, (lanes)0.0f, rings - 0.5f));
    }
}

/* Finds what near facets change of the weights of the lobes' rings. */
static inline void incident_near_weigh(incident_near *near, const incident_group *g,
                                       const incident_tables *t)
{
    const lanes none = (lanes)0.0f, one = (lanes)1.0f;

    for (uint r = 0; r < t->cells.ring_count; r++) near->change[r] = none;
    for (uint c = 0; c < t->cells.count; c++) {
        const incident_view view = incident_look_plain(g, t, c);
        const lanes rest = view.direction[2] > none ? near->rest[1] : near->rest[0];
        const lanes_mask counts =
            (view.word != RECORD_NONE) & !near_rays_met(&near->rays, view.word);
        near->change[ring_of_cell(t->cells, c)] += counts ? view.weight * (rest - one) : none;
    }
    for (uint k = 0; k < near->rays.rows; k++) {
        const lanes sky = near->rays.direction[k][2] > none ? near->sky[1] : near->sky[0];
        const lanes own = near->rays.weight[k];
        const lanes weight = own != none ? own * (one - sky) : none;
        for (uint r = 0; r < t->cells.ring_count; r++)
            near->change[r] += near->ring[k] == r ? weight : none;
    }
}

/* Finds the near facets of the lanes, and what the rest counts. What is lacking beyond all of the rest is left out. */
static inline void incident_near_find(incident_near *near, const incident_group *g,
                                      const incident_tables *t)
{
    const uint count = t->frame.pixel_count;
    global const uint *met = t->cells.met + (size_t)t->cells.count * count;
    const lanes none = (lanes)0.0f, one = (lanes)1.0f;
    lanes part[2];

    near->rays = near_rays_read(t->cells.near, met, g->first, count, g->diffuse);
    if (near->rays.rows == 0u) return;
    near_rest rest = near_rest_of(&near->rays);
    for (uint c = 0; c < t->cells.count; c++) {
        const incident_view view = incident_look_plain(g, t, c);
        near_rest_add(&rest, &near->rays, view.word, view.direction[2], view.weight);
    }
    for (uint side = 0; side < 2u; side++) {
        part[side] = near_rest_part(&rest, side);
        near->rest[side] = one - near_rest_taken(&rest, side);
        near->sky[side] = rest.sky[side] / (rest.all[side] > 1e-6f ? rest.all[side] : one);
    }
    for (uint k = 0; k < near->rays.rows; k++)
        near->rays.weight[k] *= near->rays.direction[k][2] > none ? part[1] : part[0];
    incident_near_rings(near, g, t);
    incident_near_weigh(near, g, t);
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

    for (uint k = 0; k < near->rays.rows; k++) {
        const lanes_mask is_above = near->rays.direction[k][2] > 0.0f;
        const lanes weight = near->rays.weight[k] * (is_above ? near->sky[1] : near->sky[0]);
        uint bits = g->diffuse & lanes_bits_of((near->rays.weight[k] != 0.0f) & (weight != 0.0f));
        for (; bits; bits &= bits - 1u) {
            const uint i = incident_first_of(bits);
            const sky_lookup at = sky_find(t->frame, lane_of(&near->rays.direction[k][0], i),
                                           lane_of(&near->rays.direction[k][1], i),
                                           lane_of(&near->rays.direction[k][2], i));
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
