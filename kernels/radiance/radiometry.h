/* Radiometry: the terms of the radiance that reaches the sensor. Thesis 2.4, eq. 2.4-1 and 2.4-2.
 * Spectra in W m-2 sr-1 um-1, irradiance in W m-2 um-1. */
#ifndef RADIOMETRY_H
#define RADIOMETRY_H

#include "kernels/media/transmission.h"

/* eq. 2.4-2, first term: e_T B(T_T). */
static inline spectrum emitted_radiance(spectrum emissivity, spectrum black_body)
{
    return emissivity * black_body;
}

/* eq. 2.4-2, second term: E_S/pi tau1 tau1c cos(theta_S), still to be multiplied by (1 - e).
 *   sun           E_S tau1
 *   transmitted   tau1c: 0 in shadow, 1 in the sun
 *   cosine        of the sun's angle from the normal; below 0 counts 0 */
static inline spectrum sun_on_surface(spectrum sun, float transmitted, float cosine)
{
    return sun * (transmitted * (cosine > 0.0f ? cosine : 0.0f) / PI_F);
}

/* eq. 2.4-2, the background's brace: e_B B(T_B) + E_S/pi tau1 tau_SB cos(theta_B) (1 - e_B). */
static inline spectrum background_radiance(spectrum emissivity, spectrum black_body,
                                           spectrum sun_on_background)
{
    return emitted_radiance(emissivity, black_body) + sun_on_background * (1.0f - emissivity);
}

/* eq. 2.4-2: F (L_DE + L_DS) + (1 - F) {background}. With F of 0 or 1 it is eq. 2.4-1's. */
static inline spectrum radiance_from_above(float shape_factor, spectrum sky, spectrum background)
{
    return sky * shape_factor + background * (1.0f - shape_factor);
}

/* eq. 2.4-2: what leaves the target towards the sensor. */
static inline spectrum surface_radiance(spectrum emissivity, spectrum black_body,
                                        spectrum sun_on_target, spectrum from_above)
{
    return emitted_radiance(emissivity, black_body) +
           (sun_on_target + from_above) * (1.0f - emissivity);
}

/* eq. 2.4-2: L tau2 + L_uE + L_uS. */
static inline spectrum sensor_radiance(spectrum surface, spectrum tau2, spectrum path)
{
    return surface * tau2 + path;
}

#endif
