/* Tape7: the spectral table of MODTRAN's own output (tape7, .tp7, .7sc). Berk and others (1989). */
#ifndef TAPE7_H
#define TAPE7_H

#include "base/status.h"

#include <stdbool.h>

typedef struct tape7 {
    int count;
    double *wavenumber_cm1; /* shape (count), ascending */
    /* shape (count); NULL: the file has no such column. Per um: W m-2 sr-1 um-1, W m-2 um-1 */
    double *transmission, *emitted, *scattered, *solar;
    bool is_emitted_blank, is_scattered_blank; /* not computed by the run, and 0 */
} tape7;

/* Reads the table of one run, as versions 3 to 6 write it for each IEMSCT and IMULT. Its columns are found
 * by their names, blanks or underscores in them (FREQ, TOT TRANS, PTH THRML, SOL SCAT, SOLAR), and numbers
 * by the places below them (tape7_head.h). Filtered files by wavelength in um (WAVLEN MCRN), whose values are
 * per um, are put onto even wavenumbers, linear in wavelength between their rows.
 *   run   counted from 1; 0: the file holds one run alone
 * Fails with STATUS_FORMAT without a head, where a column is blank in some rows alone, where wavenumbers do
 * not rise evenly, and with a list of the runs where there are several and none is named. A file that does
 * not end as MODTRAN's do is a warning. */
status tape7_read(tape7 **out, const char *path, int run);
void tape7_free(tape7 *t);

#endif
