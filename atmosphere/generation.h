/* Generation: the parts of scene.toml that a radiance database is made from. */
#ifndef GENERATION_H
#define GENERATION_H

#include "atmosphere_plan.h"

typedef struct generation {
    scene *s; /* its place and history, the name and what belongs to the plan */
    atmosphere_plan plan;
} generation;

/* Reads name, [site], [camera], [atmosphere.generate], and [weather] where the plan needs it; the
 * rest of the scene is not looked at. Fails with a line for each mistake. */
status generation_read(generation **out, const char *path);
void generation_free(generation *g);

#endif
