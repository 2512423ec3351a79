#include "database_grid.h"

#include "sky_weight.h"

#include <math.h>
#include <stdlib.h>

/* Number of steps from low to high, ends included. */
static int count_steps(double low, double high, double step)
{
    return 1 + (int)lround((high - low) / step);
}

static status make_room(atmosphere *a, size_t levels)
{
    const size_t n = (size_t)a->point_count, paths = (size_t)a->path_count;
    const size_t sky = (size_t)(a->zenith_count * a->azimuth_count);
    double **const arrays[] = {&a->wavelength_um,         &a->wavenumber_cm1,
                               &a->solar_irradiance,      &a->tau1,
                               &a->path_range_m,          &a->tau2,
                               &a->path_emitted,          &a->path_scattered,
                               &a->sky_emitted,           &a->sky_scattered,
                               &a->sky_emitted_direction, &a->sky_scattered_direction,
                               &a->level_altitude_m,      &a->level_temperature_k};
    const size_t sizes[] = {n,         n, n, n,       paths,   paths * n, paths * n,
                            paths * n, n, n, sky * n, sky * n, levels,    levels};

    for (size_t i = 0; i < sizeof sizes / sizeof *sizes; i++) {
        *arrays[i] = calloc(sizes[i], sizeof **arrays[i]);
        if (!*arrays[i]) return status_set(STATUS_MEMORY, "a radiance database");
    }
    return STATUS_OK;
}

status database_grid_make(atmosphere **out, const database_grid *grid)
{
    status rc = STATUS_OK;
    atmosphere *a = calloc(1, sizeof *a);

    NEED(a, STATUS_MEMORY, "a radiance database");
    a->sensor_altitude_m = grid->sensor_altitude_m;
    a->wavenumber_min_cm1 = grid->wavenumber_min_cm1;
    a->wavenumber_max_cm1 = grid->wavenumber_max_cm1;
    a->wavenumber_step_cm1 = grid->wavenumber_step_cm1;
    a->wavelength_min_um = 1e4 / grid->wavenumber_max_cm1;
    a->wavelength_max_um = 1e4 / grid->wavenumber_min_cm1;
    a->point_count =
        count_steps(grid->wavenumber_min_cm1, grid->wavenumber_max_cm1, grid->wavenumber_step_cm1);
    a->path_zenith_first_deg = grid->path_zenith_first_deg;
    a->path_zenith_step_deg = grid->path_zenith_step_deg;
    a->path_zenith_meaningful_deg = grid->path_zenith_last_deg;
    a->path_count = count_steps(grid->path_zenith_first_deg, grid->path_zenith_last_deg,
                                grid->path_zenith_step_deg);
    a->zenith_step_deg = grid->sky_zenith_step_deg;
    a->azimuth_step_deg = grid->sky_azimuth_step_deg;
    a->zenith_count = count_steps(0.0, 90.0, a->zenith_step_deg);
    a->azimuth_count = count_steps(0.0, 360.0, a->azimuth_step_deg);
    a->level_count = (int)grid->level_count;
    TRY(make_room(a, grid->level_count));
    for (int i = 0; i < a->point_count; i++) {
        a->wavenumber_cm1[i] = a->wavenumber_max_cm1 - i * a->wavenumber_step_cm1;
        a->wavelength_um[i] = 1e4 / a->wavenumber_cm1[i];
    }
    *out = a;
    a = NULL;
out:
    atmosphere_free(a);
    return rc;
}

status database_grid_integrate(atmosphere *a, bool thesis)
{
    status rc = STATUS_OK;
    double *weight = malloc((size_t)a->zenith_count * sizeof *weight);

    NEED(weight, STATUS_MEMORY, "the integrated sky");
    sky_weight(a->zenith_count, thesis, weight);
    for (int i = 0; i < a->point_count; i++) {
        a->sky_emitted[i] = sky_weight_integrate(a->sky_emitted_direction + i, a->point_count,
                                                 a->zenith_count, a->azimuth_count, weight);
        a->sky_scattered[i] = sky_weight_integrate(a->sky_scattered_direction + i, a->point_count,
                                                   a->zenith_count, a->azimuth_count, weight);
    }
out:
    free(weight);
    return rc;
}
