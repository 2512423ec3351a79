#include "device/pocl_manifest.h"

#include "base/array.h"
#include "base/name_table.h"
#include "base/status.h"
#include "files/file_name.h"
#include "files/file_stamp.h"
#include "files/output_file.h"

#include <elf.h>
#include <fcntl.h>
#include <fts.h>
#include <inttypes.h>
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

typedef struct kernel_file {
    uint64_t hash;
    file_stamp stamp;
} kernel_file;

typedef struct manifest {
    name_table *names; /* of files in the folder, numbered as `file` */
    kernel_file *file; /* shape (count) */
    size_t count;
    FILE *text;       /* the next manifest, while it is written */
    bool has_changed; /* against the one that was read */
} manifest;

/* A shared object ends behind its table of sections, bitcode begins with a mark. */
static bool has_form(const char *name, const void *bytes, size_t size)
{
    Elf64_Ehdr head;

    if (!file_name_ends(name, ".so")) return size > 4 && !memcmp(bytes, "BC\xc0\xde", 4);
    if (size < sizeof head) return false;
    memcpy(&head, bytes, sizeof head);
    return !memcmp(head.e_ident, ELFMAG, SELFMAG) && head.e_shoff < size &&
           (size - head.e_shoff) / sizeof(Elf64_Shdr) >= head.e_shnum;
}

/* False where the file cannot be read or lacks the form. */
static bool hash_file(uint64_t *out, const char *path, const char *name)
{
    const int descriptor = open(path, O_RDONLY | O_NOFOLLOW | O_CLOEXEC);
    struct stat found;
    void *bytes = MAP_FAILED;
    bool is_good = false;

    if (descriptor >= 0 && fstat(descriptor, &found) == 0 && found.st_size > 0)
        bytes = mmap(NULL, (size_t)found.st_size, PROT_READ, MAP_PRIVATE, descriptor, 0);
    if (bytes != MAP_FAILED) {
        *out = XXH3_64bits(bytes, (size_t)found.st_size);
        is_good = has_form(name, bytes, (size_t)found.st_size);
        munmap(bytes, (size_t)found.st_size);
    }
    if (descriptor >= 0) close(descriptor);
    return is_good;
}

/* Calls `visit` with every file that PoCL loads: its path, its name in the folder. What it writes at this
 * moment, in whichever process, lies in the folder itself and is moved when it is whole. */
static void visit_files(const char *folder, void (*visit)(manifest *, const char *, const char *),
                        manifest *m)
{
    char *const roots[] = {(char *)folder, NULL};
    FTS *walk = fts_open(roots, FTS_PHYSICAL | FTS_NOCHDIR | FTS_NOSTAT, NULL);

    for (FTSENT *e; walk && (e = fts_read(walk));)
        if (e->fts_level > 1 && (e->fts_info == FTS_F || e->fts_info == FTS_NSOK) &&
            (file_name_ends(e->fts_name, ".so") || !strcmp(e->fts_name, "program.bc")))
            visit(m, e->fts_path, e->fts_path + strlen(folder) + 1);
    if (walk) fts_close(walk);
}

static bool is_same(const file_stamp *a, const file_stamp *b)
{
    return a->size == b->size && a->changed_s == b->changed_s && a->changed_ns == b->changed_ns &&
           a->number == b->number;
}

/* Adds the file of a line, `HASH SIZE SECONDS NANOSECONDS NUMBER NAME`; others are passed over. */
static void add_file(manifest *m, char *line)
{
    kernel_file f;
    int at = 0;
    uint32_t number;

    line[strcspn(line, "\n")] = '\0';
    if (sscanf(line, "%" SCNx64 " %" SCNd64 " %" SCNd64 " %" SCNd64 " %" SCNd64 " %n", &f.hash,
               &f.stamp.size, &f.stamp.changed_s, &f.stamp.changed_ns, &f.stamp.number, &at) != 5 ||
        at == 0 || !array_add(&m->file, m->count, sizeof *m->file) ||
        name_table_number(m->names, 0, line + at, &number) != STATUS_OK || number != m->count)
        return;
    m->file[m->count++] = f;
}

static bool path_of(char out[PATH_SIZE], const char *folder)
{
    return snprintf(out, PATH_SIZE, "%s/%s", folder, manifest_name) < PATH_SIZE;
}

/* False where memory is short. A folder without a manifest has no known files. */
static bool open_manifest(manifest *m, const char *folder)
{
    char path[PATH_SIZE], line[LINE_SIZE];
    FILE *file;

    *m = (manifest){0};
    if (name_table_open(&m->names) != STATUS_OK) return false;
    file = path_of(path, folder) ? fopen(path, "rb") : NULL;
    while (file && fgets(line, sizeof line, file)) add_file(m, line);
    if (file) fclose(file);
    return true;
}

static void close_manifest(manifest *m)
{
    name_table_free(m->names);
    free(m->file);
}

/* The file as the manifest has it, or NULL. */
static const kernel_file *find(const manifest *m, const char *name)
{
    uint32_t number;

    return name_table_number(m->names, 0, name, &number) == STATUS_OK && number < m->count
               ? &m->file[number]
               : NULL;
}

static void check_file(manifest *m, const char *path, const char *name)
{
    const kernel_file *known = find(m, name);
    const file_stamp stamp = file_stamp_of(path);
    uint64_t hash;

    if (known && is_same(&known->stamp, &stamp)) return;
    if (hash_file(&hash, path, name) && !(known && known->hash != hash)) return;
    if (unlink(path) == 0) status_warn("%s: a damaged kernel of PoCL, which is built again", path);
}

void pocl_manifest_check(const char *folder)
{
    manifest m;

    if (open_manifest(&m, folder)) visit_files(folder, check_file, &m);
    close_manifest(&m);
}

static void write_file(manifest *m, const char *path, const char *name)
{
    const kernel_file *known = find(m, name);
    kernel_file f = {.stamp = file_stamp_of(path)};

    if (known && is_same(&known->stamp, &f.stamp)) {
        f.hash = known->hash;
    } else {
        if (!hash_file(&f.hash, path, name)) return;
        m->has_changed = true;
    }
    fprintf(m->text, "%016" PRIx64 " %" PRId64 " %" PRId64 " %" PRId64 " %" PRId64 " %s\n", f.hash,
            f.stamp.size, f.stamp.changed_s, f.stamp.changed_ns, f.stamp.number, name);
}

static void write_manifest(const char *folder, const char *text)
{
    output_file *file = NULL;
    char path[PATH_SIZE];

    if (path_of(path, folder) && output_file_open(&file, path) == STATUS_OK &&
        fputs(text, output_file_stream(file)) >= 0)
        output_file_commit(file);
    output_file_free(file);
}

/* Keeps what was said before, for example why a run ends: the manifest's own failures are none. */
void pocl_manifest_update(const char *folder)
{
    status_record said = status_record_take(*status_message() ? STATUS_DEVICE : STATUS_OK);
    char *text = NULL;
    size_t size = 0;
    manifest m;

    if (open_manifest(&m, folder) && (m.text = open_memstream(&text, &size))) {
        visit_files(folder, write_file, &m);
        if (fclose(m.text) == 0 && text && m.has_changed) write_manifest(folder, text);
    }
    free(text);
    close_manifest(&m);
    status_clear();
    status_record_tell(&said);
    status_record_free(&said);
}
