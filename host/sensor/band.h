/* Band: what a channel of the sensor responds to. Thesis 2.4, eq. 2.4-3. */
#ifndef BAND_H
#define BAND_H

#include "sensor/response.h"
#include "sensor/response_file.h"
#include "sky/atmosphere.h"

#include <stdbool.h>
#include <stdint.h>

typedef struct band {
    char *name;
    double low_um, high_um; /* where it responds; unused with a sensor file */
    response *tabulated;    /* from here to there; NULL: 1 */
    response_file *sensor;  /* one value per database point, linear between; NULL: see above */
    double gain, offset;    /* counts = gain x W m-2 sr-1 + offset */
    bool is_mean;           /* the cube holds radiance in band over the band's width */
    uint32_t table;         /* index of the [[band]] that states it */
} band;

/* The samples of a band: where spectra are evaluated and what each counts. */
typedef struct band_samples {
    int count;
    double *wavenumber_cm1;     /* shape (count), descends: ascending wavelength */
    double *weight_um;          /* shape (count), response x quadrature */
    double centre_um, width_um; /* mean wavelength and sum of the weights */
} band_samples;

/* Lays samples over a band. Exact: the band's own edges and every point of the database, and
 * between them steps of at most planck_step_cm1, by the trapezoid rule in wavelength; a curve is integrated
 * exactly against a spectrum that is linear between the samples. Thesis: the database points in the
 * band.
 * Fails with STATUS_ARGUMENT where the band leaves the database or holds fewer than two samples. */
status band_sample(band_samples *out, const band *b, const atmosphere *air, bool thesis);
void band_samples_free(band_samples *samples);

/* The longest step between samples: 2 cm-1 at 3 um and beyond, growing as the square of the
 * wavenumber below (18 at 1 um, 72 at .5 um). Planck's law between samples then errs by less than
 * 2e-4 for every body that shines at that wavelength: 36 K per cm-1 of the step. */
double planck_step_cm1(double wavenumber_cm1);

/* Reads a spectrum of the database at a wavenumber inside its range, linear in wavenumber.
 *   value   shape (point_count) */
double band_look_up(const atmosphere *air, const double *value, double wavenumber_cm1);

#endif
