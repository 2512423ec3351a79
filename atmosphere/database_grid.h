/* Database grid: the angles and wavenumbers of a radiance database, and the database that has room
 * for them. */
#ifndef DATABASE_GRID_H
#define DATABASE_GRID_H

#include "sky/atmosphere.h"

#include <stdbool.h>
#include <stddef.h>

/* Steps divide their ranges. */
typedef struct database_grid {
    double sensor_altitude_m;
    double wavenumber_min_cm1, wavenumber_max_cm1, wavenumber_step_cm1;
    double path_zenith_first_deg, path_zenith_last_deg, path_zenith_step_deg;
    double sky_zenith_step_deg, sky_azimuth_step_deg;
    size_t level_count;
    int target_count, range_count;
    const double *target_altitude_m, *range_m; /* shapes (target_count), (range_count) */
} database_grid;

/* Makes a database whose values are 0; atmosphere_free releases it. Fails with STATUS_MEMORY. */
status database_grid_make(atmosphere **out, const database_grid *grid);

/* Integrates the sky's directions over the hemisphere (sky_weight.h). */
status database_grid_integrate(atmosphere *a, bool thesis);

#endif
