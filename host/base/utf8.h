/* UTF-8: characters of a text, RFC 3629. */
#ifndef UTF8_H
#define UTF8_H

#include <stddef.h>
#include <stdint.h>

/* Bytes of the character that a text begins with, and its code; 0 if none does. */
size_t utf8_length(const char *text, uint32_t *out_code);

/* Writes a character of a code up to 0x10ffff, at most four bytes, without a zero behind it; returns how
 * many. */
size_t utf8_write(char *out, uint32_t code);

#endif
