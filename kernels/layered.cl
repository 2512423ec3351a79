#include "layered.h"
#include "lit.h"

typedef struct layered_world {
    thermal_span span;
    global const forcing_record *forcing;
    global const uint *sunlit;
    uint first; /* facet of lane 0 */
    uint power_materials;
    global const float *power;
} layered_world;

static thermal_load load_at(layered_world w, const layered_body *body, uint step)
{
    thermal_load load =
        thermal_load_of(&body->face, w.forcing[step], lit_at(w.sunlit, w.span, w.first, step));

    load.direct_w_m2 += power_at(w.power, w.power_materials, body->material, step);
    return load;
}

/* Goes through one step; returns the load after it. */
static thermal_load go(layered_world w, const layered_body *body, layered_state *state,
                       thermal_load before, uint step)
{
    const thermal_load after = load_at(w, body, step);

    layered_advance(state, body, &before, &after, layered_air_of(w.forcing[step - 1]),
                    layered_air_of(w.forcing[step]), w.span.step_s);
    return after;
}

/* The first day once: state afterwards, and its means. */
static void go_through_day(layered_world w, const layered_body *body, uint steps,
                           layered_state *state, layered_state *mean)
{
    thermal_load before = load_at(w, body, 0);
    const float share = 1.0f / (float)steps;

    mean->front_k = mean->back_k = (lanes)0.0f;
    for (int j = 0; j < LAYERED_NODES; j++) mean->node_k[j] = (lanes)0.0f;
    for (uint step = 1; step <= steps; step++) {
        before = go(w, body, state, before, step);
        mean->front_k += share * state->front_k;
        mean->back_k += share * state->back_k;
        for (int j = 0; j < LAYERED_NODES; j++) mean->node_k[j] += share * state->node_k[j];
    }
}

static layered_state start(layered_world w, const layered_body *body)
{
    const thermal_load first = load_at(w, body, 0);
    const uint day = (uint)(86400.0f / w.span.step_s + 0.5f);
    layered_state state = layered_guess(body, &first), mean;
    lanes_mask moves = state.front_k == state.front_k;

    if (w.span.step_count <= day) return state;
    for (int i = 0; i < LAYERED_DAYS && lanes_any(moves); i++) {
        layered_state next = state;
        lanes most = 0.0f;
        go_through_day(w, body, day, &next, &mean);
        layered_settle(&next, body, &mean);
        for (int j = 0; j < LAYERED_NODES; j++)
            most = fmax(most, fabs(next.node_k[j] - state.node_k[j]));
        layered_choose(&state, moves, &next);
        moves = moves && most > (lanes)LAYERED_SETTLED_K;
    }
    return state;
}

/* Launch: (facet_count / LANES_WIDTH, rounded up). facets: shape (facet_count); the rest as in
 * thermal.cl. */
kernel void layered(const thermal_span span, global const layered_record *facets,
                    global const forcing_record *forcing, global const uint *sunlit,
                    const uint power_materials, global const float *power,
                    global float *temperature_k)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= span.facet_count) return;

    const layered_world w = {span, forcing, sunlit, first, power_materials, power};
    layered_body body;
    for (int lane = 0; lane < LANES_WIDTH; lane++) {
        const layered_record facet = facets[lanes_place(first, (uint)lane, span.facet_count)];
        layered_set_body(&body, lane, &facet);
    }
    layered_state state = start(w, &body);
    thermal_load before = load_at(w, &body, 0);
    lanes earlier_k = state.front_k;
    for (uint step = 0; step < span.first_step + span.row_count; step++) {
        if (step > 0) {
            earlier_k = state.front_k;
            before = go(w, &body, &state, before, step);
        }
        if (step < span.first_step) continue;
        const lanes now_k = earlier_k + span.weight * (state.front_k - earlier_k);
        lanes_store(body.stated_k > (lanes)0.0f ? body.stated_k : now_k,
                    temperature_k + (size_t)(step - span.first_step) * span.facet_count, first,
                    span.facet_count);
    }
}
