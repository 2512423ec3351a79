#include "weather/sun_span.h"

#include "kernels/constants.h"
#include "sky/sun.h"
#include "weather/clear_sky.h"

#include <math.h>

enum { PARTS = 60 };

static const clear_sky_air common_air = {101325.0, 1.5, CLEAR_SKY_AEROSOL};

sun_span sun_span_moment(const site *place, double time_s)
{
    const sun_position sun = sun_at(time_s, place->latitude_deg, place->longitude_deg);
    sun_span s = {.cos_zenith = cos(sun.zenith_rad)};

    if (sun.zenith_rad >= 0.5 * M_PI) return s;
    clear_sky_irradiance(&common_air, sun.zenith_rad, sun.distance_au, &s.direct_w_m2,
                         &s.diffuse_w_m2);
    s.beyond_w_m2 =
        (double)SOLAR_CONSTANT_W_M2 / (sun.distance_au * sun.distance_au) * s.cos_zenith;
    return s;
}

sun_span sun_span_at(const site *place, double begin_s, double end_s)
{
    sun_span sum = {0};

    for (int i = 0; i < PARTS; i++) {
        const sun_span s = sun_span_moment(place, begin_s + (end_s - begin_s) * (i + 0.5) / PARTS);
        sum.direct_w_m2 += s.direct_w_m2 / PARTS;
        sum.diffuse_w_m2 += s.diffuse_w_m2 / PARTS;
        sum.beyond_w_m2 += s.beyond_w_m2 / PARTS;
        sum.cos_zenith += s.direct_w_m2 * s.cos_zenith / PARTS;
    }
    if (sum.direct_w_m2 > 0.0) sum.cos_zenith /= sum.direct_w_m2;
    return sum;
}
