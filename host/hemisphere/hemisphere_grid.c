#include "hemisphere/hemisphere_grid.h"

#include "hemisphere/hemisphere_strata.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

enum { CELL_LIMIT = 1 << 22 };

/* Of a ring's cells one of so many stays when they are thinned, but no fewer than these. */
enum { THIN = 6, THINNED_LEAST = 2 };

static const double radian = 0.017453292519943295;

struct hemisphere_grid {
    float_buffer cell; /* shape (set_count, cell_count, 4): upslope, across, normal, weight */
    uint32_t set_count, cell_count, azimuths;
};

const char *const shape_factor_reading_names[SHAPE_FACTOR_READINGS] = {"cosine", "solid-angle",
                                                                       "thesis"};

/* Finds how many steps make up the range. */
static status count_steps(uint32_t *out, const char *name, double step_deg, double range_deg)
{
    status rc = STATUS_OK;
    double count = 0;

    NEED(step_deg > 0 && step_deg <= range_deg, STATUS_ARGUMENT,
         "step in %s: found %g degrees, expected above 0 and up to %g", name, step_deg, range_deg);
    count = round(range_deg / step_deg);
    NEED(count <= CELL_LIMIT && fabs(count * step_deg - range_deg) < 1e-6 * range_deg,
         STATUS_ARGUMENT, "step in %s: found %g degrees, expected a divisor of %g", name, step_deg,
         range_deg);
    *out = (uint32_t)count;
out:
    return rc;
}

static status count_cells(uint32_t *rings, uint32_t *azimuths, double zenith_step_deg,
                          double azimuth_step_deg)
{
    status rc = STATUS_OK;

    TRY(count_steps(rings, "zenith", zenith_step_deg, 90));
    TRY(count_steps(azimuths, "azimuth", azimuth_step_deg, 360));
    NEED((uint64_t)*rings * *azimuths <= CELL_LIMIT, STATUS_ARGUMENT,
         "steps of %g and %g degrees make more than %d cells", zenith_step_deg, azimuth_step_deg,
         CELL_LIMIT);
out:
    return rc;
}

status hemisphere_grid_check_steps(double zenith_step_deg, double azimuth_step_deg)
{
    uint32_t rings, azimuths;

    return count_cells(&rings, &azimuths, zenith_step_deg, azimuth_step_deg);
}

/* The weight of a cell at an elevation above the plane, before they are made to sum to 1. */
static double weigh(shape_factor_reading reading, double elevation_rad)
{
    switch (reading) {
    case SHAPE_FACTOR_SOLID_ANGLE:
        return cos(elevation_rad);
    case SHAPE_FACTOR_THESIS:
        return sin(elevation_rad); /* eq. 2.4.2-6 with theta of eq. 2.4.2-7 */
    default:
        return sin(elevation_rad) * cos(elevation_rad);
    }
}

static void fill_cells(float (*cell)[4], shape_factor_reading reading, uint32_t rings,
                       uint32_t azimuths)
{
    double sum = 0;

    for (uint32_t r = 0; r < rings; r++)
        sum += azimuths * weigh(reading, (r + .5) * 90 / rings * radian);
    for (uint32_t r = 0; r < rings; r++)
        for (uint32_t a = 0; a < azimuths; a++) {
            const double elevation = (r + .5) * 90 / rings * radian;
            const double azimuth = (a + .5) * 360 / azimuths * radian;
            float *c = cell[r * azimuths + a];
            c[0] = (float)(cos(elevation) * cos(azimuth)); /* eq. 2.4.2-7 */
            c[1] = (float)(cos(elevation) * sin(azimuth));
            c[2] = (float)sin(elevation);
            c[3] = (float)(weigh(reading, elevation) / sum);
        }
}

/* Opens a grid that fill_cells or, with sets, hemisphere_strata_fill fills.
 *   reading   of a grid without strata; NULL: strata */
static status open_filled(hemisphere_grid **out, device *dev, const shape_factor_reading *reading,
                          const double step_deg[2], uint32_t set_count, uint32_t seed)
{
    status rc = STATUS_OK;
    hemisphere_grid *grid = calloc(1, sizeof *grid);
    float(*cell)[4] = NULL;
    uint32_t rings = 0, azimuths = 0;

    NEED(grid, STATUS_MEMORY, "no memory for a hemisphere");
    TRY(count_cells(&rings, &azimuths, step_deg[0], step_deg[1]));
    grid->set_count = set_count > 0 ? set_count : 1;
    grid->cell_count = rings * azimuths;
    grid->azimuths = azimuths;
    cell = malloc((size_t)grid->set_count * grid->cell_count * sizeof *cell);
    NEED(cell, STATUS_MEMORY, "no memory for %u hemispheres of %u cells", grid->set_count,
         grid->cell_count);
    if (reading)
        fill_cells(cell, *reading, rings, azimuths);
    else
        hemisphere_strata_fill(cell, rings, azimuths, set_count, seed);
    TRY(device_allocate(dev, &grid->cell, 4 * (size_t)grid->set_count * grid->cell_count, cell[0]));
    *out = grid;
    grid = NULL;
out:
    free(cell);
    hemisphere_grid_free(grid);
    return rc;
}

