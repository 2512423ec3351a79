/* Heading: fields of the line of names above a table. */
#ifndef HEADING_H
#define HEADING_H

#include <stdbool.h>
#include <stddef.h>

/* Splits a field of a header, `name [unit]`, `name (unit)` or `name`, into its name and its unit ("": not
 * stated), blanks around them removed. False where it is longer than `size` or has no name. */
bool heading_split(const char *field, size_t size, char *out_name, char *out_unit);

/* Whether a name is one of those between bars, as `|temp_air|Dry-bulb|`; capitals, blanks, hyphens and
 * underscores do not matter. */
bool heading_is_named(const char *name, const char *names);

#endif
