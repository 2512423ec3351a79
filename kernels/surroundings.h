/* Surroundings: the rays of the hemisphere of a pixel, and the facets that they met. Exact mode. */
#ifndef SURROUNDINGS_H
#define SURROUNDINGS_H

#include "hemisphere.h"
#include "incident.h"
#include "pixel.h"

/* What the surfaces around a pixel are read from. */
typedef struct around {
    global const facet_record *facets;
    global const material_record *materials;
    global const float *temperature_k;
    global const background_record *facet_background;
} around;

/* A facet seen from a point along a unit direction. */
static inline incident_facet see_facet(around from, radiometry_record frame, uint facet,
                                       float weight, float lit, const float *direction)
{
    const facet_record seen = from.facets[facet];
    const float along = -pixel_dot(seen.normal, direction);
    const float facing = along < 0.0f ? -1.0f : 1.0f;
    incident_facet out;

    out.weight = weight;
    out.temperature_k = from.temperature_k[facet];
    out.sun = lit * fmax(facing * pixel_dot(seen.normal, frame.sun), 0.0f);
    out.shape_factor = from.facet_background[facet].shape_factor;
    out.emissivity =
        lookup_emissivity(from.materials[seen.material], pixel_angle_deg(fabs(along)), 0u);
    return out;
}

/* The hemisphere of a diffuse surface: axes of its cells, and factors of the weights of cells above
 * and below the horizon, which give both their exact shares, (1 + cos slope) / 2 of it the sky's. */
typedef struct diffuse_view {
    hemisphere_frame axes;
    float above, below;
    float seen; /* of the cells above the horizon, the share that sees the sky */
} diffuse_view;

static inline float cell_direction(const hemisphere_frame *axes, global const float *cell, uint c,
                                   float *out)
{
    float in_frame[4];

    vstore4(vload4(c, cell), 0, in_frame);
    hemisphere_direction(axes, in_frame, out);
    return in_frame[3];
}

static inline diffuse_view look_around(const float *normal, uint cell_count,
                                       global const float *cell, global const uint *met,
                                       uint stride)
{
    diffuse_view view = {.axes = hemisphere_frame_of(normal)};
    const float share = 0.5f * (1.0f + normal[2]);
    float above = 0.0f, seen = 0.0f, direction[3];

    for (uint c = 0; c < cell_count; c++) {
        const float weight = cell_direction(&view.axes, cell, c, direction);
        if (direction[2] <= 0.0f) continue;
        above += weight;
        seen += met[(size_t)c * stride] == RECORD_NONE ? weight : 0.0f;
    }
    const uint has_both = above > 1e-6f && above < 1.0f - 1e-6f;
    view.above = has_both ? share / above : 1.0f;
    view.below = has_both ? (1.0f - share) / (1.0f - above) : 1.0f;
    view.seen = above > 0.0f ? seen / above : 0.0f;
    return view;
}

#endif
