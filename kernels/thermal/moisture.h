/* Moisture: water that goes between a surface and the air, and the heat that goes with it.
 *   saturation   Magnus over water and, below 0 C, over ice: WMO-No. 8 (2008), annex 4.B
 *   transfer     Lewis' relation: rho cp / h is the air's resistance to vapour as it is to heat
 *   dew, frost   condense below the dew point on any surface and stay on it as a film, 0.3 mm at most;
 *                what is more runs off. The film evaporates before anything else does
 * assumed: the film melts and freezes without heat; nothing condenses on backs. */
#ifndef MOISTURE_H
#define MOISTURE_H

#include "kernels/constants.h"
#include "kernels/dialect.h"
#include "kernels/lanes.h"
#include "kernels/records.h"

#define MOISTURE_AIR_J_KG_K 1005.0f
#define MOISTURE_FILM_KG_M2 0.3f /* of dew, at most */
/* Share of the pressure that vapour has at most: what is hotter is past all that evaporates. */
#define MOISTURE_BOILING 0.9f
#define MOISTURE_SUBLIMATION_J_KG 2.83e6f

/* The air at an instant, the same for all lanes. */
typedef struct moisture_air {
    float humidity, pressure_pa, density_kg_m3;
    float wet_below_k; /* what is colder may get wet; 0: nothing condenses, all is water */
} moisture_air;

/* A flux out of a surface and how much it grows per kelvin that the surface gets warmer. */
typedef struct moisture_flux {
    lanes w_m2, w_m2_k;
} moisture_flux;

static inline moisture_air moisture_air_of(forcing_record now)
{
    const float temperatures = now.air_temperature_k * (1.0f + 0.608f * now.specific_humidity);
    moisture_air air;

    air.humidity = now.specific_humidity;
    air.pressure_pa = now.pressure_pa;
    air.density_kg_m3 = now.pressure_pa / (287.05f * temperatures);
    air.wet_below_k = now.wet_below_k;
    return air;
}

static inline lanes_mask moisture_freezes(moisture_air air, lanes face_k)
{
    const lanes below_k = air.wet_below_k > 0.0f ? ZERO_CELSIUS_K : 0.0f;

    return face_k < below_k;
}

/* Heat of a kilogram of vapour, J. */
static inline lanes moisture_heat(moisture_air air, lanes face_k)
{
    const lanes frost = MOISTURE_SUBLIMATION_J_KG;
    const lanes water = 2.501e6f - 2361.0f * (face_k - ZERO_CELSIUS_K);

    return moisture_freezes(air, face_k) ? frost : water;
}

/* Vapour over a wet surface beyond that of the air, kg/kg, and how much it grows per kelvin. */
typedef struct moisture_excess {
    lanes humidity, per_k;
} moisture_excess;

static inline moisture_excess moisture_over(moisture_air air, lanes face_k)
{
    const lanes_mask freezes = moisture_freezes(air, face_k);
    const lanes water = 17.62f, ice = 22.46f, water_c = 243.12f, ice_c = 272.62f;
    const lanes slope = freezes ? ice : water, pole_c = freezes ? ice_c : water_c;
    const lanes celsius = face_k - ZERO_CELSIUS_K, reach = celsius + pole_c;
    const lanes most_pa = MOISTURE_BOILING * air.pressure_pa;
    const lanes vapour_pa = fmin(611.2f * exp(slope * celsius / reach), most_pa);
    const lanes rest_pa = air.pressure_pa - 0.378f * vapour_pa;
    const lanes humidity = 0.622f * vapour_pa / rest_pa;
    moisture_excess over;

    over.humidity = humidity - air.humidity;
    over.per_k = humidity * (slope * pole_c) / (reach * reach) * air.pressure_pa / rest_pa;
    return over;
}

/* What is left of a flux where a film alone feeds it: no more than it holds. What condenses stays. */
static inline moisture_flux moisture_from_film(moisture_flux flux, lanes film_kg_m2,
                                               lanes heat_j_kg, float step_s)
{
    const lanes none = 0.0f, most_w_m2 = film_kg_m2 * heat_j_kg / step_s;
    const lanes_mask dries = flux.w_m2 > most_w_m2;

    flux.w_m2 = dries ? most_w_m2 : flux.w_m2;
    flux.w_m2_k = dries ? none : flux.w_m2_k;
    return flux;
}

/* Where dew and frost come or go. */
static inline lanes_mask moisture_may_wet(moisture_air air, lanes face_k, lanes film_kg_m2)
{
    const lanes none = 0.0f, below_k = air.wet_below_k;

    return film_kg_m2 > none || face_k < below_k;
}

/* Heat that dew and frost take from a surface that gives h to the air.
 *   convection_w_m2_k   of the exposed fraction */
static inline moisture_flux moisture_of_dew(moisture_air air, lanes convection_w_m2_k, lanes face_k,
                                            lanes film_kg_m2, float step_s)
{
    const lanes heat = moisture_heat(air, face_k);
    const lanes fraction = heat * convection_w_m2_k / MOISTURE_AIR_J_KG_K;
    const moisture_excess over = moisture_over(air, face_k);
    moisture_flux flux;

    flux.w_m2 = fraction * over.humidity;
    flux.w_m2_k = fraction * over.per_k;
    return moisture_from_film(flux, film_kg_m2, heat, step_s);
}

/* The film after a step in which vapour took `lost_w_m2`. */
static inline lanes moisture_film(moisture_air air, lanes face_k, lanes film_kg_m2, lanes lost_w_m2,
                                  float step_s)
{
    const lanes none = 0.0f, most = MOISTURE_FILM_KG_M2;
    const lanes film = film_kg_m2 - step_s * lost_w_m2 / moisture_heat(air, face_k);

    return fmin(fmax(film, none), most);
}

#endif
