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
    size_t point_count;     /* of further samples, where spectra of materials bend */
    double *point_cm1;      /* shape (point_count), descends */
} band;

/* Frees what a band owns. */
void band_free(band *b);

/* The samples of a band: where spectra are evaluated and what each counts. */
typedef struct band_samples {
    int count;
    double *wavenumber_cm1;     /* shape (count), descends: ascending wavelength */
    double *weight_um;          /* shape (count), response x quadrature */
    double centre_um, width_um; /* mean wavelength and sum of the weights */
} band_samples;

/* Where the samples of a band lie, and how they are summed. */
typedef enum band_quadrature {
    BAND_FINE, /* the band's own edges, every point of the database, its own points, and between them steps
                          * of at most planck_step_cm1, by the trapezoid rule in wavelength; a tabulated
                          * response is integrated exactly against a spectrum that is linear between
                          * the samples */
    BAND_DATABASE_POINTS /* the points of the database in the band, as in the thesis */
} band_quadrature;

/* Lays samples over a band.
 * Fails with STATUS_ARGUMENT where the band leaves the database or holds fewer than two samples. */
status band_sample(band_samples *out, const band *b, const atmosphere *air, band_quadrature rule);
void band_samples_free(band_samples *samples);

/* Reads a spectrum of the database at a wavenumber inside its range, linear in wavenumber.
 *   value   shape (point_count) */
double band_look_up(const atmosphere *air, const double *value, double wavenumber_cm1);

#endif
