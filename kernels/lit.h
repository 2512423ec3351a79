/* Lit: whether the sun reaches facets at a step of the weather, from their bits. */
#ifndef LIT_H
#define LIT_H

#include "thermal.h"

#ifdef __OPENCL_C_VERSION__

/* 1 or 0 for facets first .. first + LANES_WIDTH - 1.
 *   sunlit   shape (span.sunlit_words, span.facet_count): bit `slot % 32` of word `slot / 32` is that
 *            of the steps slot, slot + period ...; not read without words: always lit */
static inline lanes lit_at(global const uint *sunlit, thermal_span span, uint first, uint step)
{
    const uint slot = span.sunlit_period ? step % span.sunlit_period : step;

    if (span.sunlit_words == 0) return (lanes)1.0f;
    const lanes_bits word =
        lanes_load_bits(sunlit + (size_t)(slot / 32) * span.facet_count, first, span.facet_count);
    return lanes_of_bits(word >> (slot % 32) & 1u);
}

#endif

#endif
