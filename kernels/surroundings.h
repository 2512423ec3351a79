/* Surroundings: the rays of the hemisphere of a pixel, and the facets that they met. Exact mode. */
#ifndef SURROUNDINGS_H
#define SURROUNDINGS_H

#include "hemisphere_lanes.h"
#include "incident.h"
#include "pixel.h"

/* What the surfaces around a pixel are read from. */
typedef struct around {
    global const facet_record *facets;
    global const material_record *materials;
    global const float *temperature_k;
    global const background_record *facet_background;
} around;

/* A facet seen from a point along a unit direction, without its emissivity.
 *   out_cosine   of the angle from its normal to the ray */
static inline incident_facet see_face(around from, radiometry_record frame, uint facet,
                                      float weight, float lit, const float *direction,
                                      float *out_cosine)
{
    const facet_record seen = from.facets[facet];
    const float along = -pixel_dot(seen.normal, direction);
    const float facing = along < 0.0f ? -1.0f : 1.0f;
    incident_facet out;

    out.weight = weight;
    out.temperature_k = from.temperature_k[facet];
    out.sun = lit * fmax(facing * pixel_dot(seen.normal, frame.sun), 0.0f);
    out.shape_factor = from.facet_background[facet].shape_factor;
    *out_cosine = fabs(along);
    return out;
}

/* The same with its emissivity. */
static inline incident_facet see_facet(around from, radiometry_record frame, uint facet,
                                       float weight, float lit, const float *direction)
{
    float cosine;
    incident_facet out = see_face(from, frame, facet, weight, lit, direction, &cosine);

    out.emissivity =
        lookup_emissivity(from.materials[from.facets[facet].material], pixel_angle_deg(cosine), 0u);
    return out;
}

/* The hemispheres of LANES_WIDTH diffuse surfaces: axes of their cells, and factors of the weights of
 * cells above and below the horizon, which give both their exact shares, (1 + cos slope) / 2 of it the
 * sky's. */
typedef struct diffuse_view {
    hemisphere_lanes axes;
    lanes above, below;
    lanes open; /* the sky's share of an open hemisphere */
    lanes seen; /* of the cells above the horizon, the share that sees the sky */
} diffuse_view;

/* Looks at what the rays of pixels first .. first + LANES_WIDTH - 1 of `count` met.
 *   cell   (cell_count, 4), met: (cell_count, count): see hemisphere.cl */
static inline diffuse_view look_around(const lanes *normal, uint cell_count,
                                       global const float *cell, global const uint *met, uint first,
                                       uint count)
{
    diffuse_view view = {.axes = hemisphere_lanes_of(normal)};
    const lanes share = 0.5f * (1.0f + normal[2]);
    lanes above = (lanes)0.0f, seen = (lanes)0.0f, direction[3];

    for (uint c = 0; c < cell_count; c++) {
        const lanes_bits word = lanes_load_bits(met + (size_t)c * count, first, count);
        hemisphere_lanes_direction(&view.axes, cell + 4u * c, direction);
        const lanes weight = direction[2] > 0.0f ? (lanes)cell[4u * c + 3u] : (lanes)0.0f;
        above += weight;
        seen += word == RECORD_NONE ? weight : (lanes)0.0f;
    }
    const lanes_mask has_both = (above > 1e-6f) & (above < 1.0f - 1e-6f);
    view.above = has_both ? share / above : (lanes)1.0f;
    view.below = has_both ? (1.0f - share) / (1.0f - above) : (lanes)1.0f;
    view.open = above * view.above;
    view.seen = above > 0.0f ? seen / above : (lanes)0.0f;
    return view;
}

#endif
