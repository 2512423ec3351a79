/* Sky: radiance of a direction of the sky from the table of directions. Thesis 2.4.1. */
#ifndef SKY_H
#define SKY_H

#include "kernels/lookup.h"

typedef struct sky_lookup {
    lookup zenith, azimuth;
} sky_lookup;

/* Finds a place in the table; below the horizon, the horizon. Azimuth clockwise from north, 0 .. 360. */
static inline sky_lookup sky_place(radiometry_record frame, float zenith_deg, float azimuth_deg)
{
    return (sky_lookup){
        lookup_regular(zenith_deg, 0.0f, frame.zenith_step_deg, frame.zenith_count),
        lookup_regular(azimuth_deg, 0.0f, frame.azimuth_step_deg, frame.azimuth_count)};
}

/* Finds a direction (unit, ENU). */
static inline sky_lookup sky_find(radiometry_record frame, float x, float y, float z)
{
    const float degree = 180.0f / PI_F;
    const float azimuth_deg = atan2(x, y) * degree;
    const float zenith_deg = acos(z < -1.0f ? -1.0f : z > 1.0f ? 1.0f : z) * degree;

    return sky_place(frame, zenith_deg, azimuth_deg < 0.0f ? azimuth_deg + 360.0f : azimuth_deg);
}

#ifdef __OPENCL_C_VERSION__

/* eq. 2.4.1-1 to 2.4.1-3: first along the zenith, then along the azimuth.
 *   table   shape (zenith_count x azimuth_count, sample_count) */
static inline spectrum sky_radiance(global const float *table, radiometry_record frame,
                                    sky_lookup at, uint block)
{
    lookup low = at.zenith, high = at.zenith;

    low.low = at.zenith.low * frame.azimuth_count + at.azimuth.low;
    low.high = at.zenith.high * frame.azimuth_count + at.azimuth.low;
    high.low = at.zenith.low * frame.azimuth_count + at.azimuth.high;
    high.high = at.zenith.high * frame.azimuth_count + at.azimuth.high;
    const spectrum first = lookup_spectrum(table, frame.sample_count, low, block);
    if (at.azimuth.fraction == 0.0f) return first;
    return spectrum_mix(first, lookup_spectrum(table, frame.sample_count, high, block),
                        at.azimuth.fraction);
}

#endif

#endif
