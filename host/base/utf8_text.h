/* UTF-8 text: characters of names that files state. What is not UTF-8 is Latin-1, so that a name is the same
 * in whichever of both a file was written. */
#ifndef UTF8_TEXT_H
#define UTF8_TEXT_H

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* Bytes of the UTF-8 character that a text begins with, and its code; 0 if none does: RFC 3629. */
size_t utf8_text_character(const char *text, uint32_t *out_code);

bool utf8_text_is_valid(const char *text);

/* A copy of a text, or of a text in Latin-1 what it says in UTF-8; the caller frees it. NULL without memory. */
char *utf8_text_copy(const char *text);

#endif
