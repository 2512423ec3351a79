/* Material plot: pictures of a material's emissivity. */
#ifndef MATERIAL_PLOT_H
#define MATERIAL_PLOT_H

#include "scene/scene.h"

/* Draws emissivity over wavelength along the normal and at 60 and 80 degrees, and over angle at 0.55, 4 and 10 um.
 *   spectrum_path, angle_path   PNG; NULL: not drawn */
status material_plot_write(const scene_material *m, const char *spectrum_path,
                           const char *angle_path);

#endif
