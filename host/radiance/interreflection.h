/* Interreflection: what facets send each other, so that a facet that is seen sends on what reaches it.
 * Exact mode's counterpart of the two bounces of thesis 2.5.6. */
#ifndef INTERREFLECTION_H
#define INTERREFLECTION_H

#include "mesh/geometry.h"
#include "radiance/incident.h"

typedef struct interreflection interreflection;

/* What wavelength does to facets, in means over blocks of SPECTRUM_WIDTH samples: finer would cost much
 * memory and change little, as it concerns light that is reflected twice. */
typedef struct interreflection_spectra {
    uint32_t sample_count; /* blocks, padded to 16 */
    spectra_tables tables;
} interreflection_spectra;

/* What light meets. */
typedef struct interreflection_scene {
    const incident *incident;
    const ray_scene *scene;
    const hemisphere_grid *grid;
    const geometry *shape;
    surface_tables surfaces;
} interreflection_scene;

/* What is left out of the light between facets, as a fraction, where no depth is stated; and how deep that
 * goes at most. */
#define INTERREFLECTION_REST 0.001
#define INTERREFLECTION_DEPTH 64

/* Samples the hemisphere above the middle of every facet, which tells how much sky it sees and what
 * light it can pass on. What is passed in must outlive it.
 *   reflectance   shape (facet_count + 1): the most that a facet reflects at any wavelength, 0..1, the
 *                 ground's last; read at once
 *   depth         facets that light meets one after the other behind that of a pixel, 1 or more; 0: as
 *                 far as it adds INTERREFLECTION_REST to what any facet of a group sends, bounded by what
 *                 the facets on its way reflect of what they see of each other
 *   sun           unit vector towards it, to begin with */
status interreflection_open(interreflection **out, const interreflection_scene *from,
                            const float *reflectance, uint32_t depth,
                            const interreflection_spectra *spectra, const float *sun);
void interreflection_free(interreflection *f);

/* Passes light on between facets, once per depth, for the sun of a frame; nothing happens where it
 * stands where it stood. What else reaches the last facet than sun and its fraction of the sky is that of
 * a black body at its temperature. */
status interreflection_set_sun(interreflection *f, const radiometry_record *frame);

/* What facets see, and the light between them; both change with the sun. */
light_tables interreflection_light(const interreflection *f);

#endif
