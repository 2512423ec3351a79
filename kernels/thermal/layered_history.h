/* Layered history: facets of layers through the weather, from their start on. Device only. */
#ifndef LAYERED_HISTORY_H
#define LAYERED_HISTORY_H

#include "kernels/thermal/facet_switches.h"
#include "kernels/thermal/layered.h"

/* Heat that facets exchange, in columns of those that do; without columns NULL: none.
 *   lateral_w_m2    shape (2 steps, lateral_columns): along them, mean over each half of the way to the
 *                   next step
 *   received_w_m2   shape (steps, received_columns): longwave */
#define EXCHANGE_TABLES(TABLE, AND)                                                                \
    TABLE(uint, lateral_columns)                                                                   \
    AND TABLE(OPTIONAL global const float *, lateral_w_m2)                                         \
    AND TABLE(uint, received_columns)                                                              \
    AND TABLE(OPTIONAL global const float *, received_w_m2)

#ifdef __OPENCL_C_VERSION__

TABLES_STRUCT(exchange_tables, EXCHANGE_TABLES);

/* What acts on facets `first` to `first + LANES_WIDTH - 1`. */
typedef struct layered_world {
    thermal_span span;
    uint first;
    float sub_step_s; /* at most */
    load_tables loads;
    exchange_tables exchange;
} layered_world;

static inline layered_body layered_body_of(global const layered_record *facets, uint first,
                                           uint count)
{
    layered_body body;

    for (uint lane = 0; lane < LANES_WIDTH; lane++) {
        const layered_record facet = facets[lanes_place(first, lane, count)];
        layered_set_body(&body, (int)lane, &facet);
    }
    return body;
}

/* Row `row` for each lane; `otherwise` where it has no column. */
static inline lanes layered_column_at(global const float *rows, uint columns, const uint *column,
                                      uint row, lanes otherwise)
{
    lanes out = otherwise;

    for (uint i = 0; i < LANES_WIDTH && columns > 0; i++)
        if (column[i] > 0) ((float *)&out)[i] = rows[(size_t)row * columns + column[i] - 1];
    return out;
}

static inline thermal_load layered_load_at(layered_world w, const layered_body *body, uint step)
{
    thermal_load load = thermal_load_of(&body->face, w.loads.forcing[step],
                                        sunlit_at(&w.loads, w.span, w.first, step));

    load.direct_w_m2 += power_at(&w.loads, body->material, step);
    if (w.exchange.received_columns > 0) {
        const lanes usual_w_m2 = thermal_longwave_of(&body->face, w.loads.forcing[step]);
        const lanes received_w_m2 =
            layered_column_at(w.exchange.received_w_m2, w.exchange.received_columns,
                              body->received_column, step, usual_w_m2);
        load.steady_w_m2 += body->face.emissivity * (received_w_m2 - usual_w_m2);
    }
    return load;
}

static inline lanes layered_lateral_at(layered_world w, const layered_body *body, uint row)
{
    return layered_column_at(w.exchange.lateral_w_m2, w.exchange.lateral_columns,
                             body->lateral_column, row, (lanes)0.0f);
}

/* Goes through the step that ends at `step`; returns the load after it. */
static inline thermal_load layered_go(layered_world w, const layered_body *body, facet_state *state,
                                      thermal_load before, uint step)
{
    const thermal_load after = layered_load_at(w, body, step);
    const lanes lateral_w_m2[2] = {layered_lateral_at(w, body, 2 * step - 2),
                                   layered_lateral_at(w, body, 2 * step - 1)};

    layered_advance(state, body, &before, &after, layered_air_of(w.loads.forcing[step - 1]),
                    layered_air_of(w.loads.forcing[step]), lateral_w_m2, w.span.step_s,
                    thermal_sub_steps(w.span.step_s, w.sub_step_s));
    return after;
}

/* The first day once: state afterwards, and its means. */
static inline void layered_go_through_day(layered_world w, const layered_body *body,
                                          facet_state *state, facet_state *mean)
{
    const uint steps = facet_steps_a_day(w.span);
    const float fraction = 1.0f / (float)steps;
    thermal_load before = layered_load_at(w, body, 0);

    *mean = facet_state_zero();
    for (uint step = 1; step <= steps; step++) {
        before = layered_go(w, body, state, before, step);
        facet_state_add(mean, fraction, state);
    }
}

/* The first day over and over, in steps of up to a quarter of an hour, until it ends as it began. */
static inline facet_state layered_start(layered_world w, const layered_body *body)
{
    const thermal_load first = layered_load_at(w, body, 0);
    facet_state state = layered_guess(body, &first), mean;
    lanes_mask moves = state.front_k == state.front_k;

    if (w.span.step_count <= facet_steps_a_day(w.span)) return state;
    w.sub_step_s = THERMAL_SETTLING_SUB_STEP_S;
    for (int i = 0; i < FACET_SETTLING_DAYS && lanes_any(moves); i++) {
        facet_state next = state;
        layered_go_through_day(w, body, &next, &mean);
        layered_settle(&next, body, &mean);
        const lanes most = facet_state_difference(&next, &state);
        facet_state_choose(&state, moves, &next);
        moves = moves && most > (lanes)FACET_SETTLED_K;
    }
    return state;
}

#endif

#endif
