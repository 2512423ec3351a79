#include "device/pocl_manifest.h"

#include "base/status.h"
#include "files/output_file.h"

#include <elf.h>
#include <fcntl.h>
#include <fts.h>
#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

enum { PATH_SIZE = 4096, LINE_SIZE = 512 };

static const char manifest_name[] = "radsig-files";

static bool ends_with(const char *text, const char *end)
{
    const size_t length = strlen(text), end_length = strlen(end);

    return length >= end_length && !strcmp(text + length - end_length, end);
}

/* A shared object ends behind its table of sections, bitcode begins with a mark. */
static bool has_form(const char *path, const void *bytes, size_t size)
{
    Elf64_Ehdr head;

    if (!ends_with(path, ".so")) return size > 4 && !memcmp(bytes, "BC\xc0\xde", 4);
    if (size < sizeof head) return false;
    memcpy(&head, bytes, sizeof head);
    return !memcmp(head.e_ident, ELFMAG, SELFMAG) && head.e_shoff < size &&
           (size - head.e_shoff) / sizeof(Elf64_Shdr) >= head.e_shnum;
}

/* Writes the line of a file, `HASH SIZE PATH`; false where it cannot be read or lacks the form. */
static bool describe(char out[LINE_SIZE], const char *path, const char *name)
{
    const int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    struct stat found;
    void *bytes = MAP_FAILED;
    bool is_good = false;

    if (descriptor >= 0 && fstat(descriptor, &found) == 0 && found.st_size > 0)
        bytes = mmap(NULL, (size_t)found.st_size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (bytes != MAP_FAILED) {
        const size_t size = (size_t)found.st_size;
        const unsigned long long hash = XXH3_64bits(bytes, size);
        is_good = has_form(name, bytes, size) &&
                  snprintf(out, LINE_SIZE, "%016llx %zu %s\n", hash, size, name) < LINE_SIZE;
        munmap(bytes, size);
    }
    if (descriptor >= 0) close(descriptor);
    return is_good;
}

/* Calls `take` with every file that PoCL loads: its path, its name in the folder. */
static void for_files(const char *folder, void (*take)(void *, const char *, const char *),
                      void *self)
{
    char *const roots[] = {(char *)folder, NULL};
    FTS *walk = fts_open(roots, FTS_PHYSICAL | FTS_NOCHDIR | FTS_NOSTAT, NULL);

    for (FTSENT *e; walk && (e = fts_read(walk));)
        if ((e->fts_info == FTS_F || e->fts_info == FTS_NSOK) &&
            (ends_with(e->fts_name, ".so") || !strcmp(e->fts_name, "program.bc")))
            take(self, e->fts_path, e->fts_path + strlen(folder) + 1);
    if (walk) fts_close(walk);
}

/* The text of the manifest; the caller frees it. NULL: there is none. */
static char *read_manifest(const char *folder)
{
    char path[PATH_SIZE], *text = NULL;
    size_t room = 0;
    FILE *file = NULL;

    if (snprintf(path, sizeof path, "%s/%s", folder, manifest_name) < (int)sizeof path)
        file = fopen(path, "rb");
    if (!file) return NULL;
    if (getdelim(&text, &room, '\0', file) < 0) {
        free(text);
        text = NULL;
    }
    fclose(file);
    return text;
}

/* Whether the manifest has the file, with another hash or size. */
static bool differs(const char *manifest, const char *line, const char *name)
{
    char end[LINE_SIZE];

    snprintf(end, sizeof end, " %s\n", name);
    return manifest && strstr(manifest, end) && !strstr(manifest, line);
}

static void check_file(void *self, const char *path, const char *name)
{
    char line[LINE_SIZE] = "";

    if (describe(line, path, name) && !differs(self, line, name)) return;
    if (unlink(path) == 0) status_warn("%s: a damaged kernel of PoCL, which is built again", path);
}

void pocl_manifest_check(const char *folder)
{
    char *manifest = read_manifest(folder);

    for_files(folder, check_file, manifest);
    free(manifest);
}

static void add_line(void *self, const char *path, const char *name)
{
    char line[LINE_SIZE];

    if (describe(line, path, name)) fputs(line, self);
}

static void write_manifest(const char *folder, const char *text)
{
    output_file *file = NULL;
    char path[PATH_SIZE];

    if (snprintf(path, sizeof path, "%s/%s", folder, manifest_name) < (int)sizeof path &&
        output_file_open(&file, path) == STATUS_OK && fputs(text, output_file_stream(file)) >= 0)
        output_file_commit(file);
    output_file_free(file);
}

void pocl_manifest_update(const char *folder)
{
    char *text = NULL, *manifest = NULL;
    size_t size = 0;
    FILE *stream = open_memstream(&text, &size);

    if (!stream) return;
    for_files(folder, add_line, stream);
    if (fclose(stream) == 0 && text) {
        manifest = read_manifest(folder);
        if (size > 0 && (!manifest || strcmp(manifest, text) != 0)) write_manifest(folder, text);
    }
    free(manifest);
    free(text);
}
