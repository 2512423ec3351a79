/* Incident rays: those of neighbouring pixels that met facets, and what facets get from facets along them.
 * Device only. */
#ifndef INCIDENT_RAYS_H
#define INCIDENT_RAYS_H

#include "kernels/radiance/incident_group.h"

/* A ray that met something. */
typedef struct incident_ray {
    uint target;
    float weight;
    lookup emissivity; /* at the ray's angle */
} incident_ray;

/* Rays of the lanes through the cells of a part. */
typedef struct incident_rays {
    incident_ray ray[LANES_WIDTH][ROUND];
    uint count[LANES_WIDTH];
    uint ring_end[LOBE_RINGS][LANES_WIDTH]; /* of the rays, by the ring of their cell */
} incident_rays;

static inline void incident_clear_rays(incident_rays *rays)
{
    for (uint i = 0; i < LANES_WIDTH; i++) rays->count[i] = 0u;
    for (uint r = 0; r < LOBE_RINGS; r++)
        for (uint i = 0; i < LANES_WIDTH; i++) rays->ring_end[r][i] = 0u;
}

static inline void incident_end_cell(incident_rays *rays, uint ring)
{
    for (uint i = 0; i < LANES_WIDTH; i++) rays->ring_end[ring][i] = rays->count[i];
}

/* A cell as the lanes see it. */
typedef struct incident_view {
    lanes_bits word; /* see hemisphere.cl */
    uint met;        /* a bit per diffuse lane that sees a facet there */
    lanes direction[3], weight;
} incident_view;

/* The cell without regard to near facets. */
static inline incident_view incident_look_plain(const incident_group *g, const incident_tables *t,
                                                uint c)
{
    const uint count = t->frame.pixel_count;
    incident_view view;

    view.word = lanes_load_bits(t->cells.met + (size_t)c * count, g->first, count);
    view.met = g->diffuse & lanes_bits_of(view.word != RECORD_NONE);
    hemisphere_cell_directions(&g->view.axes, &g->view.sets, t->cells.cell + 4u * c,
                               view.direction);
    view.weight =
        t->cells.cell[4u * c + 3u] * (view.direction[2] > 0.0f ? g->view.above : g->view.below);
    return view;
}

/* A cell, or behind the last of them a near facet: all of one ring of the lobes, then those of the next. */
static inline incident_view incident_look(const incident_group *g, const incident_tables *t, uint c)
{
    const incident_near *near = &g->near;
    incident_view view;

    if (c < t->cells.count) {
        view = incident_look_plain(g, t, c);
        if (near->rays.rows > 0u && view.met)
            view.weight *= near_rays_met(&near->rays, view.word) ? (lanes)1.0f
                           : view.direction[2] > 0.0f            ? near->rest[1]
                                                                 : near->rest[0];
        return view;
    }
    const uint k = (c - t->cells.count) % near->rays.rows,
               ring = (c - t->cells.count) / near->rays.rows;
    view.word = near->rays.word[k];
    view.weight = near->rays.weight[k];
    view.met = g->diffuse & lanes_bits_of((view.weight != 0.0f) & (near->ring[k] == ring));
    for (uint axis = 0; axis < 3u; axis++) view.direction[axis] = near->rays.direction[k][axis];
    return view;
}

/* What the rays of lanes met. */
typedef struct incident_aim {
    uint target[LANES_WIDTH], material[LANES_WIDTH];
} incident_aim;

/* Adds the rays of lanes through a cell.
 *   cosine   of the angle from what they met */
