/* Spectrum series: the points of a spectrum in the order and units of its file, until they are checked and
 * become a spectrum. */
#ifndef SPECTRAL_SERIES_H
#define SPECTRAL_SERIES_H

#include "files/unit.h"
#include "spectrum/spectral_curve.h"

typedef struct spectral_point {
    double place;      /* in the file's unit */
    double value;      /* n; below 0: a deleted channel */
    double absorption; /* k */
    int line;          /* 0: of a binary file */
} spectral_point;

typedef struct spectral_series {
    const char *path;
    const unit *unit; /* of wavelengths or wavenumbers */
    double scale;     /* of values: 0.01 for percent */
    spectral_quantity quantity;
    bool is_sampled; /* by an instrument, in small steps: a wide one is a gap */
    size_t count;
    spectral_point *point; /* shape (count) */
} spectral_series;

status spectral_series_add(spectral_series *s, spectral_point point);
void spectral_series_free(spectral_series *s);

/* Checks the points, as spectral_curve_read tells, and makes a spectrum of them. Warns of values that are cut. */
status spectral_series_finish(spectral_curve **out, const spectral_series *s);

#endif
