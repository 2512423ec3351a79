/* Wavenumber rows: the part that .ems and .ext files share, a value for each of their wavenumbers.
 * Appendix A items 7 and 8. */
#ifndef WAVENUMBER_ROWS_H
#define WAVENUMBER_ROWS_H

#include "files/record_file.h"
#include "spectrum/wavelength_grid.h"

enum {
    WAVENUMBER_ROWS = 396, /* 39850, 39750, .. 350 cm-1: 0.25 to 29 um, ascending wavelength */
    WAVENUMBER_ROWS_FIRST_CM1 = 39850,
    WAVENUMBER_ROWS_STEP_CM1 = 100
};

/* These wavenumbers; there is nothing in it to free. */
wavelength_grid wavenumber_rows_grid(void);

/* What a value is, and how far it reaches. */
typedef struct wavenumber_value {
    const char *what; /* for messages: "an emissivity" */
    double most;      /* values are 0 .. most */
    double noise;     /* a measurement goes so far beyond; it is cut there */
} wavenumber_value;

/* Takes the rows, each a wavenumber and a value. Fails with STATUS_FORMAT.
 *   out             shape (WAVENUMBER_ROWS)
 *   out_cut_count   grows by the values that were noise */
status wavenumber_rows_read(record_file *file, const wavenumber_value *value, double *out,
                            size_t *out_cut_count);

#endif
