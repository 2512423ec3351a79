/* Convection: the heat that air takes from a surface where it depends on how warm the surface is.
 *   TARP         G. Walton, NBSSIR 83-2655 (1983), as the EnergyPlus engineering reference has it:
 *                what the wind takes, and what rises by itself
 *   blended      forced and free convection as (forced^3 + free^3)^(1/3): S. Churchill, AIChE Journal 23
 *                (1977) 10; free as TARP has it
 *   similarity   J.-F. Louis, Boundary-Layer Meteorology 17 (1979) 187: the logarithmic wind over a
 *                roughness length times a function of the bulk Richardson number. In stable air that
 *                function ends all exchange, as over endless level ground; a facet keeps what TARP's air
 *                takes from a plate (assumed), and at least the 2 W m-2 K-1 of still air that models of
 *                snow give it: R. Jordan, CRREL Special Report 91-16 (1991) */
#ifndef CONVECTION_H
#define CONVECTION_H

#include "kernels/constants.h"
#include "kernels/dialect.h"
#include "kernels/lanes.h"

#define CONVECTION_WIND 0u /* does not depend on the surface */
#define CONVECTION_TARP 1u
#define CONVECTION_SIMILARITY 2u
#define CONVECTION_BLENDED 3u

#define CONVECTION_LEAST_W_M2_K 2.0f

/* The air at an instant. */
typedef struct convection_air {
    uint law;
    float temperature_k;
    float wind_w_m2_k; /* what the wind takes; of similarity where both are equally warm */
    float buoyancy;    /* similarity: Richardson number per relative rise of the surface, above 0 */
    float roughness;   /* similarity: Louis' c */
    float plate_w_m2_k; /* similarity: what the wind takes from a plate; 0: no floor */
} convection_air;

/* The cube root of what is 0 or more, within 5 roundings: OpenCL's takes its lanes one by one on CPUs. A step
 * of fourth order and one of Newton's towards its inverse, without a division, from a guess by the exponent
 * that is within 5 %. */
static inline lanes convection_cube_root(lanes cube)
{
#ifdef __OPENCL_C_VERSION__
#if LANES_WIDTH == 16
    lanes inverse = as_float16(1419802505 - as_int16(cube) / 3);
#else
    lanes inverse = as_float(1419802505 - as_int(cube) / 3);
#endif
    const lanes far = 1.0f - cube * inverse * inverse * inverse;
    inverse += inverse * far * (1.0f / 3.0f + far * (2.0f / 9.0f + far * (14.0f / 81.0f)));
    const lanes near = 1.0f - cube * inverse * inverse * inverse;
    inverse += inverse * near * (1.0f / 3.0f);
    return cube * inverse * inverse;
#else
    return cbrtf(cube);
#endif
}

/* That over the cube root of how much warmer or colder than the air a face is that looks up by `up`, the third
 * component of its normal. */
static inline lanes convection_rising(lanes up, lanes rise_k)
{
    const lanes none = 0.0f, tilt = fabs(up);

    return rise_k * up > none ? 9.482f / (7.238f - tilt) : 1.810f / (1.382f + tilt);
}

/* What rises by itself, W m-2 K-1. */
static inline lanes convection_free(convection_air air, lanes up, lanes face_k)
{
    const lanes rise_k = face_k - air.temperature_k;

    return convection_rising(up, rise_k) * convection_cube_root(fabs(rise_k));
}

static inline lanes convection_blended(convection_air air, lanes up, lanes face_k)
{
    const lanes rise_k = face_k - air.temperature_k, rising = convection_rising(up, rise_k);
    const float wind = air.wind_w_m2_k;

    return convection_cube_root(wind * wind * wind + rising * rising * rising * fabs(rise_k));
}

static inline lanes convection_similarity(convection_air air, lanes up, lanes face_k)
{
    const lanes none = 0.0f;
    const lanes relative = (face_k - air.temperature_k) / air.temperature_k;
    const lanes richardson = fabs(relative) * air.buoyancy;
    const lanes damped = 1.0f + 4.7f * richardson;
    const lanes rises = 1.0f + 9.4f * richardson / (1.0f + air.roughness * sqrt(richardson));
    const lanes least = CONVECTION_LEAST_W_M2_K;
    const lanes alone = air.wind_w_m2_k * (relative > none ? rises : 1.0f / (damped * damped));
    const lanes plate = air.plate_w_m2_k + convection_free(air, up, face_k);
    const lanes kept = relative > none ? alone : fmax(alone, plate);

    return air.plate_w_m2_k > 0.0f ? fmax(kept, least) : alone;
}

/* Of any law. */
static inline lanes convection_of(convection_air air, lanes up, lanes face_k)
{
    if (air.law == CONVECTION_TARP) return air.wind_w_m2_k + convection_free(air, up, face_k);
    if (air.law == CONVECTION_BLENDED) return convection_blended(air, up, face_k);
    if (air.law == CONVECTION_SIMILARITY) return convection_similarity(air, up, face_k);
    return (lanes)air.wind_w_m2_k;
}

#endif
