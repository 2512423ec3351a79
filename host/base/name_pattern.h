/* Name pattern: patterns of names as file names have them, by characters of UTF-8, in time that grows with the
 * product of their lengths (fnmatch takes exponential time, and bytes for characters). */
#ifndef NAME_PATTERN_H
#define NAME_PATTERN_H

#include <stdbool.h>

/* Whether a name fits a pattern: `*` any characters, `?` one, `[a-c]` one of these and `[!a-c]` none of them,
 * a backslash takes the meaning of what follows. A `[` that nothing closes stands for itself. */
bool name_pattern_fits(const char *pattern, const char *name);

#endif