status hemisphere_grid_open(hemisphere_grid **out, device *dev, shape_factor_reading reading,
                            double zenith_step_deg, double azimuth_step_deg)
{
    return open_filled(out, dev, &reading, (double[2]){zenith_step_deg, azimuth_step_deg}, 0, 0);
}

status hemisphere_grid_open_strata(hemisphere_grid **out, device *dev, double zenith_step_deg,
                                   double azimuth_step_deg, uint32_t set_count, uint32_t seed)
{
    return open_filled(out, dev, NULL, (double[2]){zenith_step_deg, azimuth_step_deg}, set_count,
                       seed);
}

uint32_t hemisphere_grid_part_of(uint32_t cell, uint32_t parts)
{
    const uint32_t golden = 2654435769u; /* 2^32 (sqrt(5) - 1) / 2 */

    return (cell * golden >> 16) * parts >> 16;
}

/* Opens those cells of a grid for which `weighs` is above 0, their weights times that, as one ring. */
static status open_some(hemisphere_grid **out, device *dev, const hemisphere_grid *grid,
                        const float *weighs)
{
    status rc = STATUS_OK;
    hemisphere_grid *some = calloc(1, sizeof *some);
    float(*cell)[4] = malloc(grid->cell_count * sizeof *cell);

    NEED(some && cell, STATUS_MEMORY, "no memory for a hemisphere");
    TRY(device_download(dev, grid->cell, 4 * grid->cell_count, cell[0]));
    for (uint32_t i = 0; i < grid->cell_count; i++) {
        if (weighs[i] == 0.0f) continue;
        memmove(cell[some->cell_count], cell[i], sizeof *cell);
        cell[some->cell_count++][3] *= weighs[i];
    }
    some->set_count = 1;
    some->azimuths = some->cell_count;
    TRY(device_allocate(dev, &some->cell, 4 * some->cell_count, cell[0]));
    *out = some;
    some = NULL;
out:
    free(cell);
    hemisphere_grid_free(some);
    return rc;
}

status hemisphere_grid_open_part(hemisphere_grid **out, device *dev, const hemisphere_grid *grid,
                                 uint32_t part, uint32_t parts)
{
    status rc = STATUS_OK;
    float *weighs = calloc(grid->cell_count, sizeof *weighs);

    NEED(weighs, STATUS_MEMORY, "no memory for a hemisphere");
    for (uint32_t i = 0; i < grid->cell_count; i++)
        weighs[i] = hemisphere_grid_part_of(i, parts) == part ? 1.0f : 0.0f;
    TRY(open_some(out, dev, grid, weighs));
out:
    free(weighs);
    return rc;
}

status hemisphere_grid_open_thinned(hemisphere_grid **out, device *dev, const hemisphere_grid *grid)
{
    status rc = STATUS_OK;
    const uint32_t n = grid->azimuths;
    const uint32_t step = n % THIN == 0 && n / THIN >= THINNED_LEAST ? THIN : 1;
    float *weighs = calloc(grid->cell_count, sizeof *weighs);

    NEED(weighs, STATUS_MEMORY, "no memory for a hemisphere");
    for (uint32_t i = 0; i < grid->cell_count; i++)
        weighs[i] = (i % n + step / 2 * (i / n)) % step == 0 ? (float)step : 0.0f;
    TRY(open_some(out, dev, grid, weighs));
    (*out)->azimuths = n / step;
out:
    free(weighs);
    return rc;
}

void hemisphere_grid_free(hemisphere_grid *grid)
{
    if (!grid) return;
    device_release(grid->cell);
    free(grid);
}

uint32_t hemisphere_grid_cell_count(const hemisphere_grid *grid)
{
    return grid->cell_count;
}

uint32_t hemisphere_grid_set_count(const hemisphere_grid *grid)
{
    return grid->set_count;
}

float_buffer hemisphere_grid_cells(const hemisphere_grid *grid)
{
    return grid->cell;
}
