#define LANES_WIDTH 1
#include "kernels/band_plane.h"
#include "kernels/sensor/band_temperature.h"
#include "kernels/sensor/samples.h"

/* Planes of pixels from those of their samples, per band: means, the apparent temperature of the mean
 * radiance, and the radiance's standard error.
 * Launch: (pixel_count, band count).
 * wants: planes, see band_plane.h; has: those of the samples, with all others of `wants` but the
 *   apparent temperature and the standard error
 * bands: band_record; ln_radiance: shape (band count, BAND_TEMPERATURES)
 * samples: planes of `has`, of pixel_count x sample_count samples
 * planes: those of `wants`, of pixel_count pixels */
kernel void band_mean(const uint pixel_count, const uint sample_count, const uint wants,
                      const uint has, global const band_record *bands,
                      global const float *ln_radiance, global const float *samples,
                      global float *planes)
{
    const uint pixel = get_global_id(0), b = get_global_id(1);
    if (pixel >= pixel_count) return;

    const band_record band = bands[b];
    const size_t row = band_plane_row(pixel_count);
    const size_t sample_row = band_plane_row(pixel_count * sample_count);
    samples += (size_t)b * band_plane_count(has) * sample_row + (size_t)pixel * sample_count;
    planes += (size_t)b * band_plane_count(wants) * row + pixel;
    global const float *radiance = samples + band_plane_place(has, BAND_RADIANCE) * sample_row;
    for (uint k = 0; k < BAND_PLANES; k++) {
        if (!(wants >> k & 1u)) continue;
        if (k == BAND_APPARENT) {
            const float scale = band.is_mean ? band.width_um : 1.0f;
            const float kelvin = band_temperature_find(
                ln_radiance + b * BAND_TEMPERATURES, samples_mean(radiance, sample_count) * scale);
            *planes = kelvin > 0.0f ? kelvin - ZERO_CELSIUS_K : NO_VALUE;
        } else if (k == BAND_STDERR) {
            *planes = samples_standard_error(radiance, sample_count);
        } else {
            *planes = samples_mean(samples + band_plane_place(has, k) * sample_row, sample_count);
        }
        planes += row;
    }
}
