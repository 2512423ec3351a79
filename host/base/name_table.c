#include "base/name_table.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

#define HASH_FUNCTION(key, size, hash) ((hash) = (unsigned)XXH3_64bits(key, size))
#define HASH_NONFATAL_OOM 1
#define uthash_nonfatal_oom(entry) (is_added = false)
#include <uthash.h>

typedef struct named {
    UT_hash_handle hh;
    uint32_t number;
    char key[]; /* the owner, then the name */
} named;

struct name_table {
    named *first;
};

status name_table_open(name_table **out)
{
    status rc = STATUS_OK;

    *out = calloc(1, sizeof **out);
    NEED(*out, STATUS_MEMORY, "no memory for names");
out:
    return rc;
}

void name_table_free(name_table *table)
{
    if (!table) return;
    for (named *at = table->first, *next; at; at = next) {
        next = at->hh.next;
        HASH_DEL(table->first, at);
        free(at);
    }
    free(table);
}

uint32_t name_table_count(const name_table *table)
{
    return HASH_COUNT(table->first);
}

status name_table_number(name_table *table, uint32_t owner, const char *name, uint32_t *out)
{
    status rc = STATUS_OK;
    const size_t length = strlen(name), size = sizeof owner + length;
    named *found, *made = malloc(sizeof *made + size);
    bool is_added = true;

    NEED(made, STATUS_MEMORY, "no memory for names");
    made->number = name_table_count(table);
    memcpy(made->key, &owner, sizeof owner);
    memcpy(made->key + sizeof owner, name, length);
    HASH_FIND(hh, table->first, made->key, size, found);
    *out = found ? found->number : made->number;
    if (found) goto out;
    HASH_ADD_KEYPTR(hh, table->first, made->key, size, made);
    NEED(is_added, STATUS_MEMORY, "no memory for names");
    made = NULL;
out:
    free(made);
    return rc;
}
