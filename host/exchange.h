/* Exchange: heat that the facets of a scene give each other, beyond the thesis' facets that know
 * nothing of each other: along sheets of one material (thesis 4.0, item 5). */
#ifndef EXCHANGE_H
#define EXCHANGE_H

#include "ray_scene.h"
#include "scene.h"
#include "sun_history.h"
#include "thermal.h"

/* Whether and by what the facets of a scene are lit through the day. */
typedef struct exchange_light {
    const ray_scene *rays;
    const sun_history *sun;
    device_memory facets; /* facet_record, on the device */
} exchange_light;

/* Lets the facets of a scene exchange heat from the first record of the weather to the last; from
 * then on the model adds what they get wherever it computes one of them or a pixel on it.
 *   light   NULL: in the sun whenever it shines
 *   facet   shape (the scene's facets): their columns are set */
status exchange_run(device *dev, const scene *s, thermal *model, const exchange_light *light,
                    facet_record *facet);

#endif
