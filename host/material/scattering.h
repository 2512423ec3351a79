/* Scattering: how a transmissive material scatters what it takes from light: the table that
 * `radsig-atmosphere cloud` writes beside an .ext. Thesis 2.4.3. */
#ifndef SCATTERING_H
#define SCATTERING_H

#include "spectrum/wavelength_grid.h"

typedef struct scattering {
    wavelength_grid grid;
    double *albedo;    /* shape (grid.count): single-scattering albedo, 0..1 */
    double *asymmetry; /* shape (grid.count): mean cosine of the angle of scattering, 0 to 0.99 */
} scattering;

/* Reads a .scattering.csv (wavelength_table.h): leading '#' lines, then wavelengths, single_scattering_albedo and
 * asymmetry. */
status scattering_read(scattering **out, const char *path);
void scattering_free(scattering *s);

#endif
