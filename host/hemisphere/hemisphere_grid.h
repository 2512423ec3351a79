/* Hemisphere grid: directions over the hemisphere of a facet and their weights. Thesis 2.4.2, eq. 2.4.2-7. */
#ifndef HEMISPHERE_GRID_H
#define HEMISPHERE_GRID_H

#include "device/device.h"
#include "launches.h"

/* What a cell of the hemisphere counts; e is its elevation above the facet's plane. */
typedef enum shape_factor_reading {
    SHAPE_FACTOR_COSINE,      /* sin(e) cos(e), as irradiance does */
    SHAPE_FACTOR_SOLID_ANGLE, /* cos(e) */
    SHAPE_FACTOR_THESIS,      /* sin(e): eq. 2.4.2-6 with theta of eq. 2.4.2-7, as printed */
    SHAPE_FACTOR_READINGS
} shape_factor_reading;

/* As the command line names them. */
extern const char *const shape_factor_reading_names[SHAPE_FACTOR_READINGS];

/* Fails with STATUS_ARGUMENT unless the steps divide 90 and 360, or beyond 2^22 cells. */
status hemisphere_grid_check_steps(double zenith_step_deg, double azimuth_step_deg);

/* A grid of directions over the hemisphere, on a device: cell centres, the lowest ring first, each
 * ring clockwise as seen from above the facet, from its upslope direction, from north where it is
 * level. Weights sum to 1. */
typedef struct hemisphere_grid hemisphere_grid;

/* Fails with STATUS_ARGUMENT unless the steps divide 90 and 360, or beyond 2^22 cells. Departs from
 * the thesis: cell centres instead of borders, normalised weights, see docs/departures.md. */
status hemisphere_grid_open(hemisphere_grid **out, device *dev, shape_factor_reading reading,
                            double zenith_step_deg, double azimuth_step_deg);

/* A grid whose rings have equal projected solid angles, and all cells equal weights: of the middles of the cells
 * where set_count is 0, else of so many sets of a random direction in each cell, see hemisphere_strata.h. Fails
 * as above. */
status hemisphere_grid_open_strata(hemisphere_grid **out, device *dev, double zenith_step_deg,
                                   double azimuth_step_deg, uint32_t set_count, uint32_t seed);

/* Which of so many parts a cell belongs to: neighbours go to different ones, as the multiples of the
 * golden section are spread. */
uint32_t hemisphere_grid_part_of(uint32_t cell, uint32_t parts);

/* Opens the cells of one part, in their order and with their weights. */
status hemisphere_grid_open_part(hemisphere_grid **out, device *dev, const hemisphere_grid *grid,
                                 uint32_t part, uint32_t parts);

/* Opens every sixth cell of each ring, those of a ring midway between those of the one below, with six
 * times their weights: for points of which many go into a mean. The whole grid where that leaves fewer
 * than two in a ring, or does not go up into the ring's azimuths. */
status hemisphere_grid_open_thinned(hemisphere_grid **out, device *dev,
                                    const hemisphere_grid *grid);
void hemisphere_grid_free(hemisphere_grid *grid);

uint32_t hemisphere_grid_cell_count(const hemisphere_grid *grid);

/* Sets of directions, 1 or more. */
uint32_t hemisphere_grid_set_count(const hemisphere_grid *grid);

/* The grid on the device: shape (set_count, cell_count, 4), see hemisphere.cl. */
float_buffer hemisphere_grid_cells(const hemisphere_grid *grid);

#endif
