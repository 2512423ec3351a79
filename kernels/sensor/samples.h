/* Samples: what the samples of one pixel come to (device only). */
#ifndef SAMPLES_H
#define SAMPLES_H

#include "kernels/dialect.h"
#include "kernels/records.h"

#ifdef __OPENCL_C_VERSION__

/* Mean of those that have a value; NO_VALUE where none has. */
static inline float samples_mean(global const float *value, uint count)
{
    float first = NO_VALUE, sum = 0.0f;
    uint used = 0;

    for (uint i = 0; i < count; i++) {
        if (value[i] == NO_VALUE) continue;
        first = used == 0u ? value[i] : first;
        sum += value[i] - first;
        used++;
    }
    return used == 0u ? NO_VALUE : first + sum / (float)used;
}

/* The commonest value, NO_VALUE as good as any other; of equally common ones the lowest. */
static inline float samples_mode(global const float *value, uint count)
{
    float mode = value[0];
    uint most = 0;

    for (uint i = 0; i < count; i++) {
        uint equal = 0;
        for (uint k = 0; k < count; k++) equal += value[k] == value[i] ? 1u : 0u;
        if (equal < most || (equal == most && value[i] >= mode)) continue;
        most = equal;
        mode = value[i];
    }
    return mode;
}

/* Standard error of the mean of values that all count: their standard deviation (count - 1) over the
 * root of their number. Strata make it smaller than that: it is a bound from above. */
static inline float samples_standard_error(global const float *value, uint count)
{
    const float mean = samples_mean(value, count);
    float sum = 0.0f;

    for (uint i = 0; i < count; i++) sum += (value[i] - mean) * (value[i] - mean);
    return sqrt(sum / (float)(count - 1u) / (float)count);
}

#endif

#endif
