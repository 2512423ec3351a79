#include "files/staging_folder.h"

#include <dirent.h>
#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

enum { TRY_LIMIT = 32, FOLDER_FLAGS = O_RDONLY | O_DIRECTORY | O_CLOEXEC };

static const char prefix[] = ".radsig-", random_part[] = "XXXXXX", lock_name[] = ".radsig-lock";

struct staging_folder {
    char *path, *name;      /* the name ends the path */
    int parent, self, lock; /* descriptors; -1: none */
};

/* Removes what a folder holds; the lock comes last, so that a folder with anything in it has one. */
static void remove_entries(int folder)
{
    const int copy = openat(folder, ".", FOLDER_FLAGS);
    DIR *list = copy < 0 ? NULL : fdopendir(copy);

    for (struct dirent *entry; list && (entry = readdir(list));) {
        const char *name = entry->d_name;
        if (!strcmp(name, ".") || !strcmp(name, "..") || !strcmp(name, lock_name)) continue;
        if (unlinkat(folder, name, 0) == 0 || errno != EISDIR) continue;
        const int inner = openat(folder, name, FOLDER_FLAGS | O_NOFOLLOW);
        if (inner < 0) continue;
        remove_entries(inner);
        close(inner);
        unlinkat(folder, name, AT_REMOVEDIR);
    }
    if (list)
        closedir(list);
    else if (copy >= 0)
        close(copy);
    unlinkat(folder, lock_name, 0);
}

static bool is_staging_name(const char *name)
{
    return !strncmp(name, prefix, strlen(prefix)) &&
           strlen(name) == strlen(prefix) + strlen(random_part);
}

/* Removes a folder that a process of this user left when it was killed. One without a lock is being
 * made or being removed: it goes only if it is empty, and its maker tries again. */
static void remove_left(int parent, const char *name)
{
    struct stat found;
    const int folder = openat(parent, name, FOLDER_FLAGS | O_NOFOLLOW);

    if (folder < 0) return;
    if (fstat(folder, &found) == 0 && found.st_uid == geteuid()) {
        const int lock = openat(folder, lock_name, O_RDWR | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
        const bool is_free = lock >= 0 && flock(lock, LOCK_EX | LOCK_NB) == 0;
        if (is_free) remove_entries(folder);
        if (is_free || lock < 0) unlinkat(parent, name, AT_REMOVEDIR);
        if (lock >= 0) close(lock);
    }
    close(folder);
}

static void remove_all_left(int parent)
{
    const int copy = openat(parent, ".", FOLDER_FLAGS);
    DIR *list = copy < 0 ? NULL : fdopendir(copy);

    for (struct dirent *entry; list && (entry = readdir(list));)
        if (is_staging_name(entry->d_name)) remove_left(parent, entry->d_name);
    if (list)
        closedir(list);
    else if (copy >= 0)
        close(copy);
}

static void close_both(staging_folder *s)
{
    if (s->lock >= 0) close(s->lock);
    if (s->self >= 0) close(s->self);
    s->lock = s->self = -1;
}

/* Makes the folder and its lock; false, with errno, if that failed or another process removed it
 * before it was locked. */
static bool make(staging_folder *s, const char *parent, size_t size)
{
    struct stat found;

    snprintf(s->path, size, "%s/%s%s", parent, prefix, random_part);
    s->name = s->path + strlen(parent) + 1;
    if (!mkdtemp(s->path)) return false;
    s->self = open(s->path, FOLDER_FLAGS | O_NOFOLLOW);
    if (s->self >= 0)
        s->lock =
            openat(s->self, lock_name, O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0600);
    /* Where a file system has no locks nothing is ever removed. */
    if (s->lock >= 0 && (flock(s->lock, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) &&
        fstat(s->lock, &found) == 0 && found.st_nlink > 0)
        return true;
    const int error = errno;
    if (s->self >= 0) unlinkat(s->self, lock_name, 0);
    close_both(s);
    unlinkat(s->parent, s->name, AT_REMOVEDIR);
    errno = error;
    return false;
}

status staging_folder_open(staging_folder **out, const char *parent, const char *wanted)
{
    status rc = STATUS_OK;
    const size_t size = strlen(parent) + sizeof prefix + sizeof random_part + 1;
    bool is_made = false;
    staging_folder *s = calloc(1, sizeof *s);

    NEED(s, STATUS_MEMORY, "%s: no memory to write it", wanted);
    s->parent = s->self = s->lock = -1;
    s->path = malloc(size);
    NEED(s->path, STATUS_MEMORY, "%s: no memory to write it", wanted);
    s->parent = open(parent, FOLDER_FLAGS);
    NEED(s->parent >= 0, STATUS_FILE, "%s: %s", wanted, strerror(errno));
    remove_all_left(s->parent);
    for (int i = 0; i < TRY_LIMIT && !is_made; i++) is_made = make(s, parent, size);
    NEED(is_made, STATUS_FILE, "%s: %s", wanted, strerror(errno));
    *out = s;
    s = NULL;
out:
    staging_folder_free(s);
    return rc;
}

const char *staging_folder_path(const staging_folder *staging)
{
    return staging->path;
}

int staging_folder_self(const staging_folder *staging)
{
    return staging->self;
}

int staging_folder_parent(const staging_folder *staging)
{
    return staging->parent;
}

void staging_folder_free(staging_folder *staging)
{
    if (!staging) return;
    if (staging->self >= 0) {
        remove_entries(staging->self);
        unlinkat(staging->parent, staging->name, AT_REMOVEDIR);
    }
    close_both(staging);
    if (staging->parent >= 0) close(staging->parent);
    free(staging->path);
    free(staging);
}
