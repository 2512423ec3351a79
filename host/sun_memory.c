#include "sun_memory.h"

#include <stdlib.h>

/* Points are told by a sum over their bytes and by their number. */
typedef struct kept_points {
    uint64_t key;
    uint32_t count, words;
    sun_memory_entry entry;
    struct kept_points *next;
} kept_points;

struct sun_memory {
    kept_points *first;
};

/* FNV-1a, 64 bits, of 32-bit words. */
static uint64_t key_of(const hit_record *hit, uint32_t count)
{
    const uint32_t *word = (const uint32_t *)hit;
    const size_t words = count * (sizeof *hit / sizeof *word);
    uint64_t key = 14695981039346656037u;

    for (size_t i = 0; i < words; i++) key = (key ^ word[i]) * 1099511628211u;
    return key;
}

status sun_memory_open(sun_memory **out)
{
    status rc = STATUS_OK;

    *out = calloc(1, sizeof **out);
    NEED(*out, STATUS_MEMORY, "no memory for the sun's day");
out:
    return rc;
}

void sun_memory_free(sun_memory *memory)
{
    if (!memory) return;
    for (kept_points *at = memory->first, *next; at; at = next) {
        next = at->next;
        free(at->entry.lit);
        free(at);
    }
    free(memory);
}

status sun_memory_find(sun_memory *memory, const hit_record *hit, uint32_t count, uint32_t words,
                       sun_memory_entry **out)
{
    status rc = STATUS_OK;
    const uint64_t key = key_of(hit, count);
    kept_points *made = NULL;

    for (kept_points *at = memory->first; at; at = at->next) {
        if (at->key != key || at->count != count || at->words != words) continue;
        *out = &at->entry;
        return STATUS_OK;
    }
    made = calloc(1, sizeof *made);
    NEED(made, STATUS_MEMORY, "no memory for the sun's day of %u points", count);
    made->entry.lit = malloc((size_t)count * words * sizeof *made->entry.lit);
    NEED(made->entry.lit, STATUS_MEMORY, "no memory for the sun's day of %u points", count);
    made->entry.last = SUN_MEMORY_NOTHING;
    made->key = key;
    made->count = count;
    made->words = words;
    made->next = memory->first;
    memory->first = made;
    *out = &made->entry;
    made = NULL;
out:
    if (made) free(made->entry.lit);
    free(made);
    return rc;
}
