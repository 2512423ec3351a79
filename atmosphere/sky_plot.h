/* Sky plot: the sky's radiance by direction as a disc, drawn for people as a PNG. Thesis Figures
 * 2.4.1-2 and 2.4.1-3. */
#ifndef SKY_PLOT_H
#define SKY_PLOT_H

#include "sky/atmosphere.h"

/* Draws directional radiance integrated over the wavelengths: the zenith in the middle, the horizon
 * at the rim, north on top, azimuths clockwise, bilinear between the directions (eq. 2.4.1-1..3).
 * The colours are logarithmic where the highest value is more than five times the lowest.
 *   direction   sky_emitted_direction or sky_scattered_direction of the database
 * Fails with STATUS_FILE where the file or the font cannot be opened. */
status sky_plot_write(const char *path, const char *title, const atmosphere *a,
                      const double *direction);

#endif
