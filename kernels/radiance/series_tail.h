/* Series tail: what is left of a series that was broken off, once it falls by the same ratio every two
 * terms, as light does that goes to and fro between facets (Aitken's delta-squared process). */
#ifndef SERIES_TAIL_H
#define SERIES_TAIL_H

#include "kernels/spectrum.h"

/* A ratio this near 1 says that the series has not settled. */
#define SERIES_TAIL_RATIO 0.9995f

/* What all later terms add to the last sum; 0 where the sums do not fall by a ratio below 1.
 *   first, middle, last   sums, two terms apart */
static inline spectrum series_tail(spectrum first, spectrum middle, spectrum last)
{
    const spectrum fell = last - middle;
    /* 0 / 0 is 0. */
    const spectrum ratio = fmin(fmax(fell / (middle - first), 0.0f), 1.0f);
    const spectrum settled = ratio < SERIES_TAIL_RATIO ? ratio : (spectrum)0.0f;

    return fell * settled / (1.0f - settled);
}

#endif
