#include "kernels/lookup.h"
#include "kernels/media/cloud.h"
#include "kernels/radiance/radiometry.h"

/* Radiance that clouds see below them: the endless plane in the sun under an open sky; without one
 * the sky's, which then goes all round.
 * Launch: (frame.sample_count), whole spectra a work-item.
 * out_extinction: see CLOUD_...; the row CLOUD_GROUND is written, W m-2 sr-1 um-1 */
kernel void cloud_ground(const radiometry_record frame, const world_record world,
                         TABLES(SURFACE_TABLES), TABLES(SPECTRA_TABLES),
                         global float *out_extinction)
{
    const uint block = get_global_id(0), row = frame.sample_count;
    if (block >= row / SPECTRUM_WIDTH) return;
    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const spectra_tables spectra = TABLES_GIVEN(SPECTRA_TABLES);
    const spectrum sky = spectrum_load(spectra.rows + SPECTRA_SKY * row, block);
    spectrum out = sky;

    if (world.ground_facet != RECORD_NONE) {
        const material_record material =
            surfaces.materials[surfaces.facets[world.ground_facet].material];
        const spectrum e =
            lookup_spectrum(spectra.emissivity, row, lookup_emissivity(material, 0.0f, 0u), block);
        const spectrum black_body =
            planck_radiance(spectrum_load(spectra.rows + SPECTRA_PLANCK_FIRST * row, block),
                            spectrum_load(spectra.rows + SPECTRA_PLANCK_SECOND * row, block),
                            surfaces.facet_temperature_k[world.ground_facet]);
        const spectrum sun = sun_on_surface(spectrum_load(spectra.rows + SPECTRA_SUN * row, block),
                                            1.0f, frame.sun[2]);
        out = surface_radiance(e, black_body, sun, sky);
    }
    spectrum_store(out, out_extinction + (size_t)CLOUD_GROUND * row, block);
}
