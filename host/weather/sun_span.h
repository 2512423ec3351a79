/* Sun span: sun and clear sky in a span of time. */
#ifndef SUN_SPAN_H
#define SUN_SPAN_H

#include "sky/site.h"

/* Means over the span; 0 where the sun is down. */
typedef struct sun_span {
    double direct_w_m2, diffuse_w_m2; /* of a clear sky: normal to the beam, on a level plane */
    double beyond_w_m2;               /* outside the air, on a level plane */
    double cos_zenith;                /* of the clear sky's beam, weighed by its strength */
} sun_span;

/* Clear sky of clear_sky.h at sea level, at the place of a site. */
sun_span sun_span_at(const site *place, double begin_s, double end_s);

/* What the clear sky has at one time, and the cosine of the zenith angle of the sun. */
sun_span sun_span_moment(const site *place, double time_s);

#endif
