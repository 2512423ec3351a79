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

/* The longest step between samples: 2 cm-1 at 3 um and beyond, growing as the square of the
 * wavenumber below (18 at 1 um, 72 at 0.5 um). Planck's law between samples then errs by less than
 * 2e-4 for every body that shines at that wavelength: 36 K per cm-1 of the step. */
double planck_step_cm1(double wavenumber_cm1);

#endif
