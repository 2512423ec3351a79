/* Text encoding: texts of files as UTF-8 with line feeds, whatever program wrote them. */
#ifndef TEXT_ENCODING_H
#define TEXT_ENCODING_H

#include "base/status.h"

#include <stddef.h>

/* Turns a text into UTF-8 without a byte order mark, whose lines end with a line feed, with or without a
 * carriage return before it.
 *   UTF-16           where a byte order mark says so
 *   Latin-1          bytes that belong to no character of UTF-8, as the characters of Windows-1252
 *   lone returns     line ends of old, become line feeds
 * `*text` has a zero behind its `*size` bytes, before and after; another one may take its place. One with zeros among
 * them stays as it is, unless it is UTF-16. Fails with STATUS_MEMORY. */
status text_encoding_unify(char **text, size_t *size);

#endif
