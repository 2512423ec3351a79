/* Facet check: whether facets can have the temperatures that were computed. */
#ifndef FACET_CHECK_H
#define FACET_CHECK_H

#include "scene/scene.h"

/* Fails with STATUS_ARGUMENT and the facet's name where no surface can have its temperature (value_check.h);
 * those that no pixel shows count too, those without area do not. Warns, with the first one's name, of facets
 * that generated or stated power takes 60 K below the coldest air, or above 2000 K, as no surface is but by
 * machines: such power is mostly stated in W where W/m2 is meant, or with the wrong sign.
 *   facet, facet_k   shape (count): the scene's, the ground's last */
status facet_check(const scene *s, const facet_record *facet, size_t count, const float *facet_k);

#endif
