/* Facet sample: points spread over facets, for what is a mean over their area. */
#ifndef FACET_SAMPLE_H
#define FACET_SAMPLE_H

#include "kernels/records.h"
#include "mesh/geometry.h"

/* A facet of a level, 0 to 3, has 4^level points. Those of level 1. */
enum { FACET_SAMPLES = 4 };

static inline uint32_t facet_sample_count(uint8_t level)
{
    return 1u << 2 * level;
}

/* Sets the points of a facet as hits of its front: the middles of the equal parts of a triangle, of a
 * quad half of them in each of its triangles; of level 0 one near its middle.
 *   out   shape (facet_sample_count(level)) */
void facet_sample(hit_record *out, const geometry *g, uint32_t facet, uint8_t level);

/* Finds levels, so that a point stands for about the same area wherever there are several: as many as
 * do not make more than two points a facet, or 65536 in all.
 *   area_m2, out_level   shape (count) */
void facet_sample_levels(uint8_t *out_level, const float *area_m2, uint32_t count);

#endif
