/* Band temperature: the black body whose radiance in a band is a given one, from a table of ln L over
 * temperature (BAND_TEMPERATURES of records.h). */
#ifndef BAND_TEMPERATURE_H
#define BAND_TEMPERATURE_H

#include "constants.h"
#include "records.h"

/* Temperature of a row of the table, K. */
static inline float band_temperature_at(uint index)
{
    const float ln_step = log(BAND_HIGHEST_K / BAND_LOWEST_K) / (float)(BAND_TEMPERATURES - 1u);

    return BAND_LOWEST_K * exp((float)index * ln_step);
}

#ifdef __OPENCL_C_VERSION__

/* Returns K, or -1 where the radiance is not between those of the table's ends. Linear in 1/T
 * between rows, where ln L nearly is: within .001 K for bands up to 8 to 14 um at 300 K.
 *   ln_radiance   shape (BAND_TEMPERATURES) */
static inline float band_temperature_find(global const float *ln_radiance, float radiance)
{
    const float target = log(radiance);
    uint low = 0u, high = BAND_TEMPERATURES - 1u;

    if (!(target >= ln_radiance[low] && target <= ln_radiance[high])) return -1.0f;
    while (high - low > 1u) {
        const uint middle = (low + high) / 2u;
        if (ln_radiance[middle] <= target)
            low = middle;
        else
            high = middle;
    }
    const float share = (target - ln_radiance[low]) / (ln_radiance[high] - ln_radiance[low]);
    const float from = 1.0f / band_temperature_at(low), to = 1.0f / band_temperature_at(high);
    return 1.0f / (from + share * (to - from));
}

#endif

#endif
