/* File stamp: tells whether one of the files that a scene was read from has changed. */
#ifndef FILE_STAMP_H
#define FILE_STAMP_H

#include "scene/scene.h"

typedef struct file_stamp {
    uint64_t hash; /* of names, sizes and times of change */
} file_stamp;

file_stamp file_stamp_of(const scene *s);

static inline bool file_stamp_equal(file_stamp a, file_stamp b)
{
    return a.hash == b.hash;
}

#endif
