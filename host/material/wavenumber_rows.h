/* Wavenumber rows: the part that .ems and .ext files share, a value for each of their wavenumbers.
 * Appendix A items 7 and 8. */
#ifndef WAVENUMBER_ROWS_H
#define WAVENUMBER_ROWS_H

#include "files/record_file.h"

enum {
    WAVENUMBER_ROWS = 396, /* 39850, 39750, .. 350 cm-1: 0.25 to 29 um, ascending wavelength */
    WAVENUMBER_ROWS_FIRST_CM1 = 39850,
    WAVENUMBER_ROWS_STEP_CM1 = 100
};

/* Takes the rows, each a wavenumber and a value from 0 to `most`. Fails with STATUS_FORMAT.
 *   what   the value, for messages: "an emissivity"
 *   out    shape (WAVENUMBER_ROWS) */
status wavenumber_rows_read(record_file *file, const char *what, double most, double *out);

#endif
