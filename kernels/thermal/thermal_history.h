/* Thermal history: facets of THERM's model through the weather, from their start on. Device only. */
#ifndef THERMAL_HISTORY_H
#define THERMAL_HISTORY_H

#include "kernels/thermal/facet_switches.h"
#include "kernels/thermal/thermal.h"

#ifdef __OPENCL_C_VERSION__

/* What acts on facets `first` to `first + LANES_WIDTH - 1`. */
typedef struct thermal_world {
    thermal_span span;
    uint first;
    load_tables loads;
    uint material[LANES_WIDTH];
} thermal_world;

static inline thermal_load thermal_load_at(const thermal_world *w, const thermal_body *body,
                                           uint step)
{
    thermal_load load = thermal_load_of(body, w->loads.forcing[step],
                                        sunlit_at(&w->loads, w->span, w->first, step));

    load.direct_w_m2 += power_at(&w->loads, w->material, step);
    return load;
}

/* Ready to leave the first record. */
static inline thermal_way thermal_way_of(const thermal_world *w, const thermal_body *body,
                                         float node_ratio)
{
    thermal_way way;

    way.nodes = thermal_nodes_of(node_ratio);
    way.before = way.after = thermal_load_at(w, body, 0);
    way.air_before = way.air_after = moisture_air_of(w->loads.forcing[0]);
    way.step_s = w->span.step_s;
    way.count = thermal_sub_steps(w->span.step_s, THERMAL_SUB_STEP_S);
    return way;
}

/* Goes through the step that ends at `step`. */
static inline void thermal_go(const thermal_world *w, const thermal_body *body, facet_state *state,
                              thermal_way *way, uint step)
{
    way->before = way->after;
    way->air_before = way->air_after;
    way->after = thermal_load_at(w, body, step);
    way->air_after = moisture_air_of(w->loads.forcing[step]);
    thermal_advance(state, body, way);
}

/* The first day once: state afterwards, and its means; `way` begins and ends at the first record. */
static inline void thermal_go_through_day(const thermal_world *w, const thermal_body *body,
                                          facet_state *state, thermal_way way, facet_state *mean)
{
    const uint steps = facet_steps_a_day(w->span);
    const float fraction = 1.0f / (float)steps;

    *mean = facet_state_zero();
    for (uint step = 1; step <= steps; step++) {
        thermal_go(w, body, state, &way, step);
        facet_state_add(mean, fraction, state);
    }
}

/* What both faces lose more per kelvin. */
static inline lanes thermal_slope(const thermal_body *body, const thermal_load *load,
                                  const facet_state *state)
{
    return thermal_front_flux(body, load, state->front_k).w_m2_k +
           thermal_back_flux(body, load, state->back_k).w_m2_k;
}

/* Moves a state to where the day drives it, so that thick matter needs no month. Nodes of slabs keep
 * their own swing and take the mean of the profile between the faces' means; a lump goes on as it
 * relaxed, by exp(-Lambda day / C) a day. */
static inline void thermal_settle(facet_state *state, const thermal_body *body,
                                  const thermal_way *way, const facet_state *earlier,
                                  const facet_state *mean)
{
    const lanes none = 0.0f, one = 1.0f;
    const lanes behind_k = body->back > none ? mean->back_k : mean->front_k;
    const lanes days =
        thermal_slope(body, &way->after, state) * FACET_DAY_S / body->capacity_j_m2_k;
    const lanes left = exp(-fmax(days, (lanes)0.01f));
    const lanes on_k = (state->front_k - earlier->front_k) * left / (one - left);

    for (int j = 0; j < FACET_NODES; j++)
        state->node_k[j] +=
            mean->front_k + way->nodes.centre[j] * (behind_k - mean->front_k) - mean->node_k[j];
    state->front_k += body->slab != none ? none : on_k;
    state->back_k += body->slab != none ? none : on_k;
}

/* The most that anything that stores heat differs by. */
static inline lanes thermal_difference(const thermal_body *body, const facet_state *a,
                                       const facet_state *b)
{
    const lanes none = 0.0f;

    return body->slab != none ? facet_state_difference(a, b) : fabs(a->front_k - b->front_k);
}

/* Goes through the first day until it ends as it began, in steps of up to a quarter of an hour; what
 * exchanges nothing stays as it is. */
static inline void thermal_find_start(const thermal_world *w, const thermal_body *body,
                                      const thermal_way *first, facet_state *state)
{
    lanes_mask moves = thermal_slope(body, &first->after, state) > (lanes)0.0f;
    thermal_way way = *first;
    facet_state mean;

    if (w->span.step_count <= facet_steps_a_day(w->span)) return;
    way.count = thermal_sub_steps(w->span.step_s, THERMAL_SETTLING_SUB_STEP_S);
    for (int i = 0; i < FACET_SETTLING_DAYS && lanes_any(moves); i++) {
        facet_state next = *state;
        thermal_go_through_day(w, body, &next, way, &mean);
        thermal_settle(&next, body, &way, state, &mean);
        const lanes most = thermal_difference(body, &next, state);
        facet_state_choose(state, moves, &next);
        moves = moves && most > (lanes)FACET_SETTLED_K;
    }
}

#endif

#endif
