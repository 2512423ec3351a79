#include "kernels/sensor/band_temperature.h"

/* Radiance in band of a black body at every temperature of the table, as its logarithm: the largest
 * term of the sum is taken out, so that nothing underflows.
 * Launch: (BAND_TEMPERATURES / LANES_WIDTH, band_count).
 * spectra: shape (rows, sample_count), SPECTRA_...; bands: band_record; weights: of its samples, um
 * ln_radiance: shape (band_count, BAND_TEMPERATURES), ln of W m-2 sr-1 */
kernel void band_temperature(const uint sample_count, global const float *spectra,
                             global const band_record *bands, global const float *weights,
                             global float *ln_radiance)
{
    const uint first_row = get_global_id(0) * LANES_WIDTH, b = get_global_id(1);
    if (first_row >= BAND_TEMPERATURES) return;

    const band_record band = bands[b];
    global const float *weight = weights + band.first_weight;
    global const float *first = spectra + SPECTRA_PLANCK_FIRST * sample_count + band.first_sample;
    global const float *second = spectra + SPECTRA_PLANCK_SECOND * sample_count + band.first_sample;
    lanes index, largest = (lanes)-INFINITY, sum = (lanes)0.0f;

    for (uint i = 0; i < LANES_WIDTH; i++) LANES_SET(index, i, (float)(first_row + i));
    const lanes temperature_k = band_temperature_at(index);
    for (uint pass = 0; pass < 2u; pass++)
        for (uint i = 0; i < band.sample_count; i++) {
            const lanes x = second[i] / temperature_k;
            const lanes term = log(weight[i] * first[i]) - x - log1p(-exp(-x));
            if (pass == 0u)
                largest = fmax(largest, term);
            else
                sum += exp(term - largest);
        }
    lanes_store(largest + log(sum), ln_radiance + (size_t)b * BAND_TEMPERATURES, first_row,
                BAND_TEMPERATURES);
}
