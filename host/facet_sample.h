/* Facet sample: points spread over a facet, for what is a mean over its area. */
#ifndef FACET_SAMPLE_H
#define FACET_SAMPLE_H

#include "../kernels/records.h"
#include "geometry.h"

enum { FACET_SAMPLES = 4 };

/* Sets the points of a facet as hits of its front: the middles of the quarters of a triangle, of a
 * quad two in each of its triangles. */
void facet_sample(hit_record out[FACET_SAMPLES], const geometry *g, uint32_t facet);

#endif
