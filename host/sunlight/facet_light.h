/* Facet light: the fraction of a facet that the sun reaches at each step of a day, for what is computed
 * once a facet. */
#ifndef FACET_LIGHT_H
#define FACET_LIGHT_H

#include "mesh/geometry.h"
#include "sunlight/sun_history.h"

/* Shares as lit.h reads them but for the order: a byte for every slot, behind the words of the bits. */
typedef struct facet_light {
    uint32_t bit_words, words, slots;
    size_t count;
    uint32_t *word; /* shape (count, words); NULL and no words: always lit */
} facet_light;

/* What the shares are traced with. */
typedef struct facet_light_world {
    device *dev;
    const geometry *shape;
    const ray_scene *rays;
    const sun_history *sun;
    facet_record_buffer facets;
} facet_light_world;

/* Takes the mean over the points of each facet (facet_sample.h); a facet beyond the geometry, the
 * ground's, is always lit.
 *   out   to be released with facet_light_free */
status facet_light_trace(facet_light *out, const facet_light_world *world, size_t facet_count);
void facet_light_free(facet_light *light);

#endif
