/* Spectrum file: readers of the layouts that spectra come in; spectral_curve_read chooses among them. Each takes an open
 * file at its begin, and fails as spectral_curve_read does. */
#ifndef SPECTRAL_FILE_H
#define SPECTRAL_FILE_H

#include "files/record_file.h"
#include "spectrum/spectral_curve.h"

/* ECOSTRESS and ASTER, JHU and JPL: `Key: value` lines, then X and Y. */
bool ecostress_file_begins(const char *line);
status ecostress_file_read(spectral_curve **out, record_file *file, const char *path);

/* USGS splib07: a title line, then a value a line; wavelengths in a file of their own. */
bool splib_file_begins(const char *line);
status splib_file_read(spectral_curve **out, record_file *file, const spectral_source *source);

/* Spectra Vista's .sig: `key= value` lines, `data=`, then wavelength, reference, target, reflectance. */
bool svc_file_begins(const char *line);
status svc_file_read(spectral_curve **out, record_file *file, const char *path);

/* refractiveindex.info: YAML with `type: tabulated nk`. */
status refractive_index_file_read(spectral_curve **out, record_file *file, const char *path);

/* CSV: a wavelength, and emissivity, reflectance, reflectance_percent, transmittance, or n and k. */
status spectral_table_read(spectral_curve **out, record_file *file, const char *path);

/* ENVI spectral library: a header of text, and a binary file of a record a line; either names it. */
status envi_library_read(spectral_curve **out, const spectral_source *source);

#endif
