#include "kernels/thermal/facet_switches.h"
#include "kernels/thermal/thermal.h"

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

static thermal_load load_at(const load_tables *loads, thermal_span span, const thermal_body *body,
                            const uint *material, uint first, uint step)
{
    thermal_load load =
        thermal_load_of(body, loads->forcing[step], sunlit_at(loads, span, first, step));

    load.direct_w_m2 += power_at(loads, material, step);
    return load;
}

/* Launch: (facet_count / LANES_WIDTH, rounded up).
 * facets: shape (facet_count), thickness above 0 and a material of `materials` unless its
 * temperature is stated; temperature_k: (row_count, facet_count). */
SHARED_BODY kernel void thermal(const thermal_span span, global const facet_record *facets,
                                global const material_record *materials, TABLES(LOAD_TABLES),
                                global float *temperature_k)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= span.facet_count) return;

    const load_tables loads = TABLES_GIVEN(LOAD_TABLES);
    thermal_body body;
    lanes stated_k;
    uint material[LANES_WIDTH];
    set_bodies(&body, &stated_k, material, span, first, facets, materials);
    thermal_way way = {.after = load_at(&loads, span, &body, material, first, 0),
                       .air_after = moisture_air_of(loads.forcing[0]),
                       .step_s = span.step_s,
                       .count = thermal_sub_steps(span.step_s)};
    thermal_state state = thermal_start(&body, &way.after);
    lanes earlier_k = state.front_k;
    for (uint step = 0; step < span.first_step + span.row_count; step++) {
        if (step > 0) {
            earlier_k = state.front_k;
            way.before = way.after;
            way.air_before = way.air_after;
            way.after = load_at(&loads, span, &body, material, first, step);
            way.air_after = moisture_air_of(loads.forcing[step]);
            thermal_advance(&state, &body, &way);
        }
        if (step < span.first_step) continue;
        const lanes now_k = earlier_k + span.weight * (state.front_k - earlier_k);
        lanes_store(stated_k > (lanes)0.0f ? stated_k : now_k,
                    temperature_k + (size_t)(step - span.first_step) * span.facet_count, first,
                    span.facet_count);
    }
}
