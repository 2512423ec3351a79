#include "base/array.h"

#include <stdlib.h>
#include <string.h>

bool array_resize(void *array, size_t count, size_t item_size)
{
    void *items, *larger;

    memcpy(&items, array, sizeof items);
    larger = reallocarray(items, count, item_size);
    if (larger) memcpy(array, &larger, sizeof larger);
    return larger != NULL;
}

/* There is room for the next power of two. */
bool array_add(void *array, size_t count, size_t item_size)
{
    return (count & (count - 1)) || array_resize(array, count ? 2 * count : 1, item_size);
}
