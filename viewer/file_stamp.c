#include "file_stamp.h"

#include <sys/stat.h>

/* FNV-1a, 64 bits. */
static void add(uint64_t *hash, int64_t value)
{
    for (int i = 0; i < 8; i++) {
        *hash ^= (uint64_t)value >> (8 * i) & 0xff;
        *hash *= 0x100000001b3u;
    }
}

file_stamp file_stamp_of(const scene *s)
{
    file_stamp stamp = {0xcbf29ce484222325u};

    for (size_t i = 0; i < s->input_count; i++) {
        struct stat about = {0};
        if (stat(s->inputs[i].path, &about) != 0) about.st_size = -1;
        add(&stamp.hash, about.st_size);
        add(&stamp.hash, about.st_mtim.tv_sec);
        add(&stamp.hash, about.st_mtim.tv_nsec);
        add(&stamp.hash, (int64_t)about.st_ino);
    }
    return stamp;
}
