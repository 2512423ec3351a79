/* Render probe: the spectra of one pixel, every term of its radiance at the sensor, as a table and a
 * drawing. Thesis Figure 2.4.5-2. */
#ifndef RENDER_PROBE_H
#define RENDER_PROBE_H

#include "files/output_folder.h"
#include "render/render.h"

/* Writes NAME_probe_COLUMN_ROW.csv, a row per sample of each band, whose sum of weight_um times a
 * term is the pixel's plane of that term, and two drawings over wavelength: NAME_probe_COLUMN_ROW.png
 * and NAME_probe_COLUMN_ROW_transmission.png. The pixel must lie in the picture. */
status render_probe_write(output_folder *folder, const scene *s, render *r, uint32_t column,
                          uint32_t row);

#endif
