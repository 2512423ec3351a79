/* Incident: radiance that reaches a surface from a facet it sees, and the sky's fraction of the open
 * hemisphere. The exact counterpart of the background of eq. 2.4-2. */
#ifndef INCIDENT_H
#define INCIDENT_H

#include "kernels/radiance/radiometry.h"
#include "kernels/radiance/sky.h"

/* A facet as it is seen along one ray. */
typedef struct incident_facet {
    float weight; /* of the ray */
    float temperature_k;
    float sun;          /* lit x cosine of the sun's angle */
    float shape_factor; /* the facet's own */
    lookup emissivity;  /* at the ray's angle */
    uint facet;
} incident_facet;

/* What a facet gets besides its fraction of the sky, see interreflection.cl. */
typedef struct incident_light {
    spectrum lobe;  /* of the sun: (1 - e_S) / (1 - e_hemi) */
    spectrum extra; /* radiance beyond the closure below */
} incident_light;

/* What reaches such a facet: the sun, its own share of the sky, and what else it sees taken as black
 * at its temperature, so that an enclosure of one temperature is black; and what light between facets
 * adds to that.
 *   sun   E_S tau1; sky   integrated over the hemisphere */
static inline spectrum incident_arriving(const incident_facet *f, spectrum black_body, spectrum sun,
                                         spectrum sky, incident_light light)
{
    return sun_on_surface(sun, 1.0f, f->sun) * light.lobe +
           radiance_from_above(f->shape_factor, sky, black_body) + light.extra;
}

/* What it radiates: its emission, and what it reflects of that. */
static inline spectrum incident_radiance(const incident_facet *f, spectrum emissivity,
                                         spectrum black_body, spectrum sun, spectrum sky,
                                         incident_light light)
{
    return background_radiance(emissivity, black_body,
                               incident_arriving(f, black_body, sun, sky, light));
}

#endif
