/* Spectrum: SPECTRUM_WIDTH neighbouring samples of a spectrum, handled at once. With width 1 it is
 * a float: the scalar twin, and what the host compiles. */
#ifndef SPECTRUM_H
#define SPECTRUM_H

#include "kernels/constants.h"
#include "kernels/dialect.h"

/* A GPU's work-item has registers for few vectors of 16. */
#if !defined(SPECTRUM_WIDTH) && defined(__OPENCL_C_VERSION__) && RAY_LANES == 16
#define SPECTRUM_WIDTH 16
#elif !defined(SPECTRUM_WIDTH) && defined(__OPENCL_C_VERSION__)
#define SPECTRUM_WIDTH 4
#elif !defined(SPECTRUM_WIDTH)
#define SPECTRUM_WIDTH 1
#endif

#if SPECTRUM_WIDTH == 16

typedef float16 spectrum;

/* Samples SPECTRUM_WIDTH block .. SPECTRUM_WIDTH block + SPECTRUM_WIDTH - 1 of a row. */
static inline spectrum spectrum_load(global const float *row, uint block)
{
    return vload16(block, row);
}

static inline void spectrum_store(spectrum s, global float *row, uint block)
{
    vstore16(s, block, row);
}

static inline float spectrum_sum(spectrum s)
{
    const float8 eight = s.lo + s.hi;
    const float4 four = eight.lo + eight.hi;
    const float2 two = four.lo + four.hi;

    return two.x + two.y;
}

/* Turns 16 spectra of 16 samples into what they have at each sample. Each pass turns the number of
 * a row and its place in it, as 8 bits, by one bit. */
static inline void spectrum_turn(const spectrum *from, spectrum *out)
{
    spectrum next[16];

    UNROLL
    for (int i = 0; i < 16; i++) out[i] = from[i];
    UNROLL
    for (int pass = 0; pass < 4; pass++) {
        UNROLL
        for (int i = 0; i < 8; i++) {
            next[i] = (spectrum)(out[2 * i].even, out[2 * i + 1].even);
            next[i + 8] = (spectrum)(out[2 * i].odd, out[2 * i + 1].odd);
        }
        UNROLL
        for (int i = 0; i < 16; i++) out[i] = next[i];
    }
}

#elif SPECTRUM_WIDTH == 4

typedef float4 spectrum;

static inline spectrum spectrum_load(global const float *row, uint block)
{
    return vload4(block, row);
}

static inline void spectrum_store(spectrum s, global float *row, uint block)
{
    vstore4(s, block, row);
}

#elif SPECTRUM_WIDTH == 1

typedef float spectrum;

#ifdef __OPENCL_C_VERSION__
static inline spectrum spectrum_load(global const float *row, uint block)
{
    return row[block];
}

static inline void spectrum_store(spectrum s, global float *row, uint block)
{
    row[block] = s;
}
#endif

#endif

/* Planck's law, eq. 2.4-5, W m-2 sr-1 um-1.
 *   first    2 h c^2 / l^5, W m-2 sr-1 um-1
 *   second   h c / (k l), K */
static inline spectrum planck_radiance(spectrum first, spectrum second, float temperature_k)
{
    return first / (exp(second / temperature_k) - 1.0f);
}

static inline spectrum spectrum_mix(spectrum a, spectrum b, float share_of_b)
{
    return a + (b - a) * share_of_b;
}

#endif
