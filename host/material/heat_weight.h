/* Heat weight: the one number that heat exchange takes from a spectrum: what is absorbed of sunlight, what is
 * emitted near 300 K. */
#ifndef HEAT_WEIGHT_H
#define HEAT_WEIGHT_H

#include "material/emissivity.h"

/* The most that may be missing of a weight: what lies between is smaller than what measurements are. */
#define HEAT_WEIGHT_MISSING 0.03

typedef struct heat_mean {
    double value;          /* 0..1 */
    double measured_share; /* of the weight, where there are measurements */
    double
        missing_share; /* of it, where nothing is known: wavelength_grid_covers, and no number stands for it */
} heat_mean;

/* The normal emissivity weighted by the global sunlight of ASTM G173, 0.28 to 4 um: the mean over a hundred
 * ranges of equal power, as ASTM E903 has it. */
heat_mean heat_weight_sun(const emissivity *e);

/* The hemispherical emissivity weighted by a black body of 300 K. */
heat_mean heat_weight_300k(const emissivity *e);

#endif
