/* Detector settings: what [sensor] of a scene says of optics, motion, detectors and noise. Thesis 4.0 item 9. */
#ifndef DETECTOR_SETTINGS_H
#define DETECTOR_SETTINGS_H

#include "sensor/psf.h"

#include <stdbool.h>
#include <stdint.h>

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

#endif
