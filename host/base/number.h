/* Number: what a text says if it is a number, or a list of them, and nothing else. Numbers are
 * decimal: `nan`, `inf` and hexadecimal digits are none, and a value that overflows is refused. */
#ifndef NUMBER_H
#define NUMBER_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Takes the number that the text begins with. Returns what follows it, or NULL. */
const char *number_take(const char *text, double *out);

/* Takes a whole number, digits behind at most one sign, from low to high. Returns what follows, or
 * NULL. */
const char *number_take_whole(const char *text, int64_t low, int64_t high, int64_t *out);

/* Each returns true if the whole text is that; *out is set only then. */
bool number_read(const char *text, double *out);
bool number_read_whole(const char *text, int64_t low, int64_t high, int64_t *out);

/* Exactly `count` numbers with commas between; blanks around them are allowed. *out may be set in
 * part. */
bool number_read_list(const char *text, size_t count, double *out);

/* COLUMNSxROWS, each at least 0, the product at most 2^31 - 1. */
bool number_read_size(const char *text, uint32_t *out_columns, uint32_t *out_rows);

#endif
