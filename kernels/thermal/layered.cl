#include "kernels/thermal/layered_history.h"

/* Launch: (facet_count / LANES_WIDTH, rounded up). facets: shape (facet_count); the rest as in
 * thermal.cl. */
SHARED_BODY kernel void layered(const thermal_span span, global const layered_record *facets,
                                TABLES(LOAD_TABLES), TABLES(EXCHANGE_TABLES),
                                global float *temperature_k)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= span.facet_count) return;

    const layered_world w = {.span = span,
                             .first = first,
                             .sub_step_s = THERMAL_SUB_STEP_S,
                             .loads = TABLES_GIVEN(LOAD_TABLES),
                             .exchange = TABLES_GIVEN(EXCHANGE_TABLES)};
    const layered_body body = layered_body_of(facets, first, span.facet_count);
    facet_state state = layered_start(w, &body);
    thermal_load before = layered_load_at(w, &body, 0);
    lanes earlier_k = state.front_k;
    for (uint step = 0; step < span.first_step + span.row_count; step++) {
        if (step > 0) {
            earlier_k = state.front_k;
            before = layered_go(w, &body, &state, before, step);
        }
        if (step < span.first_step) continue;
        const lanes now_k = earlier_k + span.weight * (state.front_k - earlier_k);
        lanes_store(body.stated_k > (lanes)0.0f ? body.stated_k : now_k,
                    temperature_k + (size_t)(step - span.first_step) * span.facet_count, first,
                    span.facet_count);
    }
}
