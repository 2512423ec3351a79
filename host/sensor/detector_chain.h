/* Detector chain: what a real sensor makes of the radiance that reaches it: spread, sampling, noise,
 * counts. Thesis 4.0 item 9. Reproducible: random numbers are keyed by seed, name of the band,
 * detector and frame. */
#ifndef DETECTOR_CHAIN_H
#define DETECTOR_CHAIN_H

#include "device/device.h"
#include "sensor/band.h"
#include "sensor/detector_settings.h"
#include "sky/atmosphere.h"

typedef struct detector_chain detector_chain;

/* Prepares for pictures of a size: builds what all bands have of the point spread function. */
status detector_chain_open(detector_chain **out, device *dev, const detector_settings *how,
                           uint32_t columns, uint32_t rows);
void detector_chain_free(detector_chain *d);

/* Size in detectors: the picture's over the step, remainders are left out. */
uint32_t detector_chain_columns(const detector_chain *d);
uint32_t detector_chain_rows(const detector_chain *d);

/* Degrades one band, some rows at a time: memory does not grow with the picture.
 *   rule      as the radiance was integrated; with the database's points Planck's law has the thesis' constants
 *   radiance  shape (rows, columns) of the picture, W m-2 sr-1 or its mean per um
 *   out       shape (rows, columns) of the detectors, the same unit */
status detector_chain_band(detector_chain *d, const band *b, const atmosphere *air,
                           band_quadrature rule, const float *radiance, float *out);

#endif
