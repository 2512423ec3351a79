/* Air path: transmission and radiance of the air between the sensor and a point on its ray. Thesis
 * 2.4 (tau2, L_uE, L_uS); exact mode takes them on grids of altitudes and of level ranges where the
 * database has such. */
#ifndef AIR_PATH_H
#define AIR_PATH_H

#include "kernels/lookup.h"

/* assumed: what absorbs in the air falls off by e in this height. */
#define AIR_HEIGHT_M 2000.0f
#define AIR_LEVEL_UP 0.17364818f /* sine of 10 degrees */
#define AIR_SCALES 80.0f         /* e to it is a float still */
#define AIR_DEEPEST 60.0f        /* heights below 0, beyond which no denser air is counted */

/* Where the terms of a ray come from. */
#define AIR_BY_ZENITH 0u   /* the whole path from the ground; a part of it by what absorbs */
#define AIR_BY_ALTITUDE 1u /* paths from several altitudes */
#define AIR_BY_RANGE 2u    /* level paths at the ground */

/* A ray through the air. */
typedef struct air_way {
    uint kind;     /* AIR_BY_... */
    float z_m, up; /* of its origin; of its direction */
    float limit_m; /* range of what it meets; INFINITY: the sky */
    lookup zenith; /* among the paths' zenith angles */
} air_way;

typedef struct air_terms {
    spectrum transmission, radiance;
} air_terms;

/* Chooses where the terms of a ray come from. */
static inline uint air_kind(const air_record *air, uint thesis, float up)
{
    if (thesis) return AIR_BY_ZENITH;
    if (air->range_count > 0u && (air->is_level || fabs(up) < AIR_LEVEL_UP)) return AIR_BY_RANGE;
    return air->altitude_count > 0u && up < 0.0f ? AIR_BY_ALTITUDE : AIR_BY_ZENITH;
}

/* Length of the level way at z 0 that holds as much of what absorbs, m. Far down exp(-scales) overflows:
 * then both ends are taken by their own heights. */
static inline float air_level_m(float z_m, float up, float range_m)
{
    const float scales = up * range_m / AIR_HEIGHT_M;
    const float low = z_m / AIR_HEIGHT_M + scales;

    if (scales < -AIR_SCALES)
        return range_m *
               (exp(-(low > -AIR_DEEPEST ? low : -AIR_DEEPEST)) - exp(-z_m / AIR_HEIGHT_M)) /
               -scales;
    const float mean = fabs(scales) < 1e-3f ? 1.0f - 0.5f * scales : (1.0f - exp(-scales)) / scales;

    return range_m * mean * exp(-z_m / AIR_HEIGHT_M);
}

/* The fraction of the air up to the way's end that lies before `range_m`. */
static inline float air_fraction(air_way way, float range_m)
{
    const float fall = -way.up * way.limit_m / AIR_HEIGHT_M;

    if (!(way.limit_m < INFINITY)) return 0.0f;
    if (fall > AIR_SCALES) return exp(-way.up * range_m / AIR_HEIGHT_M - fall);
    return air_level_m(0.0f, way.up, range_m) / air_level_m(0.0f, way.up, way.limit_m);
}

/* Finds a value among `count` that ascend: the step that it lies in, and its fraction of that; below the
 * first the first, beyond the last the last step goes on. */
static inline lookup air_step(const float *value, uint count, float at)
{
    uint i = 0;

    while (i + 2u < count && value[i + 1u] < at) i++;
    const float fraction = (at - value[i]) / (value[i + 1u] - value[i]);
    const lookup step = {i, i + 1u, fraction > 0.0f ? fraction : 0.0f};
    return step;
}

/* Terms between two points: the logarithm of the transmission is linear, and in between the radiance
 * grows by what is absorbed. */
