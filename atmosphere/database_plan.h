/* Database plan: the parts of scene.toml that a radiance database is made from. */
#ifndef DATABASE_PLAN_H
#define DATABASE_PLAN_H

#include "scene/atmosphere_plan.h"

typedef struct database_plan {
    scene *s; /* its place and history, the name and what belongs to the plan */
    atmosphere_plan plan;
} database_plan;

/* Reads name, [site], [camera], [atmosphere.generate], and [weather] where the plan needs it; the
 * rest of the scene is not looked at. Fails with a line for each mistake. */
status database_plan_read(database_plan **out, const char *path);
void database_plan_free(database_plan *g);

#endif
