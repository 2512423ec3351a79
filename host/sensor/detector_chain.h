/* Detector chain: what a real sensor makes of the radiance that reaches it: spread, sampling, noise,
 * counts. Thesis 4.0 item 9. Reproducible: random numbers are keyed by seed, name of the band,
 * detector and frame. */
#ifndef DETECTOR_CHAIN_H
#define DETECTOR_CHAIN_H

#include "device/device.h"
#include "sensor/band.h"
#include "sensor/psf.h"
#include "sky/atmosphere.h"

/* As [sensor] of a scene states it; 0 leaves a part out. */
typedef struct detector_settings {
    bool is_wanted;
    uint32_t seed, frame;
    double gaussian_fwhm_px, box_px;
    double airy_f_number, pixel_pitch_um;
    double motion_px, motion_deg;
    psf *table; /* NULL: none */
    int step;   /* pixels of a detector, across and down */
    double netd_k, netd_at_k;
    double nesr; /* W m-2 sr-1 um-1, mean over the band; so for the next but one */
    double fixed_gain, fixed_offset;
    double periodic, periodic_px, periodic_deg;
    double electrons;      /* per W m-2 sr-1 in band */
    double read_electrons; /* standard deviation */
    int bits;              /* of a count; the count is the band's gain and offset */
} detector_settings;

typedef struct detector_chain detector_chain;

/* Prepares a picture for all its bands. */
status detector_chain_open(detector_chain **out, device *dev, const detector_settings *how,
                           uint32_t columns, uint32_t rows);
void detector_chain_free(detector_chain *d);

/* Size in detectors: the picture's over the step, remainders are left out. */
uint32_t detector_chain_columns(const detector_chain *d);
uint32_t detector_chain_rows(const detector_chain *d);

/* Degrades one band.
 *   thesis    Planck's law with the thesis' constants, bands as in band.h
 *   radiance  shape (rows, columns) of the picture, W m-2 sr-1 or its mean per um
 *   out       shape (rows, columns) of the detectors, the same unit */
status detector_chain_band(detector_chain *d, const band *b, const atmosphere *air, bool thesis,
                           const float *radiance, float *out);

#endif
