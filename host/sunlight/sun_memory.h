/* Sun memory: what rays towards a day's suns met, kept so that images of several times of one day
 * trace each sun once. */
#ifndef SUN_MEMORY_H
#define SUN_MEMORY_H

#include "base/status.h"
#include "kernels/records.h"

#include <stddef.h>
#include <stdint.h>

typedef struct sun_memory sun_memory;

/* What is known of some points. */
typedef struct sun_memory_entry {
    long last;     /* the step that the bits end with; SUN_MEMORY_NOTHING: none are there yet */
    uint32_t *lit; /* shape (count, words) as sun_history tells them */
} sun_memory_entry;

#define SUN_MEMORY_NOTHING (-1L)

status sun_memory_open(sun_memory **out);
void sun_memory_free(sun_memory *memory);

/* Finds the entry of points, or makes one; it belongs to the memory. Points are told by what they
 * hold, whatever the order in which they come.
 *   hit     shape (count)
 *   words   of a point */
status sun_memory_find(sun_memory *memory, const hit_record *hit, uint32_t count, uint32_t words,
                       sun_memory_entry **out);

#endif
