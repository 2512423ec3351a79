/* Input hash: SHA-256 of files, of the bytes that were used: while it is open, everything that this
 * thread reads is hashed as it is read (meshio/input_file.h). */
#ifndef INPUT_HASH_H
#define INPUT_HASH_H

#include "base/status.h"

#include <stdint.h>

typedef struct input_hash {
    char sha256[65]; /* hexadecimal digits */
    uint64_t bytes;
} input_hash;

typedef struct input_hashes input_hashes;

/* Begins to hash; one at a time in a thread. */
status input_hashes_open(input_hashes **out);

/* Ends it. */
void input_hashes_free(input_hashes *hashes);

/* The hash of a file under the path by which it was read; one that was not is read for it. Fails with
 * STATUS_FILE if it was read more than once and was not the same each time. */
status input_hashes_find(input_hashes *hashes, const char *path, input_hash *out);

#endif
