/* Wavelength grid: the wavelengths of a table as its file has them, and where a value lies between them. */
#ifndef WAVELENGTH_GRID_H
#define WAVELENGTH_GRID_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>

/* How values run from a point to the next: straight over what the file counts in. */
typedef enum wavelength_link {
    WAVELENGTH_LINK_UM,
    WAVELENGTH_LINK_CM1,
    WAVELENGTH_LINK_GAP /* nothing was measured between */
} wavelength_link;

typedef struct wavelength_grid {
    size_t count;               /* 2 or more */
    double *wavelength_um;      /* shape (count), ascends; NULL: even in wavenumber */
    wavelength_link *link;      /* shape (count), the last unused; NULL likewise */
    double first_cm1, step_cm1; /* of an even one, which descends; unused otherwise */
} wavelength_grid;

/* Between point `low` and the next. */
typedef struct wavelength_place {
    size_t low;
    double fraction; /* of the next, 0..1; at the ends beyond them */
} wavelength_place;

/* Allocates both arrays; the caller fills them. Fails with STATUS_MEMORY. */
status wavelength_grid_make(wavelength_grid *out, size_t count);
void wavelength_grid_free(wavelength_grid *grid);

/* Finds a wavenumber; beyond the ends, and a tenth of a wavelength into gaps that are wider than two, the place is that of the end. */
wavelength_place wavelength_grid_find(const wavelength_grid *grid, double wavenumber_cm1);

/* A table's value at a wavenumber.
 *   value   shape (grid->count) */
double wavelength_grid_value(const wavelength_grid *grid, const double *value,
                             double wavenumber_cm1);

/* Whether a wavelength was measured: it lies between points, not in a gap. An even grid measures all. */
bool wavelength_grid_measures(const wavelength_grid *grid, double wavelength_um);

/* Whether it was measured, or lies no farther from that than a tenth of the end's wavelength; from 13.5 um on
 * the last value holds for ever. */
bool wavelength_grid_covers(const wavelength_grid *grid, double wavelength_um);

/* The first wavelength of a range that the grid does not cover; not-a-number: it covers all. */
double wavelength_grid_uncovered(const wavelength_grid *grid, double low_um, double high_um);

/* Writes the measured ranges, as "0.4 to 2.5, 8 to 14". Returns out. */
const char *wavelength_grid_text(const wavelength_grid *grid, char *out, size_t size);

#endif
