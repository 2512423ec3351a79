/* Facet switches: what differs from facet to facet at a step of the weather: whether the sun reaches it, and
 * power that is switched by the clock. */
#ifndef FACET_SWITCHES_H
#define FACET_SWITCHES_H

#include "kernels/thermal/thermal.h"

/* What acts on facets through the weather.
 *   forcing   shape (steps), span.step_s apart
 *   sunlit    shape (span.sunlit_words, span.facet_count): bit `slot % 32` of word `slot / 32` is that of
 *             the steps slot, slot + period ...; words beyond those bits hold a byte for every slot: its
 *             share of 255; NULL without words: always lit
 *   power     shape (steps, power_materials), W m-2; NULL without materials: none */
#define LOAD_TABLES(TABLE, AND)                                                                    \
    TABLE(global const forcing_record *, forcing)                                                  \
    AND TABLE(OPTIONAL global const uint *, sunlit)                                                \
    AND TABLE(uint, power_materials)                                                               \
    AND TABLE(OPTIONAL global const float *, power)

#ifdef __OPENCL_C_VERSION__

TABLES_STRUCT(load_tables, LOAD_TABLES);

/* 1 or 0, or a fraction, for facets first .. first + LANES_WIDTH - 1. */
static inline lanes sunlit_at(const load_tables *t, thermal_span span, uint first, uint step)
{
    global const uint *sunlit = t->sunlit;
    const uint slot = span.sunlit_period ? step % span.sunlit_period : step;

    if (span.sunlit_words == 0) return (lanes)1.0f;
    const uint bit_words = (span.sunlit_period + 31) / 32;
    if (bit_words > 0 && span.sunlit_words > bit_words) {
        const size_t row = bit_words + slot / 4;
        const lanes_bits four =
            lanes_load_bits(sunlit + row * span.facet_count, first, span.facet_count);
        return lanes_of_bits(four >> (slot % 4 * 8) & 255u) / 255.0f;
    }
    const lanes_bits word =
        lanes_load_bits(sunlit + (size_t)(slot / 32) * span.facet_count, first, span.facet_count);
    return lanes_of_bits(word >> (slot % 32) & 1u);
}

/* Power by the clock, W m-2.
 *   material   of each lane */
static inline lanes power_at(const load_tables *t, const uint *material, uint step)
{
    lanes out = (lanes)0.0f;

    for (uint i = 0; i < LANES_WIDTH && t->power_materials > 0; i++)
        ((float *)&out)[i] = t->power[(size_t)step * t->power_materials + material[i]];
    return out;
}

#endif

#endif
