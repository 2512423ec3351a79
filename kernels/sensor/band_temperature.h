/* Band temperature: the black body whose radiance in a band is a given one, from a table of ln L over
 * temperature (BAND_TEMPERATURES of records.h). */
#ifndef BAND_TEMPERATURE_H
#define BAND_TEMPERATURE_H

#include "kernels/constants.h"
#include "kernels/lanes.h"
#include "kernels/records.h"

/* Temperature of a row of the table, K. */
static inline lanes band_temperature_at(lanes index)
{
    const float ln_step = log(BAND_HIGHEST_K / BAND_LOWEST_K) / (float)(BAND_TEMPERATURES - 1u);

    return BAND_LOWEST_K * exp(index * ln_step);
}

#ifdef __OPENCL_C_VERSION__

/* The last row but one that does not exceed a value.
 *   ln_radiance   shape (BAND_TEMPERATURES) */
static inline lanes_bits band_temperature_row(global const float *ln_radiance, lanes ln_value)
{
    lanes_bits row = 0u;

    for (uint step = BAND_TEMPERATURES / 2u; step > 0u; step /= 2u) {
        const lanes_bits next = min(row + step, (lanes_bits)(BAND_TEMPERATURES - 2u));
        row = lanes_gather(ln_radiance, next) <= ln_value ? next : row;
    }
    return row;
}

/* Returns K, or -1 where the radiance is not between those of the table's ends. Linear in 1/T
 * between rows, where ln L nearly is: within 0.001 K for bands up to 8 to 14 um at 300 K.
 *   ln_radiance   shape (BAND_TEMPERATURES) */
static inline lanes band_temperature_find(global const float *ln_radiance, lanes radiance)
{
    const lanes target = log(radiance);
    const lanes_bits row = band_temperature_row(ln_radiance, target);
    const lanes low = lanes_gather(ln_radiance, row), high = lanes_gather(ln_radiance, row + 1u);
    const lanes fraction = (target - low) / (high - low), index = lanes_of_bits(row);
    const lanes from = 1.0f / band_temperature_at(index);
    const lanes to = 1.0f / band_temperature_at(index + 1.0f);
    const lanes_mask is_within =
        (target >= ln_radiance[0]) & (target <= ln_radiance[BAND_TEMPERATURES - 1u]);

    return is_within ? 1.0f / (from + fraction * (to - from)) : (lanes)-1.0f;
}

#endif

#endif
