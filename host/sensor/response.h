/* Response: how a band answers to wavelength, a table scaled to a peak of 1. b(lambda) of
 * thesis 2.4. */
#ifndef RESPONSE_H
#define RESPONSE_H

#include "base/status.h"

typedef struct response {
    int count;             /* 2 or more */
    double *wavelength_um; /* shape (count), ascends; twice the same: a step */
    double *value;         /* shape (count), 0..1, linear between points, 0 outside */
} response;

/* Reads a CSV table. Its first line names both columns, and so the unit: wavelength_um,
 * wavelength_nm or wavenumber_cm1, then response; lines before it that begin with # are passed
 * over. A line that repeats the wavelength before it is a step, of several the last one's. Noise below 0,
 * down to a twentieth of the peak, is 0, with a warning. Fails with `path:line` unless wavelengths of
 * 0.2 to 50 um rise or fall from line to line and responses are 0 or more, one of them above. */
status response_read(response **out, const char *path);

/* Makes exp(-4 ln 2 (l - centre)^2 / fwhm^2), cut 2 fwhm from its centre, where it is 1.5e-5. */
status response_gaussian(response **out, double centre_um, double fwhm_um);

void response_free(response *r);

double response_at(const response *r, double wavelength_um);

/* Integrates the response times the straight line that falls from 1 at one wavelength to 0 at the
 * other, or with from > to rises.
 *   from_um, to_um   they differ; either may be the shorter */
double response_integral(const response *r, double from_um, double to_um);

#endif
