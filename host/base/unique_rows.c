#include "base/unique_rows.h"

#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

status unique_rows(const uint32_t *rows, size_t word_count, size_t count, uint32_t *out_group,
                   uint32_t *out_first, size_t *out_count)
{
    status rc = STATUS_OK;
    size_t size = 16, found = 0;
    uint32_t *table = NULL;

    while (size < 2 * count) size *= 2;
    /* A place holds the number of a kind plus 1; 0: free. */
    table = calloc(size, sizeof *table);
    NEED(table, STATUS_MEMORY, "no memory to compare %zu rows", count);
    for (size_t i = 0; i < count; i++) {
        const uint32_t *row = rows + i * word_count;
        size_t place = XXH3_64bits(row, word_count * sizeof *row) & (size - 1);
        while (table[place] && memcmp(rows + (size_t)out_first[table[place] - 1] * word_count, row,
                                      word_count * sizeof *row) != 0)
            place = (place + 1) & (size - 1);
        if (!table[place]) {
            out_first[found] = (uint32_t)i;
            table[place] = (uint32_t)++found;
        }
        out_group[i] = table[place] - 1;
    }
    *out_count = found;
out:
    free(table);
    return rc;
}
