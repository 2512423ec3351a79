/* Convection: the heat that air takes from a surface where it depends on how warm the surface is.
 *   TARP         G. Walton, NBSSIR 83-2655 (1983), as the EnergyPlus engineering reference has it:
 *                what the wind takes, and what rises by itself
 *   similarity   J.-F. Louis, Boundary-Layer Meteorology 17 (1979) 187: the logarithmic wind over a
 *                roughness length times a function of the bulk Richardson number */
#ifndef CONVECTION_H
#define CONVECTION_H

#include "kernels/constants.h"
#include "kernels/dialect.h"
#include "kernels/lanes.h"

#define CONVECTION_WIND 0u /* does not depend on the surface */
#define CONVECTION_TARP 1u
#define CONVECTION_SIMILARITY 2u

/* The air at an instant. */
typedef struct convection_air {
    uint law;
    float temperature_k;
    float wind_w_m2_k; /* what the wind takes; of similarity where both are equally warm */
    float buoyancy;    /* similarity: Richardson number per relative rise of the surface, above 0 */
    float roughness;   /* similarity: Louis' c */
} convection_air;

/* Of a face that looks up by `up`, the third component of its normal: W m-2 K-1. */
static inline lanes convection_tarp(convection_air air, lanes up, lanes face_k)
{
    const lanes none = 0.0f, rise_k = face_k - air.temperature_k, tilt = fabs(up);
    const lanes root = cbrt(fabs(rise_k));
    const lanes risen =
        rise_k * up > none ? 9.482f * root / (7.238f - tilt) : 1.810f * root / (1.382f + tilt);

    return air.wind_w_m2_k + risen;
}

static inline lanes convection_similarity(convection_air air, lanes face_k)
{
    const lanes none = 0.0f;
    const lanes relative = (face_k - air.temperature_k) / air.temperature_k;
    const lanes richardson = fabs(relative) * air.buoyancy;
    const lanes damped = 1.0f + 4.7f * richardson;
    const lanes rises = 1.0f + 9.4f * richardson / (1.0f + air.roughness * sqrt(richardson));

    return air.wind_w_m2_k * (relative > none ? rises : 1.0f / (damped * damped));
}

/* Of any law. */
static inline lanes convection_of(convection_air air, lanes up, lanes face_k)
{
    if (air.law == CONVECTION_TARP) return convection_tarp(air, up, face_k);
    if (air.law == CONVECTION_SIMILARITY) return convection_similarity(air, face_k);
    return (lanes)air.wind_w_m2_k;
}

#endif
