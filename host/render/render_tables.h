/* Render tables: what the pixels of a scene read on the device: facets, materials, spectra. */
#ifndef RENDER_TABLES_H
#define RENDER_TABLES_H

#include "device/device.h"
#include "radiance/interreflection.h"
#include "radiance/spectra.h"
#include "radiance/spectral_grid.h"
#include "rays/media.h"
#include "scene/scene.h"

/* Starts zeroed; render_tables_free is then safe at any time. */
typedef struct render_tables {
    size_t facet_count;  /* with the ground's */
    facet_record *facet; /* shape (facet_count) */
    facet_record_buffer facets;
    uint_buffer facet_ids;
    material_record_buffer materials;
    spectra *bands;
    spectra_tables spectra;
    band_record_buffer band_records;
    float_buffer band_weights, band_emissivity, ln_radiance;
    /* Exact mode: the same at knots, where not all samples are; and over blocks of knots, as
     * interreflection.h takes them. */
    spectral_grid *knots;
    spectra_tables knot_spectra;
    interreflection_spectra blocks;
    float *reflectance; /* shape (facet_count): the most at any wavelength */
} render_tables;

/* Takes the facets, the ground's last, and the materials to the device. */
status render_tables_take_facets(render_tables *t, device *dev, const scene *s);

/* Samples all that depends on wavelength over the bands and takes it to the device.
 *   through   transmissive bodies; NULL: none */
status render_tables_take_spectra(render_tables *t, device *dev, const scene *s,
                                  const media *through);

/* Samples blocks and reflectance; after the facets and the spectra. */
status render_tables_take_blocks(render_tables *t, device *dev, const scene *s);

/* Releases what the tables hold, not the record. */
void render_tables_free(render_tables *t);

#endif
