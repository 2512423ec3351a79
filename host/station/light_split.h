/* Light split: direct and diffuse light from the global irradiance of a span. D. G. Erbs, S. A. Klein,
 * J. A. Duffie, Estimation of the diffuse radiation fraction for hourly, daily and monthly-average global
 * radiation, Solar Energy 28 (1982) 293. */
#ifndef LIGHT_SPLIT_H
#define LIGHT_SPLIT_H

#include "weather/sun_span.h"

#include <stdbool.h>

/* The most that light of a record is taken for, of the clear sky's. */
#define LIGHT_MOST_OF_CLEAR 1.1

/* Diffuse fraction of the global irradiance, for a clearness index: global over extraterrestrial. */
double light_split_diffuse_fraction(double clearness);

/* Completes the three from those that are known (not-a-number: missing).
 *   global and one      the third closes: global = direct x cosine + diffuse; direct at most 1.1 of the
 *                       clear sky's, where the sun is low
 *   global alone        the fraction above; the beam again at most 1.1 of the clear sky's, the rest
 *                       is diffuse
 * Nothing is set where less is known. Returns true if the fraction was used, and on some light. */
bool light_split_complete(const sun_span *sun, double global_w_m2, double *direct_w_m2,
                          double *diffuse_w_m2);

#endif
