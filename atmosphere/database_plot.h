/* Database plot: pictures of what a radiance database holds. Thesis Figures 2.4.5-1, 2.4.1-2 and
 * 2.4.1-3. */
#ifndef DATABASE_PLOT_H
#define DATABASE_PLOT_H

#include "sky/atmosphere.h"

/* Writes STEM_sun.png (E_S), STEM_tau.png (tau1, tau2), STEM_path.png (L_uE, L_uS), STEM_sky.png
 * (L_DE, L_DS integrated), all by wavelength, the paths at the first, middle and last angle; and
 * STEM_emitted.png and STEM_scattered.png, the sky by direction. Pictures without any light are left
 * out. Fails with STATUS_ARGUMENT where the database holds one wavelength, with STATUS_FILE where a
 * file or the font cannot be opened. */
status database_plot_write(const atmosphere *a, const char *stem);

#endif
