#include "kernels/radiance/incident_hemisphere.h"
#include "kernels/radiance/series_tail.h"

/* Keeps what arrives at one of the last depths; at the last, returns what those beyond would bring.
 *   kept   (2, row) */
static inline spectrum keep_or_end(uint keeps, global float *kept, uint row, uint block,
                                   spectrum arrives)
{
    if (keeps == INTERREFLECTION_ADDS_TAIL)
        return series_tail(spectrum_load(kept, block), spectrum_load(kept + row, block), arrives);
    spectrum_store(arrives, keeps == INTERREFLECTION_KEEPS_FIRST ? kept : kept + row, block);
    return (spectrum)0.0f;
}

/* What facets get besides their fraction of the sky: how their lobe takes the sun, and by how much the
 * radiance that reaches them differs from what incident.h closes it with. Exact mode.
 * Launch: (frame.pixel_count); the frame's samples are the means of blocks of samples
 * hit: (pixel_count): which facets these are; NULL: the first ones
 * facet_background: per facet
 * arriving: (pixel_count, 2, sample_count): radiance of sky and of facets that reaches these; NULL: as
 *   closed
 * keeps: INTERREFLECTION_KEEPS_..., what is done with
 * kept: (pixel_count, 2, sample_count): what reached these four and two depths before; NULL: nothing
 * light: (facets, LIGHT_ROWS, sample_count) */
kernel void interreflection(const radiometry_record frame, OPTIONAL global const hit_record *hit,
                            TABLES(SURFACE_TABLES),
                            global const background_record *facet_background,
                            TABLES(SPECTRA_TABLES), OPTIONAL global const float *arriving,
                            const uint keeps, OPTIONAL global float *kept, global float *light)
{
    const uint i = get_global_id(0), row = frame.sample_count;
    if (i >= frame.pixel_count) return;
    const uint facet = hit ? hit[i].facet : i;
    if (facet == RECORD_NONE) return;
    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const spectra_tables spectra = TABLES_GIVEN(SPECTRA_TABLES);
    const facet_record own = surfaces.facets[facet];
    const material_record material = surfaces.materials[own.material];
    const float fraction = facet_background[facet].shape_factor;
    const float facing_sun = fabs(pixel_dot(own.normal, frame.sun));
    const lookup at_sun = lookup_emissivity(material, pixel_angle_deg(facing_sun), 0u);
    global float *to = light + (size_t)facet * LIGHT_ROWS * row;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum black =
            planck_radiance(spectrum_load(spectra.rows + SPECTRA_PLANCK_FIRST * row, block),
                            spectrum_load(spectra.rows + SPECTRA_PLANCK_SECOND * row, block),
                            surfaces.facet_temperature_k[facet]);
        const spectrum sun = spectrum_load(spectra.rows + SPECTRA_SUN * row, block);
        const spectrum sky = spectrum_load(spectra.rows + SPECTRA_SKY * row, block);
        const spectrum closed = radiance_from_above(fraction, sky, black);
        spectrum of_sun = (spectrum)1.0f, more = (spectrum)0.0f;
        if (material.lobe_first != RECORD_NONE)
            of_sun = lobe_diffuse(
                lookup_spectrum(spectra.emissivity, row, at_sun, block),
                spectrum_load(spectra.emissivity + (size_t)material.lobe_first * row, block));
        if (arriving) {
            global const float *from_sky = arriving + (size_t)i * 2u * row;
            more = spectrum_load(from_sky, block) + spectrum_load(from_sky + row, block) - closed;
        }
        if (keeps != INTERREFLECTION_KEEPS_NONE)
            more += keep_or_end(keeps, kept + (size_t)i * 2u * row, row, block, closed + more);
        spectrum_store(of_sun, to + LIGHT_LOBE * row, block);
        spectrum_store(more, to + LIGHT_EXTRA * row, block);
        spectrum_store(closed + more, to + LIGHT_ARRIVING * row, block);
        spectrum_store(sun_on_surface(sun, 1.0f, facing_sun) * of_sun, to + LIGHT_SUN * row, block);
        spectrum_store(black, to + LIGHT_BLACK * row, block);
    }
}
