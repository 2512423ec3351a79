/* CSV row: the fields of a line of separated values, for every table by one rule: RFC 4180, and what
 * spreadsheets and people make of it. */
#ifndef CSV_ROW_H
#define CSV_ROW_H

#include "base/status.h"
#include "files/record_file.h"

#include <stddef.h>

typedef struct csv_row {
    size_t count;
    size_t width; /* empty fields at the end counted too */
    char **field; /* shape (count) */
    char *text;   /* what they lie in */
    size_t size;
} csv_row;

/* The character that separates a line's fields: whichever of comma, semicolon and tab stands there most,
 * outside quotes; a comma where none does. */
char csv_separator(const char *line);

/* Takes the line of names above a table's rows, and tells what separates its fields; lines that begin with `#`
 * and a spreadsheet's `sep=;` before it are passed over. Fails as csv_row_take does. */
status csv_row_names(csv_row *row, record_file *file, char *out_separator, const char *expected);

/* Takes the next line apart. Blanks around a field go, quotes around it too, a doubled quote inside them
 * is one; a quote that nothing closes stands for itself; empty fields at the end of the line are not
 * counted. Where semicolons or tabs separate, a comma between digits is a decimal point.
 *   separator   a comma, a semicolon or a tab
 * Fails as record_file_text does, and with STATUS_MEMORY. */
status csv_row_take(csv_row *row, record_file *file, char separator, const char *expected);

/* The same of a line of text without its end. */
status csv_row_split(csv_row *row, const char *line, char separator);

/* Fails, at the line that was taken last, where a row has fewer fields than a table has names, blank ones
 * counted, or more that are not blank: a row that is cut, or one whose decimal commas separate. */
status csv_row_check(const csv_row *row, size_t names, const record_file *file);

/* The field at a place, "" behind the last. */
const char *csv_row_field(const csv_row *row, size_t place);

void csv_row_free(csv_row *row);

#endif