static inline air_terms air_between(spectrum near_depth, spectrum far_depth, spectrum near_radiance,
                                    spectrum far_radiance, float fraction)
{
    const spectrum near = exp(-near_depth), far = exp(-far_depth);
    const spectrum at = exp(-spectrum_mix(near_depth, far_depth, fraction)), absorbed = near - far;
    const spectrum part = fabs(absorbed) > (spectrum)1e-5f
                              ? (near - at) / absorbed
                              : (spectrum)(fraction < 1.0f ? fraction : 1.0f);
    const air_terms out = {at, near_radiance + part * (far_radiance - near_radiance)};

    return out;
}

/* A part of the whole way's terms, of one source all along.
 *   share   of what absorbs, 0..1 */
static inline air_terms air_part(air_terms whole, float fraction)
{
    const spectrum absorbed = 1.0f - whole.transmission;
    air_terms out;

    out.transmission = pow(whole.transmission, (spectrum)fraction);
    out.radiance =
        whole.radiance *
        (absorbed > (spectrum)1e-5f ? (1.0f - out.transmission) / absorbed : (spectrum)fraction);
    return out;
}

#ifdef __OPENCL_C_VERSION__

/* tau2, and L_uE + L_uS, of the whole path up from the ground. */
static inline air_terms air_whole(global const float *rows, radiometry_record frame, lookup zenith,
                                  uint block)
{
    global const float *paths = rows + (size_t)SPECTRA_PATHS * frame.sample_count;
    air_terms out;

    out.transmission = lookup_spectrum(paths, frame.sample_count, zenith, block);
    out.radiance = lookup_spectrum(paths + (size_t)frame.path_count * frame.sample_count,
                                   frame.sample_count, zenith, block);
    return out;
}

/* The terms up to the altitude z_m. */
static inline air_terms air_at_altitude(global const float *rows, radiometry_record frame,
                                        const air_record *air, lookup zenith, float z_m, uint block)
{
    const float top = air->altitude_z_m[air->altitude_count - 1u];
    const lookup at = air_step(air->altitude_z_m, air->altitude_count, z_m < top ? z_m : top);
    const uint row = frame.sample_count;
    global const float *depth = rows + (size_t)air->first_row * row;
    global const float *radiance = depth + (size_t)air->altitude_count * frame.path_count * row;
    lookup low = zenith, high = zenith;

    low.low += at.low * frame.path_count;
    low.high += at.low * frame.path_count;
    high.low += at.high * frame.path_count;
    high.high += at.high * frame.path_count;
    return air_between(lookup_spectrum(depth, row, high, block),
                       lookup_spectrum(depth, row, low, block),
                       lookup_spectrum(radiance, row, high, block),
                       lookup_spectrum(radiance, row, low, block), 1.0f - at.fraction);
}

/* The terms of a level path. */
static inline air_terms air_at_range(global const float *rows, radiometry_record frame,
                                     const air_record *air, float range_m, uint block)
{
    const lookup at = air_step(air->range_m, air->range_count, range_m);
    const uint row = frame.sample_count;
    global const float *depth =
        rows + ((size_t)air->first_row + 2u * air->altitude_count * frame.path_count) * row;
    global const float *radiance = depth + (size_t)air->range_count * row;

    return air_between(spectrum_load(depth + (size_t)at.low * row, block),
                       spectrum_load(depth + (size_t)at.high * row, block),
                       spectrum_load(radiance + (size_t)at.low * row, block),
                       spectrum_load(radiance + (size_t)at.high * row, block), at.fraction);
}

/* The terms of the air between the ray's origin and `range_m` on it. */
INLINE air_terms air_upto(global const float *rows, radiometry_record frame, const air_record *air,
                          air_way way, float range_m, uint block)
{
    if (way.kind == AIR_BY_RANGE)
        return air_at_range(rows, frame, air,
                            air_level_m(way.z_m - air->ground_z_m, way.up, range_m), block);
    if (way.kind == AIR_BY_ALTITUDE)
        return air_at_altitude(rows, frame, air, way.zenith, way.z_m + way.up * range_m, block);
    const air_terms whole = air_whole(rows, frame, way.zenith, block);
    return range_m < way.limit_m ? air_part(whole, air_fraction(way, range_m)) : whole;
}

#endif

#endif
