#define _GNU_SOURCE /* renameat2 */

#include "files/output_file.h"

#include "base/interrupt.h"

#include <errno.h>
#include <fcntl.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <time.h>
#include <unistd.h>

/* Files are published in this order. */
enum { RANK_DATA, RANK_HEADER, RANK_REPORT, RANKS };

/* Where the old file waits on file systems that exchange none. */
static const char aside[] = ".radsig-old";

enum { PORTION = 1 << 24 }; /* bytes */

struct output_file {
    char *path;
    const char *name; /* ends the path */
    FILE *stream;     /* NULL: closed */
    const staging_folder *staging;
    staging_folder *own; /* of a file that is committed alone */
    mode_t mode;         /* permissions of the file that it replaces */
    bool replaces, is_published, has_old;
};

/* A link to a device or to a folder is none to be replaced either. */
static status check_place(output_file *file)
{
    status rc = STATUS_OK;
    struct stat there;

    file->replaces = fstatat(staging_folder_parent(file->staging), file->name, &there, 0) == 0;
    if (!file->replaces) goto out;
    NEED(!S_ISDIR(there.st_mode), STATUS_FILE, "%s: is a folder, expected a file or nothing",
         file->path);
    NEED(S_ISREG(there.st_mode), STATUS_FILE, "%s: a device or pipe, expected the name of a file",
         file->path);
    file->mode = there.st_mode & 0777;
out:
    return rc;
}

status output_file_open_staged(output_file **out, const staging_folder *staging, const char *path)
{
    status rc = STATUS_OK;
    int descriptor = -1;
    output_file *file = calloc(1, sizeof *file);

    NEED(file, STATUS_MEMORY, "%s: no memory to write it", path);
    file->staging = staging;
    file->path = strdup(path);
    NEED(file->path, STATUS_MEMORY, "%s: no memory to write it", path);
    const char *slash = strrchr(file->path, '/');
    file->name = slash ? slash + 1 : file->path;
    TRY(check_place(file));
    descriptor = openat(staging_folder_self(staging), file->name,
                        O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC, 0666);
    NEED(descriptor >= 0 || errno != EEXIST, STATUS_FILE, "%s: two files of this name", path);
    NEED(descriptor >= 0, STATUS_FILE, "%s: %s", path, strerror(errno));
    file->stream = fdopen(descriptor, "w+b");
    NEED(file->stream, STATUS_FILE, "%s: %s", path, strerror(errno));
    descriptor = -1;
    *out = file;
    file = NULL;
out:
    if (descriptor >= 0) close(descriptor);
    output_file_free(file);
    return rc;
}

/* The folder that a path's file stands in; the caller frees it. NULL: no memory. */
static char *folder_of(const char *path)
{
    const char *slash = strrchr(path, '/');

    if (!slash) return strdup(".");
    return strndup(path, slash == path ? 1 : (size_t)(slash - path));
}

status output_file_open(output_file **out, const char *path)
{
    status rc = STATUS_OK;
    staging_folder *own = NULL;
    char *folder = folder_of(path);

    NEED(folder, STATUS_MEMORY, "%s: no memory to write it", path);
    TRY(staging_folder_open(&own, folder, path));
    TRY(output_file_open_staged(out, own, path));
    (*out)->own = own;
    own = NULL;
out:
    staging_folder_free(own);
    free(folder);
    return rc;
}

FILE *output_file_stream(output_file *file)
{
    return file->stream;
}

const char *output_file_path(const output_file *file)
{
    return file->path;
}

status output_file_close(output_file *file)
{
    status rc = STATUS_OK;
    FILE *stream = file->stream;

    if (!stream) goto out;
    file->stream = NULL;
    const bool is_written = fflush(stream) == 0 && !ferror(stream);
    const int error = errno;
    const bool is_closed = fclose(stream) == 0;
    NEED(is_written && is_closed, STATUS_FILE, "%s: writing failed: %s", file->path,
         strerror(is_written ? errno : error));
out:
    return rc;
}

/* Has the disk store a file, so much at a time that an interrupt need not wait for all of it. */
static status store_data(const output_file *file, int descriptor)
{
    status rc = STATUS_OK;
    const off_t end = lseek(descriptor, 0, SEEK_END);

    for (off_t at = 0; at < end; at += PORTION) {
        TRY(interrupt_check());
        /* Where the system cannot do it, fsync does; an error is told once, here or there. */
        NEED(sync_file_range(descriptor, at, PORTION,
                             SYNC_FILE_RANGE_WAIT_BEFORE | SYNC_FILE_RANGE_WRITE |
                                 SYNC_FILE_RANGE_WAIT_AFTER) == 0 ||
                 errno == ENOSYS || errno == EINVAL,
             STATUS_FILE, "%s: writing failed: %s", file->path, strerror(errno));
    }
    NEED(fsync(descriptor) == 0, STATUS_FILE, "%s: writing failed: %s", file->path,
         strerror(errno));
out:
    return rc;
}

