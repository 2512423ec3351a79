#include "kernels/thermal/thermal.h"

/* Longwave that reaches facets from the sky, from each other, and from what is neither: black, at air
 * temperature.
 * Launch: (column_count, steps). view: (column_count); seen, share: facets and their shares of the
 * views; forcing: (steps); sent_w_m2: (steps, facet_count), of radiosity.cl;
 * received_w_m2: (steps, column_count). */
kernel void irradiation(const uint column_count, const uint facet_count,
                        global const view_record *view, global const uint *seen,
                        global const float *fraction, global const forcing_record *forcing,
                        global const float *sent_w_m2, global float *received_w_m2)
{
    const uint i = get_global_id(0), step = get_global_id(1);
    if (i >= column_count) return;
    const view_record v = view[i];
    global const float *sent = sent_w_m2 + (size_t)step * facet_count;
    float sum = v.sky * forcing[step].sky_longwave_w_m2 +
                v.below * thermal_black_w_m2(forcing[step].air_temperature_k);

    for (uint k = v.first; k < v.first + v.count; k++) sum += fraction[k] * sent[seen[k]];
    received_w_m2[(size_t)step * column_count + i] = sum;
}
