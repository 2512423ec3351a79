/* Incident hemisphere: the rays of the hemisphere of a pixel, and the facets that they met. Exact mode. */
#ifndef INCIDENT_HEMISPHERE_H
#define INCIDENT_HEMISPHERE_H

#include "kernels/hemisphere/hemisphere_lanes.h"
#include "kernels/radiance/incident.h"
#include "kernels/radiance/pixel.h"

/* What the surfaces around a pixel emit and reflect is read from these. */
typedef struct emitter_tables {
    surface_tables surfaces;
    light_tables light;
    uint light_length; /* floats of a row of it */
} emitter_tables;

/* A row of light for a block of the pixels' samples: LIGHT_BLOCK of them share a float. */
static inline spectrum light_at(global const float *row, uint block)
{
#if SPECTRUM_WIDTH == 16
    const float4 four = vload4(block, row);

    return (spectrum)((float4)four.x, (float4)four.y, (float4)four.z, (float4)four.w);
#else
    return (spectrum)row[block * SPECTRUM_WIDTH / LIGHT_BLOCK];
#endif
}

/* Light of a facet for a block of the pixels' samples. */
static inline incident_light light_of(const emitter_tables *t, uint facet, uint block)
{
    const uint length = t->light_length;
    global const float *light = t->light.light + (size_t)facet * LIGHT_ROWS * length;

    return (incident_light){light_at(light + LIGHT_LOBE * length, block),
                            light_at(light + LIGHT_EXTRA * length, block)};
}

/* A side of a facet without its emissivity.
 *   is_back   1: the side that its normal does not leave */
static inline incident_facet see_face(const emitter_tables *t, radiometry_record frame, uint facet,
                                      float weight, float lit, uint is_back)
{
    const facet_record own = t->surfaces.facets[facet];
    const float facing = is_back ? -1.0f : 1.0f;
    incident_facet out;

    out.facet = facet;
    out.weight = weight;
    out.temperature_k = t->surfaces.facet_temperature_k[facet];
    out.sun = lit * fmax(facing * pixel_dot(own.normal, frame.sun), 0.0f);
    out.shape_factor = t->light.facet_background[facet].shape_factor;
    return out;
}

/* A facet seen from a point along a unit direction. */
static inline incident_facet see_facet(const emitter_tables *t, radiometry_record frame, uint facet,
                                       float weight, float lit, const float *direction)
{
    const facet_record seen = t->surfaces.facets[facet];
    const float along = pixel_dot(seen.normal, direction);
    incident_facet out = see_face(t, frame, facet, weight, lit, along > 0.0f);

    out.emissivity =
        lookup_emissivity(t->surfaces.materials[seen.material], pixel_angle_deg(fabs(along)), 0u);
    return out;
}

/* The hemispheres of LANES_WIDTH diffuse surfaces: axes of their cells, and factors of the weights of
 * cells above and below the horizon, which give both their exact shares, (1 + cos slope) / 2 of it the
 * sky's. */
typedef struct diffuse_view {
    hemisphere_lanes axes;
    hemisphere_sets sets;
    lanes above, below;
    lanes open;             /* the sky's fraction of an open hemisphere */
    lanes seen;             /* of the cells above the horizon, the fraction that sees the sky */
    lanes ring[LOBE_RINGS]; /* weights of the rings of diffuse lobes, */
    lanes high[LOBE_RINGS]; /* and of what of them is above the horizon */
} diffuse_view;

/* The grid of the hemisphere and what its rays met, see hemisphere.cl. */
typedef struct incident_cells {
    uint count, ring_count;   /* rings of diffuse lobes, each of as many cells */
    global const float *cell; /* of the first set */
    global const uint *met, *direction_set;
    global const float *near; /* NULL: none */
} incident_cells;

/* Ring of the lobes that a cell lies in; the lowest first. */
static inline uint ring_of_cell(incident_cells cells, uint c)
{
    return c / (cells.count / cells.ring_count);
}

/* Looks at what the rays of pixels first .. first + LANES_WIDTH - 1 of `count` met. */
static inline diffuse_view look_around(const lanes *normal, incident_cells cells, uint first,
                                       uint count)
{
    diffuse_view view = {.axes = hemisphere_lanes_of(normal),
                         .sets =
                             hemisphere_sets_of(cells.direction_set, cells.count, first, count)};
    lanes above = (lanes)0.0f, seen = (lanes)0.0f, direction[3];
    lanes whole[LOBE_RINGS];

    for (uint r = 0; r < cells.ring_count; r++) view.high[r] = whole[r] = (lanes)0.0f;
    for (uint c = 0; c < cells.count; c++) {
        const lanes_bits word = lanes_load_bits(cells.met + (size_t)c * count, first, count);
        hemisphere_cell_directions(&view.axes, &view.sets, cells.cell + 4u * c, direction);
        const lanes weight = direction[2] > 0.0f ? (lanes)cells.cell[4u * c + 3u] : (lanes)0.0f;
        const uint ring = ring_of_cell(cells, c);
        above += weight;
        seen += word == RECORD_NONE ? weight : (lanes)0.0f;
        view.high[ring] += weight;
        whole[ring] += cells.cell[4u * c + 3u];
    }
    const hemisphere_shares shares = hemisphere_share(normal[2], above);
    view.above = shares.above;
    view.below = shares.below;
    view.open = above * view.above;
    view.seen = above > 0.0f ? seen / above : (lanes)0.0f;
    for (uint r = 0; r < cells.ring_count; r++) {
        view.ring[r] = view.above * view.high[r] + view.below * (whole[r] - view.high[r]);
        view.high[r] *= view.above;
    }
    return view;
}

static inline float lane_of(const lanes *from, uint lane)
{
    return ((const float *)from)[lane];
}

/* A diffuse lobe in one of its rings: 1 for a Lambertian surface.
 *   lobe   its first row, RECORD_NONE: Lambertian */
static inline spectrum lobe_of_ring(global const float *emissivity, uint row_length, uint lobe,
                                    uint ring, uint block)
{
    if (lobe == RECORD_NONE) return (spectrum)1.0f;
    return spectrum_load(emissivity + (size_t)(lobe + LOBE_ROWS + ring) * row_length, block);
}

/* The sum of a lobe's weights, which is 1 but for what the grid misses of the rings. */
static inline spectrum lobe_sum(const diffuse_view *view, uint lane, uint ring_count,
                                global const float *emissivity, uint row_length, uint lobe,
                                uint block)
{
    spectrum sum = (spectrum)0.0f;

    if (lobe == RECORD_NONE) return (spectrum)1.0f;
    for (uint r = 0; r < ring_count; r++)
        sum += lane_of(&view->ring[r], lane) * lobe_of_ring(emissivity, row_length, lobe, r, block);
    return sum;
}

#endif
