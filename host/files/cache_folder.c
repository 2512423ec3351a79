#include "files/cache_folder.h"

#include "base/number.h"
#include "base/status.h"

#include <dirent.h>
#include <fcntl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

typedef struct cached_file {
    char name[256];
    struct timespec used;
    uint64_t bytes;
} cached_file;

bool cache_folder_make(const char *path)
{
    char part[CACHE_FOLDER_PATH];

    if (snprintf(part, sizeof part, "%s", path) >= (int)sizeof part) return false;
    for (char *end = part + 1; *end; end++) {
        if (*end != '/') continue;
        *end = '\0';
        mkdir(part, 0700);
        *end = '/';
    }
    mkdir(part, 0700);
    return access(part, W_OK | X_OK) == 0;
}

bool cache_folder_find(char out[CACHE_FOLDER_PATH])
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    const bool is_stated =
        cache && cache[0] == '/'; /* others are to be ignored, says its standard */

    if (!is_stated && !(home && home[0] == '/')) return false;
    return snprintf(out, CACHE_FOLDER_PATH, "%s%s/radsig", is_stated ? cache : home,
                    is_stated ? "" : "/.cache") < CACHE_FOLDER_PATH &&
           cache_folder_make(out);
}

uint64_t cache_folder_budget(void)
{
    const double usual = 4294967296.0, most_gb = 1e9;
    const char *text = getenv("RADSIG_CACHE_GB");
    double gb;

    if (!text) return (uint64_t)usual;
    if (number_read(text, &gb) && gb >= 0.0 && gb <= most_gb) return (uint64_t)(1e9 * gb);
    status_warn("RADSIG_CACHE_GB: found '%s', expected a number of 10^9 bytes from 0 on", text);
    return (uint64_t)usual;
}

void cache_folder_touch(int descriptor)
{
    futimens(descriptor, NULL);
}

static int older(const void *a, const void *b)
{
    const cached_file *one = a, *other = b;

    if (one->used.tv_sec != other->used.tv_sec)
        return one->used.tv_sec < other->used.tv_sec ? -1 : 1;
    if (one->used.tv_nsec != other->used.tv_nsec)
        return one->used.tv_nsec < other->used.tv_nsec ? -1 : 1;
    return strcmp(one->name, other->name);
}

/* Lists the files of a folder; the caller frees the list. */
static cached_file *list_files(DIR *folder, size_t *out_count)
{
    cached_file *list = NULL;
    size_t capacity = 0, count = 0;
    struct stat found;

    for (struct dirent *entry; (entry = readdir(folder));) {
        if (fstatat(dirfd(folder), entry->d_name, &found, AT_SYMLINK_NOFOLLOW) != 0 ||
            !S_ISREG(found.st_mode))
            continue;
        if (count == capacity) {
            capacity = 2 * capacity + 64;
            cached_file *grown = realloc(list, capacity * sizeof *list);
            if (!grown) break; /* those that are known will do */
            list = grown;
        }
        snprintf(list[count].name, sizeof list->name, "%s", entry->d_name);
        list[count].used = found.st_mtim;
        list[count++].bytes = (uint64_t)found.st_size;
    }
    *out_count = count;
    return list;
}

bool cache_folder_make_room(const char *path, uint64_t bytes)
{
    const uint64_t budget = cache_folder_budget();
    DIR *folder = bytes <= budget ? opendir(path) : NULL;
    size_t count = 0;

    if (!folder) return false;
    cached_file *list = list_files(folder, &count);
    for (size_t i = 0; i < count; i++) bytes += list[i].bytes;
    if (count > 0) qsort(list, count, sizeof *list, older);
    for (size_t i = 0; i < count && bytes > budget; i++) {
        unlinkat(dirfd(folder), list[i].name, 0);
        bytes -= list[i].bytes;
    }
    free(list);
    closedir(folder);
    return true;
}
