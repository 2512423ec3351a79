#include "sky/planck.h"

#include "kernels/constants.h"

#include <math.h>

static const double STEP_CM1 = 2.0, STEP_GROWS_FROM_CM1 = 1e4 / 3.0;

planck_terms planck_at(double wavelength_um, bool thesis)
{
    const double first = thesis ? PLANCK_FIRST_THESIS : PLANCK_FIRST;
    const double second = thesis ? PLANCK_SECOND_THESIS : PLANCK_SECOND;

    return (planck_terms){first / pow(wavelength_um, 5.0), second / wavelength_um};
}

double planck_spectral(planck_terms terms, double temperature_k)
{
    return terms.first / expm1(terms.second / temperature_k);
}

double planck_step_cm1(double wavenumber_cm1)
{
    const double ratio = wavenumber_cm1 / STEP_GROWS_FROM_CM1;

    return STEP_CM1 * fmax(1.0, ratio * ratio);
}
