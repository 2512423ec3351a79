#include "files/file_stamp.h"

#include <sys/stat.h>

file_stamp file_stamp_of(const char *path)
{
    struct stat about = {0};

    if (stat(path, &about) != 0) about.st_size = -1;
    return (file_stamp){about.st_size, about.st_mtim.tv_sec, about.st_mtim.tv_nsec,
                        (int64_t)about.st_ino};
}
