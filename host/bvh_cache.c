#include "bvh_cache.h"

#include "output_file.h"

#include <fcntl.h>
#include <sha2.h>
#include <stdbool.h>
#include <stddef.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

enum { PATH_SIZE = 4096, KEY_SIZE = 32 };

/* What a file begins with; nodes and blocks follow. Numbers are in the machine's order. */
typedef struct header {
    char magic[8];
    uint8_t key[KEY_SIZE];
    uint32_t node_count, block_count, triangle_count;
    float low[3], high[3];
    uint32_t unused;
    uint64_t check; /* of all else */
} header;

_Static_assert(sizeof(header) == 88, "a header has no gaps");

static const char magic[8] = "radsigT";

/* What the tree is built over, and how. */
static void make_key(uint8_t out[KEY_SIZE], const bvh_source *source)
{
    const uint32_t form[] = {BVH_LAYOUT,          sizeof(bvh_node),     sizeof(bvh_block),
                             source->facet_count, source->vertex_count, source->two_sided != NULL,
                             0x01020304};
    uint8_t digest[SHA512_DIGEST_LENGTH];
    SHA2_CTX context;

    SHA512Init(&context);
    SHA512Update(&context, (const uint8_t *)form, sizeof form);
    SHA512Update(&context, (const uint8_t *)source->corner,
                 source->facet_count * sizeof *source->corner);
    SHA512Update(&context, (const uint8_t *)source->position,
                 source->vertex_count * sizeof *source->position);
    if (source->two_sided) SHA512Update(&context, source->two_sided, source->facet_count);
    SHA512Final(digest, &context);
    memcpy(out, digest, KEY_SIZE);
}

/* Finds damage, not malice. */
static uint64_t check_of(const header *h, const bvh_tables *t)
{
    uint64_t check = XXH3_64bits(h, offsetof(header, check));

    check = XXH3_64bits_withSeed(t->node, t->node_count * sizeof *t->node, check);
    return XXH3_64bits_withSeed(t->block, t->block_count * sizeof *t->block, check);
}

static off_t file_size(const header *h)
{
    return (off_t)(sizeof *h + h->node_count * sizeof(bvh_node) +
                   h->block_count * sizeof(bvh_block));
}

/* Writes the folder's path and makes the folder; false where there is none to be had. */
static bool find_folder(char out[PATH_SIZE])
{
    const char *cache = getenv("XDG_CACHE_HOME"), *home = getenv("HOME");
    const bool is_stated =
        cache && cache[0] == '/'; /* others are to be ignored, says its standard */
    const int length = snprintf(out, PATH_SIZE, "%s%s/radsig",
                                is_stated ? cache
                                : home    ? home
                                          : "",
                                is_stated ? "" : "/.cache");

    if ((!is_stated && !(home && home[0] == '/')) || length >= PATH_SIZE) return false;
    for (char *end = out + 1; end; end = strchr(end + 1, '/')) {
        if (*end != '/') continue;
        *end = '\0';
        mkdir(out, 0700);
        *end = '/';
    }
    mkdir(out, 0700);
    return access(out, X_OK) == 0;
}

static bool find_file(char out[PATH_SIZE], const uint8_t key[KEY_SIZE])
{
    char folder[PATH_SIZE], name[2 * KEY_SIZE + 1];

    if (!find_folder(folder)) return false;
    for (int i = 0; i < KEY_SIZE; i++) snprintf(name + 2 * i, 3, "%02x", key[i]);
    return snprintf(out, PATH_SIZE, "%s/%s.tree", folder, name) < PATH_SIZE;
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
    const bool is_whole = fread(node, sizeof *node, h->node_count, file) == h->node_count &&
                          fread(block, sizeof *block, h->block_count, file) == h->block_count &&
                          check_of(h, bvh_look(tree)) == h->check;
    if (is_whole)
        *out = tree;
    else
        bvh_free(tree);
    return is_whole;
}

static bool load(bvh **out, const char *path, const uint8_t key[KEY_SIZE])
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
                         !memcmp(h.key, key, KEY_SIZE) && found.st_size == file_size(&h) &&
                         read_tree(out, file, &h);
    fclose(file);
    return is_ours;
}

static bool write_tree(FILE *file, const header *h, const bvh_tables *t)
{
    return fwrite(h, sizeof *h, 1, file) == 1 &&
           fwrite(t->node, sizeof *t->node, t->node_count, file) == t->node_count &&
           fwrite(t->block, sizeof *t->block, t->block_count, file) == t->block_count;
}

/* Others see a whole file or none. */
static void store(const bvh_tables *t, const char *path, const uint8_t key[KEY_SIZE])
{
    header h = {.node_count = t->node_count,
                .block_count = t->block_count,
                .triangle_count = t->triangle_count};
    output_file *file = NULL;

    memcpy(h.magic, magic, sizeof magic);
    memcpy(h.key, key, KEY_SIZE);
    memcpy(h.low, t->low, sizeof h.low);
    memcpy(h.high, t->high, sizeof h.high);
    h.check = check_of(&h, t);
    if (output_file_open(&file, path) != STATUS_OK) return;
    if (write_tree(output_file_stream(file), &h, t)) output_file_commit(file);
    output_file_free(file);
}

status bvh_cache_build(bvh **out, const bvh_source *source)
{
    status rc = STATUS_OK;
    uint8_t key[KEY_SIZE];
    char path[PATH_SIZE];
    bool is_kept = source->facet_count >= BVH_CACHE_LEAST;

    if (is_kept) {
        make_key(key, source);
        is_kept = find_file(path, key);
    }
    if (is_kept && load(out, path, key)) goto out;
    TRY(bvh_build(out, source));
    if (is_kept) store(bvh_look(*out), path, key);
out:
    return rc;
}
