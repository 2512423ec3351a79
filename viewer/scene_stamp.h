/* Scene stamp: tells whether one of the files that a scene was read from has changed. */
#ifndef SCENE_STAMP_H
#define SCENE_STAMP_H

#include "scene/scene.h"

typedef struct scene_stamp {
    uint64_t hash; /* of the files' stamps */
} scene_stamp;

/* Of the files before they were opened: an edit while the scene was read makes another stamp. */
scene_stamp scene_stamp_read(const scene *s);

/* Of the files as they are now. */
scene_stamp scene_stamp_now(const scene *s);

static inline bool scene_stamp_equal(scene_stamp a, scene_stamp b)
{
    return a.hash == b.hash;
}

#endif