static inline void incident_add_rays(incident_rays *rays, const incident_view *view,
                                     const incident_aim *aim, const incident_tables *t,
                                     lanes cosine)
{
    const lanes angle_deg = acos(fmin(cosine, 1.0f)) * (180.0f / PI_F);
    const lanes row = floor(angle_deg), fraction = angle_deg - row;

    for (uint bits = view->met; bits; bits &= bits - 1u) {
        const uint i = incident_first_of(bits);
        global const material_record *material = t->emitters.surfaces.materials + aim->material[i];
        const uint first = material->emissivity_first, last = material->emissivity_angles - 1u;
        const uint low = (uint)lane_of(&row, i);
        incident_ray *ray = &rays->ray[i][rays->count[i]++];
        ray->target = aim->target[i];
        ray->weight = lane_of(&view->weight, i);
        ray->emissivity.low = first + min(low, last);
        ray->emissivity.high = first + min(low + 1u, last);
        ray->emissivity.fraction = last > 0u ? lane_of(&fraction, i) : 0.0f;
    }
}

/* Adds the facets that the lanes see through a cell; the target of a ray is its word. */
static inline void incident_see_facets(incident_rays *rays, const incident_group *g,
                                       const incident_tables *t, uint c)
{
    const incident_view view = incident_look(g, t, c);
    incident_aim aim;
    lanes normal[3] = {(lanes)0.0f, (lanes)0.0f, (lanes)1.0f};

    if (!view.met) return;
    for (uint bits = view.met; bits; bits &= bits - 1u) {
        const uint i = incident_first_of(bits);
        aim.target[i] = ((const uint *)&view.word)[i];
        global const facet_record *facet =
            t->emitters.surfaces.facets + (aim.target[i] & ~HEMISPHERE_LIT);
        aim.material[i] = facet->material;
        for (uint k = 0; k < 3u; k++) LANES_SET(normal[k], i, facet->normal[k]);
    }
    incident_add_rays(rays, &view, &aim, t,
                      fabs(normal[0] * view.direction[0] + normal[1] * view.direction[1] +
                           normal[2] * view.direction[2]));
}

/* What facets send to a lane in a block of samples. */
static inline spectrum incident_from_facets(const incident_rays *rays, uint lane,
                                            const incident_lobe *lobe, const incident_tables *t,
                                            uint block)
{
    const uint row = t->frame.sample_count;
    spectrum total = (spectrum)0.0f;
    uint n = 0;

    for (uint r = 0; n < rays->count[lane]; r++) {
        spectrum sum = (spectrum)0.0f;
        for (; n < rays->ring_end[r][lane]; n++) {
            const incident_ray ray = rays->ray[lane][n];
            const uint facet = ray.target & ~HEMISPHERE_LIT;
            global const float *light = t->emitters.light.light + (size_t)facet * LIGHT_ROWS * row;
            const spectrum own = lookup_spectrum(t->spectra.emissivity, row, ray.emissivity, block);
            spectrum arriving = spectrum_load(light + LIGHT_ARRIVING * row, block);
            if (ray.target & HEMISPHERE_LIT)
                arriving += spectrum_load(light + LIGHT_SUN * row, block);
            const spectrum more = spectrum_load(light + LIGHT_BLACK * row, block) - arriving;
            sum = fma((spectrum)ray.weight, fma(own, more, arriving), sum);
        }
        total = fma(lobe->ring[r][0], sum, total);
    }
    return total;
}

/* Adds what facets get of those that they see through the cells of a part.
 *   out   of facet 0 */
static inline void incident_add_facets(const incident_group *g, const incident_tables *t,
                                       incident_part part, global float *out)
{
    const uint row = t->frame.sample_count;
    incident_rays rays;
    incident_lobe lobe;

    incident_clear_rays(&rays);
    for (uint c = part.first; c < part.end; c++) {
        incident_see_facets(&rays, g, t, c);
        incident_end_cell(&rays, ring_of_cell(t->cells, c));
    }
    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++)
        for (uint k = 0; k < g->column_count; k++) {
            incident_find_lobe(&lobe, g, incident_first_of(g->column[k]), t, block, 1u);
            for (uint bits = g->column[k]; bits; bits &= bits - 1u) {
                const uint i = incident_first_of(bits);
                incident_add(incident_from_facets(&rays, i, &lobe, t, block), 1.0f, part,
                             incident_rows_of(g, i, t, out), block);
            }
        }
}

#endif
