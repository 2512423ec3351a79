#include "output_file.h"

#include <errno.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>

struct output_file {
    char *path, *temporary_path;
    FILE *stream;
    bool committed;
};

status output_file_reserve(output_file **out, const char *path)
{
    status rc = STATUS_OK;
    const size_t size = strlen(path) + 32;
    struct stat there;
    output_file *file = calloc(1, sizeof *file);

    NEED(file, STATUS_MEMORY, "%s: no memory to write it", path);
    const mode_t kind = stat(path, &there) == 0 ? there.st_mode & S_IFMT : S_IFREG;
    NEED(kind == S_IFREG, STATUS_FILE, "%s: %s", path,
         kind == S_IFDIR ? strerror(EISDIR) : "a device or pipe, expected the name of a file");
    file->path = strdup(path);
    file->temporary_path = malloc(size);
    NEED(file->path && file->temporary_path, STATUS_MEMORY, "%s: no memory to write it", path);
    snprintf(file->temporary_path, size, "%s.%ld.tmp", path, (long)getpid());
    *out = file;
    file = NULL;
out:
    output_file_free(file);
    return rc;
}

status output_file_open(output_file **out, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_reserve(&file, path));
    file->stream = fopen(file->temporary_path, "wb");
    NEED(file->stream, STATUS_FILE, "%s: %s", path, strerror(errno));
    *out = file;
    file = NULL;
out:
    output_file_free(file);
    return rc;
}

FILE *output_file_stream(output_file *file)
{
    return file->stream;
}

const char *output_file_temporary_path(const output_file *file)
{
    return file->temporary_path;
}

const char *output_file_path(const output_file *file)
{
    return file->path;
}

static bool close_stream(output_file *file)
{
    FILE *stream = file->stream;

    if (!stream) return true;
    file->stream = NULL;
    const bool written = fflush(stream) == 0 && !ferror(stream);
    return fclose(stream) == 0 && written;
}

status output_file_commit(output_file *file)
{
    status rc = STATUS_OK;

    NEED(close_stream(file), STATUS_FILE, "%s: writing failed: %s", file->path, strerror(errno));
    NEED(rename(file->temporary_path, file->path) == 0, STATUS_FILE, "%s: %s", file->path,
         strerror(errno));
    file->committed = true;
out:
    return rc;
}

void output_file_free(output_file *file)
{
    if (!file) return;
    close_stream(file);
    if (file->temporary_path && !file->committed) unlink(file->temporary_path);
    free(file->temporary_path);
    free(file->path);
    free(file);
}
