#include "kernels/lookup.h"
#include "kernels/media/cloud.h"
#include "kernels/radiance/radiometry.h"

/* Radiance that clouds see below them: the endless plane in the sun under an open sky; without one
 * the sky's, which then goes all round.
 * Launch: (frame.sample_count), whole spectra a work-item.
 * facets, temperature_k: per facet, the ground's among them; materials: material_record
 * spectra: SPECTRA_...; emissivity: shape (rows, sample_count)
 * extinction: see CLOUD_...; the row CLOUD_GROUND is written, W m-2 sr-1 um-1 */
kernel void cloud_ground(const radiometry_record frame, const world_record world,
                         global const facet_record *facets, global const material_record *materials,
                         global const float *temperature_k, global const float *spectra,
                         global const float *emissivity, global float *extinction)
{
    const uint block = get_global_id(0), row = frame.sample_count;
    if (block >= row / SPECTRUM_WIDTH) return;
    const spectrum sky = spectrum_load(spectra + SPECTRA_SKY * row, block);
    spectrum out = sky;

    if (world.ground_facet != RECORD_NONE) {
        const material_record material = materials[facets[world.ground_facet].material];
        const spectrum e =
            lookup_spectrum(emissivity, row, lookup_emissivity(material, 0.0f, 0u), block);
        const spectrum black_body =
            planck_radiance(spectrum_load(spectra + SPECTRA_PLANCK_FIRST * row, block),
                            spectrum_load(spectra + SPECTRA_PLANCK_SECOND * row, block),
                            temperature_k[world.ground_facet]);
        const spectrum sun =
            sun_on_surface(spectrum_load(spectra + SPECTRA_SUN * row, block), 1.0f, frame.sun[2]);
        out = surface_radiance(e, black_body, sun, sky);
    }
    spectrum_store(out, extinction + (size_t)CLOUD_GROUND * row, block);
}
