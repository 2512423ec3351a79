#include "shared_scene.h"

#include <stdlib.h>

status shared_scene_read(shared_scene **out, const char *path, const char *const *setting,
                         size_t setting_count)
{
    status rc = STATUS_OK;
    shared_scene *shared = calloc(1, sizeof *shared);

    NEED(shared, STATUS_MEMORY, "%s: no memory to read it", path);
    atomic_init(&shared->holders, 1);
    TRY(scene_read(&shared->s, path, setting, setting_count));
    *out = shared;
    shared = NULL;
out:
    free(shared);
    return rc;
}

shared_scene *shared_scene_hold(shared_scene *shared)
{
    atomic_fetch_add(&shared->holders, 1);
    return shared;
}

void shared_scene_drop(shared_scene *shared)
{
    if (!shared || atomic_fetch_sub(&shared->holders, 1) != 1) return;
    scene_free(shared->s);
    free(shared);
}
