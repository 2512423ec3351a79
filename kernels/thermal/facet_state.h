/* Facet state: what facets' temperatures are now, in every thermal model; and how the first day is gone
 * through until it ends as it began. */
#ifndef FACET_STATE_H
#define FACET_STATE_H

#include "kernels/dialect.h"
#include "kernels/lanes.h"
#include "kernels/records.h"

#define FACET_NODES 8

/* The days of a start: how many at most, and what no node moves by in the last. */
#define FACET_SETTLING_DAYS 40
#define FACET_SETTLED_K 0.01f
#define FACET_DAY_S 86400.0f

typedef struct facet_state {
    lanes front_k, back_k;
    lanes node_k[FACET_NODES];
    lanes film_kg_m2; /* of water on the front */
} facet_state;

static inline uint facet_steps_a_day(thermal_span span)
{
    return (uint)(FACET_DAY_S / span.step_s + 0.5f);
}

/* Adds a fraction of a state's temperatures to a mean. */
static inline void facet_state_add(facet_state *mean, float fraction, const facet_state *state)
{
    mean->front_k += fraction * state->front_k;
    mean->back_k += fraction * state->back_k;
    for (int j = 0; j < FACET_NODES; j++) mean->node_k[j] += fraction * state->node_k[j];
}

/* A mean to which nothing was added yet. */
static inline facet_state facet_state_zero(void)
{
    facet_state zero;

    zero.front_k = zero.back_k = zero.film_kg_m2 = (lanes)0.0f;
    for (int j = 0; j < FACET_NODES; j++) zero.node_k[j] = (lanes)0.0f;
    return zero;
}

/* The most that a node differs by. */
static inline lanes facet_state_difference(const facet_state *a, const facet_state *b)
{
    lanes most = 0.0f;

    for (int j = 0; j < FACET_NODES; j++) most = fmax(most, fabs(a->node_k[j] - b->node_k[j]));
    return most;
}

/* Takes the other state in the lanes of the mask. */
static inline void facet_state_choose(facet_state *state, lanes_mask mask, const facet_state *other)
{
    state->front_k = mask ? other->front_k : state->front_k;
    state->back_k = mask ? other->back_k : state->back_k;
    state->film_kg_m2 = mask ? other->film_kg_m2 : state->film_kg_m2;
    for (int j = 0; j < FACET_NODES; j++)
        state->node_k[j] = mask ? other->node_k[j] : state->node_k[j];
}

#endif
