/* Transmission: what transmissive bodies on a ray's way do to radiance. Thesis 2.4.3, eq. 2.4.3-3.
 * Spectra as in spectrum.h. */
#ifndef TRANSMISSION_H
#define TRANSMISSION_H

#include "kernels/records.h"
#include "kernels/spectrum.h"

/* Transmissive materials that a scene can have. */
#define TRANSMISSION_MEDIA 4u

/* The bodies on one way: material by material, in the order of their middles from the origin. */
typedef struct transmission_path {
    float length_m[TRANSMISSION_MEDIA]; /* inside, of all bodies of the material; 0: no further */
    float temperature_k[TRANSMISSION_MEDIA];
    float middle_m[TRANSMISSION_MEDIA];   /* range of the middle of what is inside */
    float vertical_m[TRANSMISSION_MEDIA]; /* straight up through that middle; 0: does not scatter */
    uint medium[TRANSMISSION_MEDIA];      /* row of the extinction */
} transmission_path;
RECORD_SIZE(transmission_path, 80);

/* The ways of a pixel: sensor to target, target to sun, target to background, background to sun. */
#define TRANSMISSION_CAMERA 0u
#define TRANSMISSION_SUN 1u
#define TRANSMISSION_BACKGROUND 2u
#define TRANSMISSION_BACKGROUND_SUN 3u
#define TRANSMISSION_PATHS 4u

/* eq. 2.4.3-3: exp(-beta z) of one material.
 *   extinction   beta, per m */
static inline spectrum transmission_of(spectrum extinction, float length_m)
{
    return exp(extinction * -length_m);
}

/* eq. 2.4-1, as printed for tau2c and T_STE: L tau + [1 - tau] B(T). */
static inline spectrum transmission_through(spectrum radiance, spectrum transmission,
                                            spectrum black_body)
{
    return radiance * transmission + (1.0f - transmission) * black_body;
}

/* eq. 2.4-4: tau1c in the broad band of sunlight, through all bodies on a way.
 *   extinction   per material, per m */
static inline float transmission_broad_band(const float *extinction, const transmission_path *path)
{
    float depth = 0.0f;

    for (uint i = 0; i < TRANSMISSION_MEDIA; i++)
        depth += path->length_m[i] * extinction[path->medium[i]];
    return exp(-depth);
}

#ifdef __OPENCL_C_VERSION__

/* One material's part of a way.
 *   extinction   shape (TRANSMISSION_MEDIA, row_length), per m */
static inline spectrum transmission_part(global const float *extinction, uint row_length,
                                         const transmission_path *path, uint i, uint block)
{
    return transmission_of(spectrum_load(extinction + (size_t)path->medium[i] * row_length, block),
                           path->length_m[i]);
}

/* Transmission of all bodies on a way. */
static inline spectrum transmission_along(global const float *extinction, uint row_length,
                                          const transmission_path *path, uint block)
{
    spectrum out = (spectrum)1.0f;

    for (uint i = 0; i < TRANSMISSION_MEDIA && path->length_m[i] > 0.0f; i++)
        out *= transmission_part(extinction, row_length, path, i, block);
    return out;
}

#endif

#endif
