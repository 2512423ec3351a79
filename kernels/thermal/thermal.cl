#include "kernels/thermal/thermal_history.h"

static void set_bodies(thermal_body *body, lanes *stated_k, uint *material, thermal_span span,
                       uint first, global const facet_record *facets,
                       global const material_record *materials)
{
    for (int lane = 0; lane < LANES_WIDTH; lane++) {
        facet_record facet = facets[lanes_place(first, (uint)lane, span.facet_count)];
        const uint is_stated = facet.stated_temperature_k > 0.0f;
        const material_record inert = {.density_kg_m3 = 1.0f, .specific_heat_j_kg_k = 1.0f};
        if (is_stated) facet.thickness_m = 1.0f;
        thermal_set_body(body, lane, facet, is_stated ? inert : materials[facet.material]);
        ((float *)stated_k)[lane] = facet.stated_temperature_k;
        material[lane] = is_stated ? 0 : facet.material;
    }
}

/* Launch: (facet_count / LANES_WIDTH, rounded up).
 * facets: shape (facet_count), thickness above 0 and a material of `materials` unless its
 * temperature is stated; thesis: 1 for equal nodes and a start in balance with the first record;
 * temperature_k: (row_count, facet_count). */
SHARED_BODY kernel void thermal(const thermal_span span, const uint thesis,
                                global const facet_record *facets,
                                global const material_record *materials, TABLES(LOAD_TABLES),
                                global float *temperature_k)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= span.facet_count) return;

    thermal_world w = {.span = span, .first = first, .loads = TABLES_GIVEN(LOAD_TABLES)};
    thermal_body body;
    lanes stated_k;
    set_bodies(&body, &stated_k, w.material, span, first, facets, materials);
    thermal_way way = thermal_way_of(&w, &body, thesis ? 1.0f : THERMAL_NODE_RATIO);
    facet_state state = thermal_start(&body, &way.after, &way.nodes);
    if (!thesis) thermal_find_start(&w, &body, &way, &state);
    lanes earlier_k = state.front_k;
    for (uint step = 0; step < span.first_step + span.row_count; step++) {
        if (step > 0) {
            earlier_k = state.front_k;
            thermal_go(&w, &body, &state, &way, step);
        }
        if (step < span.first_step) continue;
        const lanes now_k = earlier_k + span.weight * (state.front_k - earlier_k);
        lanes_store(stated_k > (lanes)0.0f ? stated_k : now_k,
                    temperature_k + (size_t)(step - span.first_step) * span.facet_count, first,
                    span.facet_count);
    }
}
