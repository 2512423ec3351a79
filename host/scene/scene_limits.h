/* Scene limits: what the sizes of a scene come to together, checked when all of its tables are read. */
#ifndef SCENE_LIMITS_H
#define SCENE_LIMITS_H

#include "scene/scene.h"

#include "scene/scene_table.h"

/* Fails, at the lines that state them, where pixels, their samples, or what a pixel takes on the device
 * are too many. */
void scene_limits_check(scene_reader *reader);

/* Fails with STATUS_ARGUMENT where a camera has too many pixels, or samples, for the scene. */
status scene_limits_view(const scene *s, const view *camera);

/* Fails with STATUS_FILE where the disk has no room for planes of all the scene's times. A disk that does
 * not tell passes.
 *   folder   need not be there yet */
status scene_limits_disk(const scene *s, size_t plane_count, const char *folder);

#endif
