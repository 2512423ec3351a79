#include "band_temperature.h"
#include "pixel.h"
#include "radiometry.h"

/* What the spectra of all pixels are read from. */
typedef struct spectra_tables {
    global const float *rows;       /* shape (rows, sample_count): SPECTRA_... of records.h */
    global const float *emissivity; /* shape (rows, sample_count) */
    global const float *incident;   /* of this pixel: shape (sample_count); NULL: thesis mode */
} spectra_tables;

static spectrum load_row(spectra_tables tables, radiometry_record frame, uint row, uint block)
{
    return spectrum_load(tables.rows + (size_t)row * frame.sample_count, block);
}

static global const float *sky_rows(spectra_tables tables, radiometry_record frame)
{
    return tables.rows + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * frame.sample_count;
}

/* Radiance at the sensor of one block of samples; adds to the emissivity sums. */
static spectrum block_radiance(const pixel_state *pixel, spectra_tables tables,
                               radiometry_record frame, uint block, spectrum weight,
                               spectrum *emissivity_sum, spectrum *background_sum)
{
    if (pixel->interaction == INTERACTION_MISSED)
        return sky_radiance(sky_rows(tables, frame), frame, pixel->sky, block);

    const uint row = frame.sample_count;
    const spectrum first = load_row(tables, frame, SPECTRA_PLANCK_FIRST, block);
    const spectrum second = load_row(tables, frame, SPECTRA_PLANCK_SECOND, block);
    const spectrum sun = load_row(tables, frame, SPECTRA_SUN, block);
    const spectrum emissivity = lookup_spectrum(tables.emissivity, row, pixel->emissivity, block);
    spectrum sky = (spectrum)0.0f, background = (spectrum)0.0f;

    *emissivity_sum += weight * emissivity;
    if (pixel->shape_factor > 0.0f && !tables.incident)
        sky = pixel->interaction == INTERACTION_DIFFUSE
                  ? load_row(tables, frame, SPECTRA_SKY, block)
                  : sky_radiance(sky_rows(tables, frame), frame, pixel->sky, block);
    if (pixel->background_temperature_k > 0.0f) {
        const spectrum e =
            lookup_spectrum(tables.emissivity, row, pixel->background_emissivity, block);
        *background_sum += weight * e;
        background = background_radiance(
            e, planck_radiance(first, second, pixel->background_temperature_k),
            sun_on_surface(sun, pixel->background_sunlit, pixel->background_sun_cosine));
    }
    const spectrum surface = surface_radiance(
        emissivity, planck_radiance(first, second, pixel->temperature_k),
        sun_on_surface(sun, pixel->sunlit, pixel->sun_cosine),
        tables.incident ? spectrum_load(tables.incident, block)
                        : radiance_from_above(pixel->shape_factor, sky, background));
    global const float *paths = tables.rows + (size_t)SPECTRA_PATHS * row;
    return sensor_radiance(
        surface, lookup_spectrum(paths, row, pixel->path, block),
        lookup_spectrum(paths + (size_t)frame.path_count * row, row, pixel->path, block));
}

static pixel_state pixel_look(radiometry_record frame, camera_record camera, uint pixel,
                              hit_record hit, background_record background, float sunlit,
                              float background_sunlit, global const facet_record *facets,
                              global const material_record *materials, float temperature_k)
{
    pixel_state state = {0};
    float ray[3];

    pixel_ray(camera, frame.columns, frame.first_pixel + pixel, ray);
    if (hit.facet == RECORD_NONE) {
        state.sky = sky_find(frame, ray[0], ray[1], ray[2]);
        return state;
    }
    state.temperature_k = temperature_k;
    state.sunlit = sunlit;
    state.shape_factor = background.shape_factor;
    const material_record material = materials[facets[hit.facet].material];
    state.interaction = pixel_interaction(material, background);
    pixel_set_target(&state, frame, hit, material, ray);
    if (background.facet != RECORD_NONE)
        pixel_set_background(&state, frame, materials[background.material], background, hit.point,
                             background_sunlit);
    return state;
}

/* Radiance at the sensor, eq. 2.4-2 and 2.4-3, and what goes with it, per band.
 * Launch: (frame.pixel_count).
 * facets: per facet, the ground's behind the real ones; materials: material_record
 * temperature_k, hit, background, sunlit, background_sunlit: per pixel
 * spectra: shape (rows, sample_count), see SPECTRA_...; emissivity: shape (rows, sample_count)
 * incident: shape (pixel_count, sample_count), see incident.cl; NULL in thesis mode, which takes
 *   the mean background instead
 * bands: band_record; ln_radiance: shape (band_count, BAND_TEMPERATURES)
 * planes: shape (band_count, BAND_PLANES, pixel_count): radiance W m-2 sr-1 (or its mean per um),
 *   counts, apparent temperature C, emissivity, background emissivity; NO_VALUE where there is none */
kernel void radiometry(const radiometry_record frame, const camera_record camera,
                       global const facet_record *facets, global const material_record *materials,
                       global const float *temperature_k, global const hit_record *hit,
                       global const background_record *background, global const float *sunlit,
                       global const float *background_sunlit, global const float *spectra,
                       global const float *emissivity, global const float *incident,
                       global const band_record *bands, global const float *ln_radiance,
                       global float *planes)
{
    const uint pixel = get_global_id(0);
    if (pixel >= frame.pixel_count) return;

    const spectra_tables tables = {
        spectra, emissivity, frame.thesis ? 0 : incident + (size_t)pixel * frame.sample_count};
    const pixel_state state =
        pixel_look(frame, camera, pixel, hit[pixel], background[pixel], sunlit[pixel],
                   background_sunlit[pixel], facets, materials, temperature_k[pixel]);
    for (uint b = 0; b < frame.band_count; b++) {
        const band_record band = bands[b];
        spectrum radiance_sum = (spectrum)0.0f, emissivity_sum = (spectrum)0.0f;
        spectrum background_sum = (spectrum)0.0f;

        for (uint k = 0; k < band.sample_count / SPECTRUM_WIDTH; k++) {
            const uint block = band.first_sample / SPECTRUM_WIDTH + k;
            const spectrum weight = load_row(tables, frame, SPECTRA_WEIGHT, block);
            radiance_sum += weight * block_radiance(&state, tables, frame, block, weight,
                                                    &emissivity_sum, &background_sum);
        }
        const float radiance = spectrum_sum(radiance_sum);
        const float apparent_k =
            band_temperature_find(ln_radiance + b * BAND_TEMPERATURES, radiance);
        global float *out = planes + (size_t)b * BAND_PLANES * frame.pixel_count + pixel;
        out[0] = band.is_mean ? radiance / band.width_um : radiance;
        out[frame.pixel_count] = band.gain * radiance + band.offset;
        out[2u * frame.pixel_count] = apparent_k > 0.0f ? apparent_k - ZERO_CELSIUS_K : NO_VALUE;
        out[3u * frame.pixel_count] = state.interaction == INTERACTION_MISSED
                                          ? NO_VALUE
                                          : spectrum_sum(emissivity_sum) / band.width_um;
        out[4u * frame.pixel_count] = state.background_temperature_k > 0.0f
                                          ? spectrum_sum(background_sum) / band.width_um
                                          : NO_VALUE;
    }
}
