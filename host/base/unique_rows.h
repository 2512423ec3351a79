/* Unique rows: finds the rows of a table that are equal, so that each is worked out once. */
#ifndef UNIQUE_ROWS_H
#define UNIQUE_ROWS_H

#include "base/status.h"

#include <stddef.h>
#include <stdint.h>

/* Numbers the unique rows in the order of their first appearance.
 *   rows        shape (count, word_count); equal is bit by bit
 *   out_group   shape (count): the number of each row's kind
 *   out_first   shape (count): the first row of each kind; *out_count entries are set
 * Fails with STATUS_MEMORY. */
status unique_rows(const uint32_t *rows, size_t word_count, size_t count, uint32_t *out_group,
                   uint32_t *out_first, size_t *out_count);

#endif
