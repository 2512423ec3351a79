/* Tape7 head: what the columns of a table of MODTRAN hold, and which numbers of a row stand in them. The
 * tables are Fortran's: a column that a run does not compute is blank. */
#ifndef TAPE7_HEAD_H
#define TAPE7_HEAD_H

#include <stdbool.h>

enum { TAPE7_COLUMNS = 64, TAPE7_NAME_SIZE = 48 };

typedef enum tape7_column {
    TAPE7_WAVENUMBER,
    TAPE7_TRANSMISSION,
    TAPE7_EMITTED,
    TAPE7_SCATTERED,
    TAPE7_SOLAR,
    TAPE7_WANTED
} tape7_column;

/* The characters of a line from begin to before end, counted from 0. */
typedef struct tape7_place {
    int begin, end;
} tape7_place;

typedef struct tape7_head {
    int count; /* columns */
    tape7_place at[TAPE7_COLUMNS];
    char name[TAPE7_COLUMNS][TAPE7_NAME_SIZE]; /* in capitals, without blanks and underscores */
    int column[TAPE7_WANTED];                  /* -1: none */
    bool has_wavelengths; /* a filtered file by wavelength, not by wavenumber */
} tape7_head;

/* Reads a line of names; false where it is none.
 *   column   of the text's first character */
bool tape7_head_read(tape7_head *out, const char *text, int column);

/* Reads the line after it, which in tables of transmissions holds the names' second halves; false where it
 * is another. */
bool tape7_head_add(tape7_head *head, const char *text, int column);

/* Finds the wanted numbers of a row by the places of their names, or by their order where the row has a
 * number for every name but other places. A blank column is NAN, numbers behind the last name are passed
 * over. Returns false where neither fits, where something is no number, or the first
 * column is blank. */
bool tape7_head_row(const tape7_head *head, const char *text, int column, double out[TAPE7_WANTED]);

/* The name of a wanted column. */
const char *tape7_column_name(tape7_column column);

#endif
