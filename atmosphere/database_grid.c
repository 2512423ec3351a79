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
    const size_t targets = (size_t)a->target_count, ranges = (size_t)a->range_count;
    const struct {
        double **at;
        size_t size;
    } arrays[] = {{&a->wavelength_um, n},
                  {&a->wavenumber_cm1, n},
                  {&a->solar_irradiance, n},
                  {&a->tau1, n},
                  {&a->path_range_m, paths},
                  {&a->tau2, paths * n},
                  {&a->path_emitted, paths * n},
                  {&a->path_scattered, paths * n},
                  {&a->sky_emitted, n},
                  {&a->sky_scattered, n},
                  {&a->sky_emitted_direction, sky * n},
                  {&a->sky_scattered_direction, sky * n},
                  {&a->level_altitude_m, levels},
                  {&a->level_temperature_k, levels},
                  {&a->target_altitude_m, targets},
                  {&a->target_range_m, targets * paths},
                  {&a->target_tau, targets * paths * n},
                  {&a->target_emitted, targets * paths * n},
                  {&a->target_scattered, targets * paths * n},
                  {&a->range_m, ranges},
                  {&a->range_tau, ranges * n},
                  {&a->range_emitted, ranges * n},
                  {&a->range_scattered, ranges * n}};

    for (size_t i = 0; i < sizeof arrays / sizeof *arrays; i++) {
        if (!arrays[i].size) continue;
        *arrays[i].at = calloc(arrays[i].size, sizeof **arrays[i].at);
        if (!*arrays[i].at) return status_set(STATUS_MEMORY, "no memory for a radiance database");
    }
    return STATUS_OK;
}

status database_grid_make(atmosphere **out, const database_grid *grid)
{
    status rc = STATUS_OK;
    atmosphere *a = calloc(1, sizeof *a);

    NEED(a, STATUS_MEMORY, "no memory for a radiance database");
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
    a->target_count = grid->target_count;
    a->range_count = grid->range_count;
    TRY(make_room(a, grid->level_count));
    for (int i = 0; i < grid->target_count; i++)
        a->target_altitude_m[i] = grid->target_altitude_m[i];
    for (int i = 0; i < grid->range_count; i++) a->range_m[i] = grid->range_m[i];
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

    NEED(weight, STATUS_MEMORY, "no memory for the integrated sky");
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
