#include "sunlight/sun_memory.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

typedef struct kept_points {
    uint64_t key; /* tells most others apart */
    hit_record *hit;
    uint32_t count, words;
    sun_memory_entry entry;
    struct kept_points *next;
} kept_points;

struct sun_memory {
    kept_points *first;
};

static void free_points(kept_points *points)
{
    if (!points) return;
    free(points->entry.lit);
    free(points->hit);
    free(points);
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
        free_points(at);
    }
    free(memory);
}

status sun_memory_find(sun_memory *memory, const hit_record *hit, uint32_t count, uint32_t words,
                       sun_memory_entry **out)
{
    status rc = STATUS_OK;
    const size_t bytes = count * sizeof *hit;
    const uint64_t key = XXH3_64bits(hit, bytes);
    kept_points *made = NULL;

    for (kept_points *at = memory->first; at; at = at->next) {
        if (at->key != key || at->count != count || at->words != words) continue;
        if (memcmp(at->hit, hit, bytes) != 0) continue;
        *out = &at->entry;
        return STATUS_OK;
    }
    made = calloc(1, sizeof *made);
    NEED(made, STATUS_MEMORY, "no memory for the sun's day of %u points", count);
    *made = (kept_points){.key = key, .count = count, .words = words, .next = memory->first};
    made->hit = malloc(bytes);
    made->entry.lit = malloc((size_t)count * words * sizeof *made->entry.lit);
    NEED(made->hit && made->entry.lit, STATUS_MEMORY, "no memory for the sun's day of %u points",
         count);
    memcpy(made->hit, hit, bytes);
    made->entry.last = SUN_MEMORY_NOTHING;
    memory->first = made;
    *out = &made->entry;
    made = NULL;
out:
    free_points(made);
    return rc;
}
