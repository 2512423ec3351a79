/* Incident: the radiance that reaches every pixel's surface, ray by ray: the exact mode's
 * counterpart of the mean background of eq. 2.4-1 and 2.4-2. */
#ifndef HOST_INCIDENT_H
#define HOST_INCIDENT_H

#include "hemisphere/shape_factor.h"
#include "rays/media.h"

#include <stdbool.h>

typedef struct incident incident;

/* Lays points of a quadrature over the table of the sky.
 *   lobe_rings   of the materials' diffuse lobes (lobe.h)
 *   frame        zenith and azimuth of the sky's table are read
 * Fails with STATUS_ARGUMENT where the table has more than INCIDENT_WEIGHTS / lobe_rings directions. What is
 * passed in must outlive it. */
status incident_open(incident **out, const ray_scene *scene, const hemisphere_grid *grid,
                     const surface_tables *surfaces, uint32_t lobe_rings,
                     const radiometry_record *frame);
void incident_free(incident *in);

/* What a tile of pixels brings along; shapes as in kernels/radiance/incident.cl. */
typedef struct incident_pixels {
    radiometry_record frame;
    camera_record camera;
    shape_factor_points points;
    background_record_buffer background; /* NULL: the surfaces are facets', taken as diffuse */
    float_buffer background_lit;
    light_tables light;
    uint32_t light_length;
    bool keeps_sky;    /* of facets: out holds the sky's part from before */
    uint_buffer gloss; /* see gloss.cl; NULL: nothing is rough */
    spectra_tables spectra;
    const media *media; /* NULL: none */
} incident_pixels;

/* Computes the radiance.
 *   out   shape (pixel_count, 2, sample_count): of the sky, of facets and ground */
status incident_compute(const incident *in, const incident_pixels *pixels, float_buffer out);

#endif
