/* Scattering: how a transmissive material scatters what it takes from light: the table that
 * `radsig-atmosphere cloud` writes beside an .ext. Thesis 2.4.3. */
#ifndef SCATTERING_H
#define SCATTERING_H

#include "material/extinction.h"

/* On the wavenumbers of extinction. */
typedef struct scattering {
    double albedo[EXTINCTION_WAVENUMBERS]; /* single-scattering albedo, 0..1 */
    double
        asymmetry[EXTINCTION_WAVENUMBERS]; /* mean cosine of the angle of scattering, 0 to 0.99 */
} scattering;

/* Reads a .scattering.csv: leading '#' lines, a line that names the columns, then 396 rows of
 * wavenumber in cm-1, albedo and asymmetry. */
status scattering_read(scattering **out, const char *path);
void scattering_free(scattering *s);

#endif
