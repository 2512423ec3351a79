/* Uniform atmosphere: a sky that is the same in every direction and a clear path, stated by a few
 * numbers instead of a radiance database. */
#ifndef UNIFORM_ATMOSPHERE_H
#define UNIFORM_ATMOSPHERE_H

#include "sky/atmosphere.h"

#include <stdbool.h>

typedef struct uniform_sky {
    double sky_temperature_k;       /* the sky is B of this ... */
    double sky_radiance_w_m2_sr_um; /* ... and this */
    double sun_irradiance_w_m2_um;  /* at the ground, normal to the beam */
    double transmission;            /* of the path to the sensor */
    double path_temperature_k;      /* the path radiates (1 - transmission) B of this */
} uniform_sky;

/* Makes the database that such a sky would have, on an even grid from low_um to high_um, of 2 cm-1
 * or, where it ends below 3 um, of planck_step_cm1 there,, with
 * one path angle and one direction of the sky.
 *   thesis   Planck's law with the thesis' constants */
status uniform_atmosphere_make(atmosphere **out, const uniform_sky *sky, double low_um,
                               double high_um, bool thesis);

#endif
