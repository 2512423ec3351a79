/* Wavelength column: a column of wavelengths or wavenumbers in a text table. */
#ifndef WAVELENGTH_COLUMN_H
#define WAVELENGTH_COLUMN_H

#include "files/unit.h"

#include <stdbool.h>

/* The unit in the heading of such a column: `wavelength_um`, `Wavelength [nm]`, `wavenumber (cm-1)`; NULL for other
 * names, and where none is stated. */
const unit *wavelength_column_unit(const char *field);

/* Whether it counts wavenumbers. */
bool wavelength_column_is_number(const unit *of);

/* A value of the column as a wavelength in um. */
double wavelength_column_um(const unit *of, double value);

#endif
