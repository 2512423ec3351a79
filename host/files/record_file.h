/* Record file: reads text files of one record a line, as the thesis' formats are (Appendix A), and
 * tells file and line of what is wrong. */
#ifndef RECORD_FILE_H
#define RECORD_FILE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct record_file record_file;

/* Reads the whole file, as UTF-8 with line feeds whatever it was (text_encoding.h). Fails with STATUS_FILE if it cannot be opened (input_file.h), or holds a zero byte (a binary file). */
status record_file_open(record_file **out, const char *path);
void record_file_free(record_file *file);

/* True when only blank lines are left. */
bool record_file_at_end(const record_file *file);

/* Takes the next line, blanks at both ends removed; blank lines are passed over.
 *   out_text   belongs to the file, valid until it is freed
 *   expected   what should stand there, for the message: "a material name"
 * All of the following fail with STATUS_FORMAT and `path:line: ... expected ...`. */
status record_file_text(record_file *file, const char **out_text, const char *expected);

/* Takes leading lines that start with '#', a file's header.
 *   out_text   each line with its line end, "" if there are none; the caller frees it; NULL: dropped
 * Fails with STATUS_MEMORY. */
status record_file_header(record_file *file, char **out_text);

/* Column of the first character of the line that was taken last, from 0: the blanks before it. */
size_t record_file_column(const record_file *file);

/* Looks at the next line without taking it; NULL at the end. */
const char *record_file_peek(record_file *file);

/* Takes a line that holds exactly `count` numbers. Numbers are told apart by their pattern, so
 * `0.00-15.00` are two; commas and blanks separate. */
status record_file_numbers(record_file *file, size_t count, double *out, const char *expected);

/* Takes a line that holds one number from low to high. */
status record_file_number(record_file *file, double low, double high, double *out,
                          const char *expected);

/* Takes a line that holds one whole number from low to high. */
status record_file_count(record_file *file, long low, long high, long *out, const char *expected);

/* Sets a failure at the line that was taken last: `path:line: found 'text', expected ...`.
 */
__attribute__((format(printf, 2, 3))) status record_file_reject(const record_file *file,
                                                                const char *expected, ...);

/* True unless the last line has no line end, as in a file that is cut. */
bool record_file_is_whole(const record_file *file);

/* Fails unless only blank lines are left. */
status record_file_finish(record_file *file);

/* Number of the line that was taken last, from 1. */
int record_file_line(const record_file *file);

/* Where a text begins behind a byte order mark of UTF-8, if it has one. */
const char *record_text_begin(const char *text);

/* Finds up to `limit` numbers in a text; returns how many it holds, or -1 where something else
 * than numbers, blanks and commas stands. Not-a-number and infinity do not count as numbers. */
int record_numbers(const char *text, size_t limit, double *out);

#endif
