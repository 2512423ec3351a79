#include "files/output_folder.h"

#include <errno.h>
#include <pthread.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct output_folder {
    char *path;
    char *made; /* shape (length of the path + 1): 1 where a part that was made ends */
    staging_folder *staging;
    output_file **file; /* shape (file_count) */
    size_t file_count;
    pthread_mutex_t lock; /* of the list of files */
    bool committed;
};

static status make(output_folder *folder, const char *part, size_t length)
{
    status rc = STATUS_OK;
    struct stat found;
    const int error = mkdir(part, 0777) == 0 ? 0 : errno;

    folder->made[length] = error == 0;
    if (error == 0 || (stat(part, &found) == 0 && S_ISDIR(found.st_mode))) goto out;
    NEED(error != EEXIST, STATUS_FILE, "%s: is not a folder, so %s cannot be written", part,
         folder->path);
    rc = status_set(STATUS_FILE, "%s: cannot be made: %s", part, strerror(error));
out:
    return rc;
}

/* The path with everything from the length-th character on cut off is a folder on the way. */
static bool ends_a_part(const char *path, size_t length)
{
    return length > 0 && path[length - 1] != '/' && (path[length] == '/' || path[length] == '\0');
}

static status make_with_parents(output_folder *folder)
{
    status rc = STATUS_OK;
    const size_t full = strlen(folder->path);
    char *part = strdup(folder->path);

    NEED(part, STATUS_MEMORY, "%s: no memory to make it", folder->path);
    for (size_t length = 1; length <= full; length++) {
        if (!ends_a_part(folder->path, length)) continue;
        part[length] = '\0';
        TRY(make(folder, part, length));
        part[length] = folder->path[length];
    }
out:
    free(part);
    return rc;
}

status output_folder_open(output_folder **out, const char *path)
{
    status rc = STATUS_OK;
    output_folder *folder = calloc(1, sizeof *folder);

    NEED(folder, STATUS_MEMORY, "%s: no memory to make it", path);
    pthread_mutex_init(&folder->lock, NULL);
    folder->path = strdup(path[0] ? path : ".");
    NEED(folder->path, STATUS_MEMORY, "%s: no memory to make it", path);
    folder->made = calloc(strlen(folder->path) + 1, 1);
    NEED(folder->made, STATUS_MEMORY, "%s: no memory to make it", path);
    TRY(make_with_parents(folder));
    TRY(staging_folder_open(&folder->staging, folder->path, folder->path));
    *out = folder;
    folder = NULL;
out:
    output_folder_free(folder);
    return rc;
}

status output_folder_add(output_folder *folder, const char *name, output_file **out)
{
    status rc = STATUS_OK;
    const size_t size = strlen(folder->path) + strlen(name) + 2;
    char *path = malloc(size);
    output_file **more = NULL;

    pthread_mutex_lock(&folder->lock);
    NEED(path, STATUS_MEMORY, "%s: no memory to write it", name);
    snprintf(path, size, "%s/%s", folder->path, name);
    more = realloc(folder->file, (folder->file_count + 1) * sizeof(output_file *));
    NEED(more, STATUS_MEMORY, "%s: no memory to write it", path);
    folder->file = more;
    TRY(output_file_open_staged(&folder->file[folder->file_count], folder->staging, path));
    *out = folder->file[folder->file_count++];
out:
    pthread_mutex_unlock(&folder->lock);
    free(path);
    return rc;
}

status output_folder_commit(output_folder *folder)
{
    status rc = STATUS_OK;

    TRY(output_file_commit_all(folder->file, folder->file_count));
    folder->committed = true;
out:
    return rc;
}

/* From the folder upwards; one that is not empty stays. */
static void remove_made(output_folder *folder)
{
    for (size_t length = strlen(folder->path); length > 0; length--) {
        if (!folder->made[length]) continue;
        folder->path[length] = '\0';
        rmdir(folder->path);
    }
}

void output_folder_free(output_folder *folder)
{
    if (!folder) return;
    for (size_t i = 0; i < folder->file_count; i++) output_file_free(folder->file[i]);
    staging_folder_free(folder->staging);
    if (folder->made && !folder->committed) remove_made(folder);
    pthread_mutex_destroy(&folder->lock);
    free(folder->made);
    free(folder->file);
    free(folder->path);
    free(folder);
}