static status store(const output_file *file)
{
    status rc = STATUS_OK;
    const int descriptor =
        openat(staging_folder_self(file->staging), file->name, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);

    NEED(descriptor >= 0, STATUS_FILE, "%s: %s", file->path, strerror(errno));
    NEED(!file->replaces || fchmod(descriptor, file->mode) == 0, STATUS_FILE,
         "%s: cannot have the permissions of the file that it replaces: %s", file->path,
         strerror(errno));
    TRY(store_data(file, descriptor));
out:
    if (descriptor >= 0) close(descriptor);
    return rc;
}

/* Exchanges what has the name in two folders, in one step where the file system can. */
static int exchange(int from, int to, const char *name)
{
    if (renameat2(from, name, to, name, RENAME_EXCHANGE) == 0) return 0;
    if (errno != EINVAL && errno != ENOSYS && errno != EOPNOTSUPP) return -1;
    if (linkat(to, name, from, aside, 0) != 0 && renameat(to, name, from, aside) != 0) return -1;
    if (renameat(from, name, to, name) != 0) {
        const int error = errno;
        renameat(from, aside, to, name);
        errno = error;
        return -1;
    }
    return renameat(from, aside, from, name);
}

static status publish(output_file *file)
{
    status rc = STATUS_OK;
    const int from = staging_folder_self(file->staging);
    const int to = staging_folder_parent(file->staging);
    struct stat old;

    file->has_old = exchange(from, to, file->name) == 0;
    file->is_published =
        file->has_old || (errno == ENOENT && renameat(from, file->name, to, file->name) == 0);
    NEED(file->is_published, STATUS_FILE, "%s: %s", file->path, strerror(errno));
    NEED(!file->has_old || fstatat(from, file->name, &old, AT_SYMLINK_NOFOLLOW) != 0 ||
             !S_ISDIR(old.st_mode),
         STATUS_FILE, "%s: is a folder, expected a file or nothing", file->path);
out:
    return rc;
}

static void take_back(output_file *file)
{
    const int from = staging_folder_self(file->staging);
    const int to = staging_folder_parent(file->staging);

    if (!file->is_published) return;
    file->is_published = false;
    if (file->has_old)
        exchange(from, to, file->name);
    else
        renameat(to, file->name, from, file->name);
}

static int rank_of(const output_file *file)
{
    const char *ending = strrchr(file->name, '.');

    if (ending && !strcmp(ending, ".hdr")) return RANK_HEADER;
    return ending && !strcmp(ending, ".json") ? RANK_REPORT : RANK_DATA;
}

static status publish_all(output_file *const *file, size_t count)
{
    status rc = STATUS_OK;

    for (int rank = 0; rank < RANKS; rank++)
        for (size_t i = 0; i < count; i++)
            if (rank_of(file[i]) == rank) TRY(publish(file[i]));
out:
    for (int rank = RANKS; rc != STATUS_OK && rank-- > 0;)
        for (size_t i = count; i-- > 0;)
            if (rank_of(file[i]) == rank) take_back(file[i]);
    return rc;
}

/* Waits until no other process publishes in the folder. Where it cannot be locked, on some network
 * file systems, nobody waits. */
static status lock(int folder)
{
    status rc = STATUS_OK;
    const struct timespec pause = {.tv_nsec = 10000000};

    while (flock(folder, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        TRY(interrupt_check());
        nanosleep(&pause, NULL);
    }
out:
    return rc;
}

status output_file_commit_all(output_file *const *file, size_t count)
{
    status rc = STATUS_OK;
    int folder = -1;

    for (size_t i = 0; i < count; i++) TRY(output_file_close(file[i]));
    for (size_t i = 0; i < count; i++) TRY(check_place(file[i]));
    for (size_t i = 0; i < count; i++) TRY(store(file[i]));
    if (count == 0) goto out;
    folder = staging_folder_parent(file[0]->staging);
    TRY(lock(folder));
    TRY(publish_all(file, count));
    /* Some file systems store no folder by itself. */
    NEED(fsync(folder) == 0 || errno == EINVAL, STATUS_FILE, "%s: its folder cannot be stored: %s",
         file[0]->path, strerror(errno));
out:
    if (folder >= 0) flock(folder, LOCK_UN);
    return rc;
}

status output_file_commit(output_file *file)
{
    return output_file_commit_all(&file, 1);
}

void output_file_free(output_file *file)
{
    if (!file) return;
    if (file->stream) fclose(file->stream);
    staging_folder_free(file->own);
    free(file->path);
    free(file);
}
