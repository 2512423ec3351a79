/* PSF: how optics, motion and detectors spread a point over the pixels. Thesis 4.0 item 9.
 * A picture is constant over each of its pixels; a weight is the fraction of the spread that falls on
 * a pixel, and weights sum to 1. */
#ifndef PSF_H
#define PSF_H

#include "base/status.h"

/* The most pixels that one part of a spread reaches to a side. */
enum { PSF_REACH = 64 };

typedef struct psf {
    int columns, rows;
    int first_column, first_row; /* of the weights, from the detector's first pixel */
    double *weight;              /* shape (rows, columns): what that pixel adds to the detector */
} psf;

/* Makes a detector of step x step pixels that answers alike over its area. */
status psf_detector(psf **out, int step);

/* Reads a table as comma-separated lines: the picture of a point, 0 or more, an odd number of lines
 * and columns up to 129, the point in the middle, the first line on top. Scaled to a sum of 1. */
status psf_read(psf **out, const char *path);
void psf_free(psf *p);
status psf_copy(psf **out, const psf *p);

/* Each spreads what is there once more; lengths in pixels. Fails with STATUS_MEMORY. */
status psf_add_gaussian(psf *p, double fwhm);
/* A square aperture, centred. */
status psf_add_box(psf *p, double width);
/* A straight smear; the angle is counted from along the columns' numbers towards the top. */
status psf_add_motion(psf *p, double length, double angle_deg);
/* Diffraction of a round aperture; `scale` is wavelength times focal ratio over pixel pitch. Cut
 * ten scales from the centre, or PSF_REACH. */
status psf_add_airy(psf *p, double scale);
status psf_add(psf *p, const psf *spread);

#endif
