/* File stamp: what tells whether the file of a path is still the one that it was. */
#ifndef FILE_STAMP_H
#define FILE_STAMP_H

#include <stdint.h>

typedef struct file_stamp {
    int64_t size, changed_s, changed_ns, number; /* size -1: there is no such file */
} file_stamp;

file_stamp file_stamp_of(const char *path);

#endif
