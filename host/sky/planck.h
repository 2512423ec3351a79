/* Planck's law in double, for tables that the host makes. Thesis eq. 2.4-5. */
#ifndef PLANCK_H
#define PLANCK_H

#include <stdbool.h>

/* 2 h c^2 / l^5 (W m-2 sr-1 um-1) and h c / (k l) (K) at a wavelength; CODATA 2018, or the thesis'
 * constants. */
typedef struct planck_terms {
    double first, second;
} planck_terms;
planck_terms planck_at(double wavelength_um, bool thesis);

/* Spectral radiance of a black body, W m-2 sr-1 um-1. */
double planck_spectral(planck_terms terms, double temperature_k);

#endif
