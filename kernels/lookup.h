/* Lookup: where a value lies between the rows of a regular table, and spectra between rows. */
#ifndef LOOKUP_H
#define LOOKUP_H

#include "kernels/records.h"
#include "kernels/spectrum.h"

/* Between row `low` and the next: share of the next, 0..1. */
typedef struct lookup {
    uint low, high;
    float fraction;
} lookup;

/* Finds a value in a table of `count` rows from `first` by `step`; outside, the nearest row. */
static inline lookup lookup_regular(float value, float first, float step, uint count)
{
    lookup at = {0u, 0u, 0.0f};

    if (count < 2u || !(value > first)) return at;
    const float position = (value - first) / step;
    if (position >= (float)(count - 1u)) {
        at.low = at.high = count - 1u;
        return at;
    }
    at.low = (uint)position;
    at.high = at.low + 1u;
    at.fraction = position - (float)at.low;
    return at;
}

/* Finds an angle in degrees among the rows of a material's emissivity.
 *   nearest   1: the nearest degree, as the thesis does */
static inline lookup lookup_emissivity(material_record material, float angle_deg, uint nearest)
{
    lookup at = lookup_regular(angle_deg, 0.0f, 1.0f, material.emissivity_angles);

    if (nearest) {
        at.low = at.fraction < 0.5f ? at.low : at.high;
        at.high = at.low;
        at.fraction = 0.0f;
    }
    at.low += material.emissivity_first;
    at.high += material.emissivity_first;
    return at;
}

#ifdef __OPENCL_C_VERSION__

/* Samples of block `block` between two rows of a table with row_length floats a row. */
static inline spectrum lookup_spectrum(global const float *table, uint row_length, lookup at,
                                       uint block)
{
    const spectrum low = spectrum_load(table + (size_t)at.low * row_length, block);

    if (at.fraction == 0.0f) return low;
    return spectrum_mix(low, spectrum_load(table + (size_t)at.high * row_length, block),
                        at.fraction);
}

#endif

#endif
