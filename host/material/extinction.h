/* Extinction: what a transmissive material takes from light. Appendix A item 8 (.ext), eq. 2.4.3-3.
 */
#ifndef EXTINCTION_H
#define EXTINCTION_H

#include "material/wavenumber_rows.h"

enum {
    EXTINCTION_WAVENUMBERS = WAVENUMBER_ROWS,
    EXTINCTION_FIRST_CM1 = WAVENUMBER_ROWS_FIRST_CM1,
    EXTINCTION_STEP_CM1 = WAVENUMBER_ROWS_STEP_CM1
};

/* Transmission over z metres: exp(-value z). */
typedef struct extinction {
    double broad_band_per_m; /* 0.4 to 2.5 um, for insolation */
    double per_m[EXTINCTION_WAVENUMBERS];
} extinction;

/* Reads an .ext file, which is per km; leading lines that start with '#' are passed over. */
status extinction_read(extinction **out, const char *path);
void extinction_free(extinction *e);

/* Value at a wavenumber of a table on extinction's wavenumbers: linear, the last value beyond the
 * ends.
 *   table   shape (EXTINCTION_WAVENUMBERS) */
double extinction_between(const double *table, double wavenumber_cm1);

#endif
