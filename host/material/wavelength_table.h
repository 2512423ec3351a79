/* Wavelength table: quantities over the wavelengths of a CSV, on a grid of their own. */
#ifndef WAVELENGTH_TABLE_H
#define WAVELENGTH_TABLE_H

#include "files/record_file.h"
#include "spectrum/wavelength_grid.h"

/* A column beside the wavelengths. */
typedef struct wavelength_table_column {
    const char *name; /* of its heading, and for messages */
    double low, high; /* what it may be */
} wavelength_table_column;

/* Reads a table: `wavelength_um`, `wavelength_nm` or `wavenumber_cm1`, then the columns, rising or falling, 3 rows or
 * more. Rows on the wavenumbers of an .ext give their even grid.
 *   out_value   shape (count) per column: pointers to arrays that the caller frees, set when all is read
 * Fails with STATUS_FORMAT and `path:line`. */
status wavelength_table_read(wavelength_grid *out_grid, double **out_value, record_file *file,
                             const wavelength_table_column *column, size_t column_count);

#endif
