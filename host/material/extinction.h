/* Extinction: what a transmissive material takes from light. Appendix A item 8 (.ext), eq. 2.4.3-3.
 */
#ifndef EXTINCTION_H
#define EXTINCTION_H

#include "material/wavenumber_rows.h"

/* Transmission over z metres: exp(-value z). */
typedef struct extinction {
    double broad_band_per_m; /* 0.4 to 2.5 um, for insolation; not-a-number: the file has none */
    wavelength_grid grid;
    double *per_m; /* shape (grid.count) */
} extinction;

/* Reads an .ext file, or a CSV of wavelengths and extinction_per_km (wavelength_table.h); both are per km. Leading lines
 * that start with '#' are passed over. */
status extinction_read(extinction **out, const char *path);
void extinction_free(extinction *e);

#endif
