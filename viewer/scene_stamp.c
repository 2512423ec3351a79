#include "scene_stamp.h"

#include <xxhash.h>

static void add(scene_stamp *to, file_stamp of)
{
    to->hash = XXH3_64bits_withSeed(&of, sizeof of, to->hash);
}

scene_stamp scene_stamp_read(const scene *s)
{
    scene_stamp stamp = {0};

    for (size_t i = 0; i < s->input_count; i++) add(&stamp, s->inputs[i].stamp);
    return stamp;
}

scene_stamp scene_stamp_now(const scene *s)
{
    scene_stamp stamp = {0};

    for (size_t i = 0; i < s->input_count; i++) add(&stamp, file_stamp_of(s->inputs[i].path));
    return stamp;
}
