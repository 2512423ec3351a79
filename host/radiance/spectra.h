/* Spectra: everything that depends on wavelength, sampled over the bands as the radiometry kernel
 * reads it (kernels/records.h, SPECTRA_...). */
#ifndef SPECTRA_H
#define SPECTRA_H

#include "kernels/records.h"
#include "sensor/band.h"

#include <stdbool.h>

typedef struct spectra {
    /* One row for all bands, which share their samples; blocks of SPECTRA_BLOCK, padded with weight
     * 0 where no band is between. */
    uint32_t band_count, sample_count;
    double *wavenumber_cm1; /* shape (sample_count), does not ascend */
    bool *bends;            /* shape (sample_count): spectra of materials bend there; NULL: none */
    band_record *bands;     /* shape (band_count) */
    double *centre_um, *width_um; /* shape (band_count) */
    float *weight_um;             /* shape (weight_count): the bands', one behind the other */
    uint32_t weight_count;
    uint32_t row_count;
    float *rows; /* shape (row_count, sample_count) */
} spectra;

/* Samples everything over the bands.
 *   rule     of all bands (band.h)
 *   thesis      Planck's law with the thesis' constants */
status spectra_build(spectra **out, const band *bands, uint32_t band_count, const atmosphere *air,
                     band_quadrature rule, bool thesis);
void spectra_free(spectra *s);

/* A count of samples in whole blocks of SPECTRA_BLOCK. */
uint32_t spectra_padded(uint32_t count);

/* Takes means over blocks of LIGHT_BLOCK samples, weighted by the response, instead of samples;
 * Planck's law is that of the blocks' mean wavelengths. There are no bands in it. */
status spectra_coarsen(spectra **out, const spectra *s);

/* Tells where in the rows the paths from several altitudes and along the ground stand.
 *   origin_z_m   the geometry's origin above z 0, which is where the database's levels begin
 * Whether the sensor looks along the ground is left open. */
air_record spectra_air(const atmosphere *air, double origin_z_m);

#endif
