/* Terminal text: names and lines of files as they may go to a terminal. A file's own bytes could move the
 * cursor, hide a message or forge one. */
#ifndef TERMINAL_TEXT_H
#define TERMINAL_TEXT_H

#include <stdbool.h>
#include <stddef.h>

/* Replaces, in place, every byte of a control character but tab and line feed, and every byte that does
 * not belong to UTF-8, by '?'. */
void terminal_text_clean(char *text);

/* True if a name can be shown as it is: nothing would be replaced, and it has no line feed. */
bool terminal_text_is_clean(const char *text);

/* Copies what fits of a text, cleaned; a line feed becomes '?' too. Returns out. */
const char *terminal_text_copy(char *out, size_t size, const char *text);

#endif
