/* Sky weight: the hemispheric integral of a sky table, (1/pi) sum of L cos(zenith) over the solid
 * angle: a radiance. Thesis eq. 2.4.1-4, which omits the 1/pi. */
#ifndef SKY_WEIGHT_H
#define SKY_WEIGHT_H

#include <stdbool.h>

/* Weights of the zenith angles 0 .. 90, for the mean over the azimuths.
 *   count    zenith angles, ends included
 *   thesis   rectangles of cos sin, which sum to 0.977 for 15 degrees; else exact for radiance that
 *            is linear in the zenith angle between neighbours, sum 1
 *   out      shape (count) */
void sky_weight(int count, bool thesis, double *out);

/* Integrates one wavelength's sky.
 *   radiance   shape (zenith_count, azimuth_count), stride apart
 *   azimuths   count 360 too if there are more than one; it repeats 0 and is left out */
double sky_weight_integrate(const double *radiance, int stride, int zenith_count, int azimuth_count,
                            const double *weight);

#endif
