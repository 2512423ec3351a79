#include "band_temperature.h"
#include "samples.h"

/* Planes of pixels from those of their samples, per band: means, the apparent temperature of the mean
 * radiance, and the radiance's standard error.
 * Launch: (pixel_count, band count).
 * bands: band_record; ln_radiance: shape (band count, BAND_TEMPERATURES)
 * samples: shape (band count, BAND_PLANES, pixel_count, sample_count), as radiometry.cl writes it
 * planes: shape (band count, BAND_PLANES, pixel_count) */
kernel void band_mean(const uint pixel_count, const uint sample_count, const uint wants_parts,
                      global const band_record *bands, global const float *ln_radiance,
                      global const float *samples, global float *planes)
{
    const uint pixel = get_global_id(0), b = get_global_id(1);
    if (pixel >= pixel_count) return;

    const band_record band = bands[b];
    const size_t first = (size_t)b * BAND_PLANES * pixel_count + pixel;
    const uint end = wants_parts ? BAND_PARTS + RADIANCE_PARTS : BAND_PARTS;
    for (uint k = 0; k < end; k++) {
        const size_t at = first + (size_t)k * pixel_count;
        planes[at] = samples_mean(samples + at * sample_count, sample_count);
    }
    const float radiance = planes[first] * (band.is_mean ? band.width_um : 1.0f);
    const float apparent_k = band_temperature_find(ln_radiance + b * BAND_TEMPERATURES, radiance);
    planes[first + 2u * pixel_count] = apparent_k > 0.0f ? apparent_k - ZERO_CELSIUS_K : NO_VALUE;
    planes[first + BAND_STDERR * (size_t)pixel_count] =
        samples_standard_error(samples + first * sample_count, sample_count);
}
