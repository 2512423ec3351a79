#include "kernels/records.h"

/* Mean emissivities over the bands.
 * Launch: (band_count, row count).
 * bands: band_record; weights: of each its samples', um
 * emissivity: shape (rows, sample_count)
 * band_emissivity: shape (rows, band_count) */
kernel void band_emissivity(const uint sample_count, const uint band_count,
                            global const band_record *bands, global const float *weights,
                            global const float *emissivity, global float *band_emissivity)
{
    const uint b = get_global_id(0), row = get_global_id(1);
    if (b >= band_count) return;

    const band_record band = bands[b];
    global const float *weight = weights + band.first_weight;
    global const float *sample = emissivity + (size_t)row * sample_count + band.first_sample;
    float sum = 0.0f;

    for (uint first = 0; first < band.sample_count; first += SPECTRA_BLOCK) {
        const uint end = min(first + SPECTRA_BLOCK, band.sample_count);
        float some = 0.0f;
        for (uint i = first; i < end; i++) some += weight[i] * sample[i];
        sum += some;
    }
    band_emissivity[(size_t)row * band_count + b] = sum / band.width_um;
}
