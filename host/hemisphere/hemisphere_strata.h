/* Hemisphere strata: directions of cells of equal projected solid angle, one in each, drawn in sets. Sixteen sets
 * that follow each other put a (0,2)-sequence into every cell: I. Sobol, USSR Comp. Math. 7 (1967) 4, its digits
 * permuted for each cell by itself as A. Owen has it (Monte Carlo and Quasi-Monte Carlo Methods, 1995). */
#ifndef HEMISPHERE_STRATA_H
#define HEMISPHERE_STRATA_H

#include <stdint.h>

/* Sets that belong together. */
enum { HEMISPHERE_SETS = 16 };

/* Fills sets of cells, ring after ring, the lowest first, as hemisphere_grid has them.
 *   set_count   0: one set, of the middles
 *   cell        shape (set_count, rings x azimuths, 4): upslope, across, normal, weight */
void hemisphere_strata_fill(float (*cell)[4], uint32_t rings, uint32_t azimuths, uint32_t set_count,
                            uint32_t seed);

/* The set that a sample of a pixel takes: the pixels of a square of HEMISPHERE_SQUARE share it.
 *   column, row   of the whole frame */
enum { HEMISPHERE_SQUARE = 8 };
uint32_t hemisphere_strata_set(uint32_t column, uint32_t row, uint32_t sample, uint32_t seed);

#endif
