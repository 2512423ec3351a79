/* Exchange: heat that the facets of a scene give each other, beyond the thesis' facets that know
 * nothing of each other: along sheets of one material (thesis 4.0, item 5), and longwave. */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "scene/scene.h"
#include "sunlight/facet_light.h"
#include "thermal/thermal.h"

/* Lets the facets of a scene exchange heat from the first record of the weather to the last; from
 * then on the model adds what they get wherever it computes one of them or a pixel on it.
 *   sun     on the facets
 *   facet   shape (facet_count), the ground's last: their columns are set
 * What facets send each other follows from temperatures that were computed without it, then with it,
 * until nobody receives 2 W m-2 more or less; what passes along sheets comes last (assumed,
 * docs/departures.md). */
status exchange_run(const scene *s, thermal *model, const ray_scene *rays, const facet_light *sun,
                    facet_record *facet, size_t facet_count);

#endif
