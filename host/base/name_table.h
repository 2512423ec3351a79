/* Name table: numbers of names, in the order of their first appearance, found in constant time. */
#ifndef NAME_TABLE_H
#define NAME_TABLE_H

#include "base/status.h"

#include <stdint.h>

typedef struct name_table name_table;

status name_table_open(name_table **out);
void name_table_free(name_table *table);

/* How many names there are. */
uint32_t name_table_count(const name_table *table);

/* Finds the number of a name within its owner, or gives it the next one: the count before the call.
 *   owner   what tells equal names apart, such as the number of a part's object
 * Fails with STATUS_MEMORY. */
status name_table_number(name_table *table, uint32_t owner, const char *name, uint32_t *out);

#endif
