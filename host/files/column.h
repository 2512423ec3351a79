/* Column: a quantity in a column of a text table: its names, unit and range, and what says that a value is
 * missing. Missing values, and those out of range, become not-a-number before anything is computed. */
#ifndef COLUMN_H
#define COLUMN_H

#include "base/status.h"
#include "files/record_file.h"
#include "files/unit.h"

#include <stdbool.h>
#include <stddef.h>

typedef struct column {
    const char *name, *unit; /* as messages have them; name NULL: no such column */
    int field;               /* where it stands in a table without names, from 0 */
    double low, high;        /* in that unit */
    bool is_missing_at_zero; /* 0 says that it was not measured */
} column;

/* Where a column stands in a file, and its unit there; column NULL: nowhere. */
typedef struct column_place {
    const column *column;
    const unit *usual, *unit; /* the column's, the file's */
    size_t field;
} column_place;

/* Values that were out of range, for one warning. */
typedef struct column_gaps {
    size_t count;
    char first[256];
} column_gaps;

/* The place of a column.
 *   here   its unit in the file; NULL: the column's */
column_place column_place_at(const column *c, const unit *here, size_t field);

/* Places of a table without names.
 *   out   shape (count): in the order of the columns */
void column_places(column_place *out, const column *columns, size_t count);

/* Whether a field says that there is no value: blank, a word such as `NA`, `NaN`, `null`,
 * or `-`, `*`, `/` and `.` alone, as `--` and `///`. */
bool column_is_blank(const char *text);

/* Reads a field in SI; not-a-number where it is missing: a blank one; a flag, which is out of range and
 * has no other digits than nines before its zeros (9999, 99.9, -999.0, -9900); and a value out of range,
 * which goes to `gaps`; and where the column stands nowhere.
 * Fails with STATUS_FORMAT, at the line that was taken last, if the field is neither blank nor a
 * number. */
status column_read(double *out, const column_place *place, const char *text,
                   const record_file *file, column_gaps *gaps);

/* The same of a number; does not fail. */
double column_value(const column_place *place, double number, const record_file *file,
                    column_gaps *gaps);

/* Warns of the values that were out of range, if there are any. */
void column_gaps_tell(const column_gaps *gaps, const char *path);

#endif
