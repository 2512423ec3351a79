/* Tape7: the spectral table of MODTRAN's own output (tape7, .tp7, .7sc). Berk and others (1989). */
#ifndef TAPE7_H
#define TAPE7_H

#include "base/status.h"

typedef struct tape7 {
    int count;
    double *wavenumber_cm1; /* shape (count), ascending */
    /* shape (count); NULL: the file has no such column. Per um: W m-2 sr-1 um-1, W m-2 um-1 */
    double *transmission, *emitted, *scattered, *solar;
} tape7;

/* Reads the first table of a file. Its columns are found by their names, blanks or underscores in
 * them: FREQ, TOT TRANS (or TRANS), PTH THRML, SOL SCAT, SOLAR. Fails with STATUS_FORMAT without
 * such a head, or where wavenumbers do not rise evenly. */
status tape7_read(tape7 **out, const char *path);
void tape7_free(tape7 *t);

#endif
