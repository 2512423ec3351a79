/* Array: items in memory that grows. */
#ifndef ARRAY_H
#define ARRAY_H

#include <stdbool.h>
#include <stddef.h>

/* Makes room for `count` items; false without memory, and the array is as it was.
 *   array   the address of the pointer to the items, whatever their type; it may point to NULL */
bool array_resize(void *array, size_t count, size_t item_size);

/* Makes room for one item behind the `count` that were added so, in constant time on average. */
bool array_add(void *array, size_t count, size_t item_size);

#endif
