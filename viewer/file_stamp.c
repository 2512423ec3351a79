#include "file_stamp.h"

#include <sys/stat.h>
#include <xxhash.h>

file_stamp file_stamp_of(const scene *s)
{
    file_stamp stamp = {0};

    for (size_t i = 0; i < s->input_count; i++) {
        struct stat about = {0};
        if (stat(s->inputs[i].path, &about) != 0) about.st_size = -1;
        const int64_t words[4] = {about.st_size, about.st_mtim.tv_sec, about.st_mtim.tv_nsec,
                                  (int64_t)about.st_ino};
        stamp.hash = XXH3_64bits_withSeed(words, sizeof words, stamp.hash);
    }
    return stamp;
}
