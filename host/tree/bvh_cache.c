#include "tree/bvh_cache.h"

#include "base/interrupt.h"
#include "files/cache_folder.h"
#include "files/output_file.h"

#include <fcntl.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#ifndef BVH_LAYOUT
#error "the Makefile defines BVH_LAYOUT, a hash of the sources that decide what a tree is made of"
#endif

enum { PORTION = 1 << 24 }; /* bytes */

/* What a file begins with; nodes and blocks follow. Numbers are in the machine's order. */
typedef struct header {
    char magic[8];
    uint64_t layout;
    XXH128_canonical_t key;
    uint32_t node_count, block_count, triangle_count;
    float low[3], high[3];
    uint32_t unused;
    uint64_t check; /* of all else */
} header;

_Static_assert(sizeof(header) == 80, "a header has no gaps");

static const char magic[8] = "radsigU";
static const uint64_t layout = BVH_LAYOUT;

/* What the tree is built over: tells geometry apart, no more is needed in a user's own folder. */
static XXH128_canonical_t make_key(const bvh_source *source)
{
    const uint32_t form[] = {source->facet_count, source->vertex_count, source->two_sided != NULL,
                             0x01020304};
    XXH128_canonical_t key;
    XXH3_state_t state;

    XXH3_INITSTATE(&state);
    XXH3_128bits_reset_withSeed(&state, layout);
    XXH3_128bits_update(&state, form, sizeof form);
    XXH3_128bits_update(&state, source->corner, source->facet_count * sizeof *source->corner);
    XXH3_128bits_update(&state, source->position, source->vertex_count * sizeof *source->position);
    if (source->two_sided) XXH3_128bits_update(&state, source->two_sided, source->facet_count);
    XXH128_canonicalFromHash(&key, XXH3_128bits_digest(&state));
    return key;
}

static uint64_t check_of(const header *h, const bvh_tables *t)
{
    XXH3_state_t state;

    XXH3_INITSTATE(&state);
    XXH3_64bits_reset(&state);
    XXH3_64bits_update(&state, h, offsetof(header, check));
    XXH3_64bits_update(&state, t->node, t->node_count * sizeof *t->node);
    XXH3_64bits_update(&state, t->block, t->block_count * sizeof *t->block);
    return XXH3_64bits_digest(&state);
}

/* Reads so many bytes; false if there are fewer, and after an interrupt. */
static bool read_all(FILE *file, void *out, size_t size)
{
    for (size_t at = 0; at < size; at += PORTION) {
        const size_t some = size - at < PORTION ? size - at : PORTION;
        if (interrupt_is_set() || fread((char *)out + at, some, 1, file) != 1) return false;
    }
    return true;
}

static bool write_all(FILE *file, const void *bytes, size_t size)
{
    for (size_t at = 0; at < size; at += PORTION) {
        const size_t some = size - at < PORTION ? size - at : PORTION;
        if (interrupt_is_set() || fwrite((const char *)bytes + at, some, 1, file) != 1)
            return false;
    }
    return true;
}

static off_t file_size(const header *h)
{
    return (off_t)(sizeof *h + h->node_count * sizeof(bvh_node) +
                   h->block_count * sizeof(bvh_block));
}

/* Writes the paths of the folder and of the file in it; false if there is no folder to be had. */
static bool find_file(char folder[CACHE_FOLDER_PATH], char out[CACHE_FOLDER_PATH],
                      const XXH128_canonical_t *key)
{
    char name[2 * sizeof key->digest + 1];

    if (!cache_folder_find(folder)) return false;
    for (size_t i = 0; i < sizeof key->digest; i++)
        snprintf(name + 2 * i, 3, "%02x", key->digest[i]);
    return snprintf(out, CACHE_FOLDER_PATH, "%s/%s.tree", folder, name) < CACHE_FOLDER_PATH;
}

/* Reads the rest of a file whose header was found good; false where it is not what was written. */
static bool read_tree(bvh **out, FILE *file, const header *h)
{
    bvh_tables tables = {.node_count = h->node_count,
                         .block_count = h->block_count,
                         .triangle_count = h->triangle_count};
    bvh *tree = NULL;
    bvh_node *node;
    bvh_block *block;

    memcpy(tables.low, h->low, sizeof h->low);
    memcpy(tables.high, h->high, sizeof h->high);
    if (bvh_restore(&tree, &tables, &node, &block) != STATUS_OK) return false;
    const bool is_whole = read_all(file, node, h->node_count * sizeof *node) &&
                          read_all(file, block, h->block_count * sizeof *block) &&
                          check_of(h, bvh_look(tree)) == h->check;
    if (is_whole)
        *out = tree;
    else
        bvh_free(tree);
    return is_whole;
}

static bool load(bvh **out, const char *path, const XXH128_canonical_t *key)
{
    const int descriptor = open(path, O_RDONLY | O_NONBLOCK | O_CLOEXEC);
    FILE *file = descriptor < 0 ? NULL : fdopen(descriptor, "rb");
    struct stat found;
    header h;

    if (!file) {
        if (descriptor >= 0) close(descriptor);
        return false;
    }
    const bool is_ours = fstat(descriptor, &found) == 0 && S_ISREG(found.st_mode) &&
                         fread(&h, sizeof h, 1, file) == 1 && !memcmp(h.magic, magic, 8) &&
                         h.layout == layout && !memcmp(&h.key, key, sizeof *key) &&
                         found.st_size == file_size(&h) && read_tree(out, file, &h);
    if (is_ours) cache_folder_touch(descriptor);
    fclose(file);
    return is_ours;
}

static bool write_tree(FILE *file, const header *h, const bvh_tables *t)
{
    return write_all(file, h, sizeof *h) &&
           write_all(file, t->node, t->node_count * sizeof *t->node) &&
           write_all(file, t->block, t->block_count * sizeof *t->block);
}

/* Others see a whole file or none. */
static void store(const bvh_tables *t, const char *folder, const char *path,
                  const XXH128_canonical_t *key)
{
    header h = {.layout = layout,
                .key = *key,
                .node_count = t->node_count,
                .block_count = t->block_count,
                .triangle_count = t->triangle_count};
    output_file *file = NULL;

    memcpy(h.magic, magic, sizeof magic);
    memcpy(h.low, t->low, sizeof h.low);
    memcpy(h.high, t->high, sizeof h.high);
    h.check = check_of(&h, t);
    if (!cache_folder_make_room(folder, (uint64_t)file_size(&h))) return;
    if (output_file_open(&file, path) != STATUS_OK) return;
    if (write_tree(output_file_stream(file), &h, t)) output_file_commit(file);
    output_file_free(file);
}

status bvh_cache_build(bvh **out, const bvh_source *source)
{
    status rc = STATUS_OK;
    XXH128_canonical_t key;
    char folder[CACHE_FOLDER_PATH], path[CACHE_FOLDER_PATH];
    bool is_kept = source->facet_count >= BVH_CACHE_LEAST;

    if (is_kept) {
        key = make_key(source);
        is_kept = find_file(folder, path, &key);
    }
    if (is_kept && load(out, path, &key)) goto out;
    TRY(interrupt_check());
    TRY(bvh_build(out, source));
    if (is_kept) store(bvh_look(*out), folder, path, &key);
out:
    return rc;
}
