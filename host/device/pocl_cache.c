#include "device/pocl_cache.h"

#include "base/status.h"
#include "files/cache_folder.h"

#include <pthread.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <sys/statvfs.h>
#include <unistd.h>

/* What a build writes at most, tens of MB with the files that it removes again. */
static const uint64_t least_room = 64u << 20;

static char folder[CACHE_FOLDER_PATH];

static bool is_usable(const char *path)
{
    struct statvfs disk;

    return cache_folder_make(path) && statvfs(path, &disk) == 0 &&
           (uint64_t)disk.f_bavail * disk.f_frsize >= least_room;
}

/* PoCL's own folder; without a home it would be one in /tmp that anybody can write. */
static bool usual_folder(char out[CACHE_FOLDER_PATH])
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    const bool is_stated = cache && *cache;

    if (!is_stated && !(home && *home)) return false;
    return snprintf(out, CACHE_FOLDER_PATH, "%s%s/pocl/kcache", is_stated ? cache : home,
                    is_stated ? "" : "/.cache") < CACHE_FOLDER_PATH;
}

/* A folder in one that others may write in too: nobody else may own it. */
static bool own_folder(char out[CACHE_FOLDER_PATH], const char *parent)
{
    struct stat found;

    if (!parent || *parent != '/') return false;
    if (snprintf(out, CACHE_FOLDER_PATH, "%s/radsig-%u", parent, (unsigned)geteuid()) >=
        CACHE_FOLDER_PATH - 8)
        return false;
    mkdir(out, 0700);
    if (lstat(out, &found) != 0 || !S_ISDIR(found.st_mode) || found.st_uid != geteuid() ||
        found.st_mode & 022)
        return false;
    strcat(out, "/pocl");
    return is_usable(out);
}

static void choose(void)
{
    const char *stated = getenv("POCL_CACHE_DIR");
    const char *parents[] = {getenv("XDG_RUNTIME_DIR"), getenv("TMPDIR"), "/tmp"};
    char other[CACHE_FOLDER_PATH];

    if (stated) {
        snprintf(folder, sizeof folder, "%s", stated);
        return;
    }
    const bool has_usual = usual_folder(folder);
    if (has_usual && is_usable(folder)) return;
    for (size_t i = 0; i < sizeof parents / sizeof *parents; i++) {
        if (!own_folder(other, parents[i])) continue;
        status_warn("PoCL keeps its kernels in %s, because %s cannot be written or is full; "
                    "POCL_CACHE_DIR chooses another folder",
                    other, has_usual ? folder : "the cache of a home that is not known");
        strcpy(folder, other);
        setenv("POCL_CACHE_DIR", folder, 1);
        return;
    }
}

void pocl_cache_choose(void)
{
    static pthread_once_t once = PTHREAD_ONCE_INIT;

    pthread_once(&once, choose);
}

const char *pocl_cache_folder(void)
{
    return folder;
}

bool pocl_cache_is_usable(void)
{
    return is_usable(folder);
}
