/* Shared scene: a scene that several pictures and the render hold; the last one frees it. */
#ifndef SHARED_SCENE_H
#define SHARED_SCENE_H

#include "scene/scene.h"

#include <stdatomic.h>

typedef struct shared_scene {
    scene *s;
    atomic_int holders;
} shared_scene;

/* Reads a scene as scene_read does; the caller holds it. */
status shared_scene_read(shared_scene **out, const char *path, const char *const *setting,
                         size_t setting_count);

/* Returns it, held once more. */
shared_scene *shared_scene_hold(shared_scene *shared);

/* Any thread may drop what it holds. NULL is allowed. */
void shared_scene_drop(shared_scene *shared);

#endif
