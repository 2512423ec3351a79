#include "thermal.h"

static float lit(global const uint *sunlit, thermal_span span, uint facet, uint step)
{
    const uint slot = span.sunlit_period ? step % span.sunlit_period : step;

    if (span.sunlit_words == 0) return 1.0f;
    return (float)(sunlit[(size_t)facet * span.sunlit_words + slot / 32] >> (slot % 32) & 1u);
}

/* Launch: (facet_count).
 * facets: shape (facet_count), thickness above 0 and a material of `materials` unless its
 * temperature is stated; forcing: (first_step + row_count), span.step_s apart; sunlit:
 * (facet_count, span.sunlit_words), bit `slot % 32` of word `slot / 32` set where the sun reaches
 * the facet at step slot, slot + period ...; NULL without words; temperature_k: (row_count, facet_count). */
kernel void thermal(const thermal_span span, global const facet_record *facets,
                    global const material_record *materials, global const forcing_record *forcing,
                    global const uint *sunlit, global float *temperature_k)
{
    const uint facet = get_global_id(0);
    if (facet >= span.facet_count) return;

    const float stated_k = facets[facet].stated_temperature_k;
    if (stated_k > 0.0f) {
        for (uint row = 0; row < span.row_count; row++)
            temperature_k[(size_t)row * span.facet_count + facet] = stated_k;
        return;
    }
    const thermal_body body = thermal_body_of(facets[facet], materials[facets[facet].material]);
    thermal_load before = thermal_load_of(body, forcing[0], lit(sunlit, span, facet, 0));
    thermal_state state = thermal_start(body, before);
    float earlier_k = state.front_k;
    for (uint step = 0; step < span.first_step + span.row_count; step++) {
        if (step > 0) {
            const thermal_load after =
                thermal_load_of(body, forcing[step], lit(sunlit, span, facet, step));
            earlier_k = state.front_k;
            thermal_advance(&state, body, before, after, span.step_s);
            before = after;
        }
        if (step >= span.first_step)
            temperature_k[(size_t)(step - span.first_step) * span.facet_count + facet] =
                earlier_k + span.weight * (state.front_k - earlier_k);
    }
}
