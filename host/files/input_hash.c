#include "files/input_hash.h"

#include "base/array.h"
#include "base/interrupt.h"
#include "base/name_table.h"
#include "meshio/input_file.h"

#include <errno.h>
#include <nettle/sha2.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { CHUNK = 1 << 16, PORTION = 1 << 24 };

typedef struct entry {
    input_hash hash;
    bool has_changed; /* between two readings */
} entry;

struct input_hashes {
    name_table *paths;
    entry *entry; /* shape (count), by the numbers of their paths */
    size_t count;
    bool is_short_of_memory;
};

static void finish(struct sha256_ctx *context, uint64_t bytes, input_hash *out)
{
    uint8_t digest[SHA256_DIGEST_SIZE];

    sha256_digest(context, sizeof digest, digest);
    for (size_t i = 0; i < sizeof digest; i++) sprintf(out->sha256 + 2 * i, "%02x", digest[i]);
    out->bytes = bytes;
}

static void take(void *self, const char *path, const void *bytes, size_t size)
{
    input_hashes *h = self;
    struct sha256_ctx context;
    input_hash hash;
    uint32_t number;

    sha256_init(&context);
    for (size_t at = 0; at < size; at += PORTION) {
        const size_t portion = size - at < PORTION ? size - at : PORTION;
        if (interrupt_is_set()) return; /* which ends the reading too */
        sha256_update(&context, portion, (const uint8_t *)bytes + at);
    }
    finish(&context, size, &hash);
    /* Room comes first, so that every path with a number has an entry. */
    if (!array_add(&h->entry, h->count, sizeof *h->entry) ||
        name_table_number(h->paths, 0, path, &number) != STATUS_OK) {
        h->is_short_of_memory = true;
    } else if (number == h->count) {
        h->entry[h->count++] = (entry){.hash = hash};
    } else {
        entry *e = &h->entry[number];
        e->has_changed |= strcmp(e->hash.sha256, hash.sha256) != 0;
    }
}

status input_hashes_open(input_hashes **out)
{
    status rc = STATUS_OK;
    input_hashes *h = calloc(1, sizeof *h);

    NEED(h, STATUS_MEMORY, "no memory for the hashes of inputs");
    TRY(name_table_open(&h->paths));
    input_file_observe(take, h);
    *out = h;
    h = NULL;
out:
    free(h);
    return rc;
}

void input_hashes_free(input_hashes *hashes)
{
    if (!hashes) return;
    input_file_observe(NULL, NULL);
    name_table_free(hashes->paths);
    free(hashes->entry);
    free(hashes);
}

static status hash_file(const char *path, input_hash *out)
{
    status rc = STATUS_OK;
    char message[1024];
    unsigned char chunk[CHUNK];
    struct sha256_ctx context;
    FILE *file = NULL;
    uint64_t bytes = 0;
    size_t got;

    NEED(!input_file_open(&file, NULL, path, SIZE_MAX, message, sizeof message), STATUS_FILE, "%s",
         message);
    sha256_init(&context);
    while ((got = fread(chunk, 1, sizeof chunk, file)) > 0) {
        TRY(interrupt_check());
        sha256_update(&context, got, chunk);
        bytes += got;
    }
    NEED(!ferror(file), STATUS_FILE, "%s: cannot be read: %s", path, strerror(errno));
    finish(&context, bytes, out);
out:
    if (file) fclose(file);
    return rc;
}

status input_hashes_find(input_hashes *hashes, const char *path, input_hash *out)
{
    status rc = STATUS_OK;
    uint32_t number;

    NEED(!hashes->is_short_of_memory, STATUS_MEMORY, "%s: no memory for its hash", path);
    TRY(name_table_number(hashes->paths, 0, path, &number));
    if (number == hashes->count) {
        NEED(array_add(&hashes->entry, number, sizeof *hashes->entry), STATUS_MEMORY,
             "%s: no memory for its hash", path);
        hashes->entry[hashes->count++] = (entry){.has_changed = false};
        TRY(hash_file(path, &hashes->entry[number].hash));
    }
    NEED(!hashes->entry[number].has_changed, STATUS_FILE,
         "%s: found other contents when it was read again, expected the same", path);
    *out = hashes->entry[number].hash;
out:
    return rc;
}
