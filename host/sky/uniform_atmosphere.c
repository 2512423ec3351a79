#include "sky/uniform_atmosphere.h"

#include "sky/planck.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static status allocate(atmosphere *a, int points)
{
    status rc = STATUS_OK;
    double **const arrays[] = {
        &a->wavelength_um, &a->wavenumber_cm1,        &a->solar_irradiance,       &a->tau1,
        &a->tau2,          &a->path_emitted,          &a->path_scattered,         &a->sky_emitted,
        &a->sky_scattered, &a->sky_emitted_direction, &a->sky_scattered_direction};

    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        *arrays[i] = calloc((size_t)points, sizeof(double));
        NEED(*arrays[i], STATUS_MEMORY, "no memory for the atmosphere");
    }
    a->header = strdup("");
    a->path_range_m = calloc(1, sizeof(double));
    NEED(a->header && a->path_range_m, STATUS_MEMORY, "no memory for the atmosphere");
    a->point_count = points;
    a->path_count = a->zenith_count = a->azimuth_count = 1;
out:
    return rc;
}

static void fill_point(atmosphere *a, int i, double wavenumber_cm1, const uniform_sky *sky,
                       bool thesis)
{
    const planck_terms planck = planck_at(1e4 / wavenumber_cm1, thesis);

    a->wavenumber_cm1[i] = wavenumber_cm1;
    a->wavelength_um[i] = 1e4 / wavenumber_cm1;
    a->solar_irradiance[i] = sky->sun_irradiance_w_m2_um;
    a->tau1[i] = 1.0;
    a->tau2[i] = sky->transmission;
    a->path_emitted[i] =
        (1.0 - sky->transmission) * planck_spectral(planck, sky->path_temperature_k);
    a->sky_emitted[i] = planck_spectral(planck, sky->sky_temperature_k);
    a->sky_scattered[i] = sky->sky_radiance_w_m2_sr_um;
    a->sky_emitted_direction[i] = a->sky_emitted[i];
    a->sky_scattered_direction[i] = a->sky_scattered[i];
}

status uniform_atmosphere_make(atmosphere **out, const uniform_sky *sky, double low_um,
                               double high_um, bool thesis)
{
    status rc = STATUS_OK;
    const double high = 1e4 / low_um, low = 1e4 / high_um;
    const int points = (int)ceil((high - low) / planck_step_cm1(low)) + 1;
    atmosphere *a = calloc(1, sizeof *a);

    NEED(a, STATUS_MEMORY, "no memory for the atmosphere");
    TRY(allocate(a, points));
    for (int i = 0; i < points; i++)
        fill_point(a, i, high - (high - low) * i / (points - 1), sky, thesis);
    a->wavelength_min_um = low_um;
    a->wavelength_max_um = high_um;
    a->wavenumber_min_cm1 = low;
    a->wavenumber_max_cm1 = high;
    a->wavenumber_step_cm1 = (high - low) / (points - 1);
    *out = a;
    a = NULL;
out:
    atmosphere_free(a);
    return rc;
}
