/* Spectrum: a curve of a material over wavelength as it was measured, on the wavelengths of its file. */
#ifndef SPECTRAL_CURVE_H
#define SPECTRAL_CURVE_H

#include "spectrum/wavelength_grid.h"

typedef enum spectral_quantity {
    SPECTRAL_EMISSIVITY,
    SPECTRAL_REFLECTANCE,
    SPECTRAL_TRANSMITTANCE,
    SPECTRAL_CONSTANTS /* optical ones, n and k */
} spectral_quantity;

enum { SPECTRAL_TEXT_SIZE = 96 };

typedef struct spectral_curve {
    wavelength_grid grid;
    spectral_quantity quantity;
    double *value;                        /* shape (grid.count): 0..1; n */
    double *absorption;                   /* shape (grid.count): k; NULL for other quantities */
    char measurement[SPECTRAL_TEXT_SIZE]; /* the header's words on its geometry; "": none */
    bool is_directional;                  /* by them: bidirectional, biconical */
} spectral_curve;

/* What is read. */
typedef struct spectral_source {
    const char *path;
    const char *record;          /* of an ENVI spectral library; NULL: it holds one */
    const char *wavelength_path; /* of a splib07 file; NULL: not stated */
} spectral_source;

/* Reads a file of any layout of docs/file-formats.md, "Spectra": ECOSTRESS, ASTER, splib07, ENVI, SVC, CSV,
 * refractiveindex.info. Deleted channels are gaps. Fails with `path:line` and STATUS_FORMAT where wavelengths
 * repeat or turn, values leave 0..1 by more than 0.02, or less than 3 are there. */
status spectral_curve_read(spectral_curve **out, const spectral_source *source);
void spectral_curve_free(spectral_curve *s);

/* Turns reflectance into emissivity, 1 - r (Kirchhoff). */
void spectral_curve_take_kirchhoff(spectral_curve *s);

/* Adds what another curve of the same quantity has outside the ranges of this one; between both lies a gap.
 *   out_overlap_um   shape (2): where both have values; not-a-number: nowhere
 * Fails with STATUS_MEMORY. */
status spectral_curve_join(spectral_curve *s, const spectral_curve *other,
                           double out_overlap_um[2]);

/* "emissivity", "reflectance" .. */
const char *spectral_curve_quantity_name(spectral_quantity quantity);

#endif
