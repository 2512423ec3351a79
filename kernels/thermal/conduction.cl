#include "kernels/thermal/conduction.h"

/* What a patch goes through. */
typedef struct patch_run {
    layered_world world;
    uint first, end; /* facets; whole groups */
    global const layered_record *facets;
    global const conduction_record *links;
    global conduction_group *groups;
    conduction_rows rows;
} patch_run;

static lanes load_row(global const float *row, uint first)
{
    lanes out;

    for (uint i = 0; i < LANES_WIDTH; i++) ((float *)&out)[i] = row[first + i];
    return out;
}

/* Sub-step i of `count` on the way to `step`: what is the same for all groups. */
typedef struct sub_step {
    layered_air air;
    float fraction, step_s;
    int i, count;
} sub_step;

static thermal_load load_of(const sub_step *s, global const conduction_group *group)
{
    const thermal_load before = group->before, after = group->after;

    return thermal_load_between(&before, &after, s->fraction,
                                thermal_sub_direct(&before, &after, s->i, s->count));
}

/* Fills the rows that the patch's equations are made of. */
static void go_alone(const patch_run *p, uint first, const sub_step *s)
{
    global conduction_group *group = &p->groups[first / LANES_WIDTH];
    const layered_body body = group->body;
    const layered_elimination elimination = group->elimination;
    const thermal_load load = load_of(s, group);
    facet_state state = group->state;
    const layered_front front = layered_front_of(&state, &body, &load, s->air, s->step_s);
    const lanes now_k = layered_lateral_k(&state, &body);

    layered_step(&state, &body, &elimination, &load, s->air, (lanes)0.0f, s->step_s);
    lanes_store(now_k, p->rows.now_k, first, p->end);
    lanes_store(layered_lateral_k(&state, &body) - now_k, p->rows.alone_k, first, p->end);
    lanes_store(layered_lateral_gain(&body, &elimination, &front), p->rows.gain, first, p->end);
    if (2 * s->i % s->count == 0) group->sum_w_m2 = (lanes)0.0f;
}

/* The same sub-step with what comes from the neighbours. */
static void go_together(const patch_run *p, uint first, const sub_step *s)
{
    global conduction_group *group = &p->groups[first / LANES_WIDTH];
    const layered_body body = group->body;
    const layered_elimination elimination = group->elimination;
    const thermal_load load = load_of(s, group);
    const lanes rise_k = load_row(p->rows.rise_k, first) - load_row(p->rows.alone_k, first);
    const lanes lateral_w_m2 = rise_k / load_row(p->rows.gain, first);
    facet_state state = group->state;

    layered_step(&state, &body, &elimination, &load, s->air, lateral_w_m2, s->step_s);
    group->state = state;
    group->sum_w_m2 += lateral_w_m2;
}

/* Makes a group ready for the way to `step`. */
static void open_step(const patch_run *p, uint first, uint step)
{
    global conduction_group *group = &p->groups[first / LANES_WIDTH];
    const layered_body body = group->body;
    layered_world w = p->world;

    w.first = first;
    const thermal_load before = layered_load_at(w, &body, step - 1);
    const thermal_flux back = thermal_back_flux(&body.face, &before, group->state.back_k);
    group->before = before;
    group->after = layered_load_at(w, &body, step);
    group->elimination = layered_eliminate(
        &body, back.w_m2_k,
        w.span.step_s / (float)thermal_sub_steps(w.span.step_s, THERMAL_SUB_STEP_S));
}

/* Goes through the step that ends at `step`; out_w_m2 as conduction.cl has it. Returns its work, as
 * conduction_solve does. */
static uint go(const patch_run *p, uint step, global float *out_w_m2)
{
    const thermal_span span = p->world.span;
    const int count = thermal_sub_steps(span.step_s, THERMAL_SUB_STEP_S);
    uint work = 0;

    for (uint first = p->first; first < p->end; first += LANES_WIDTH) open_step(p, first, step);
    for (int i = 0; i < count; i++) {
        const bool late = 2 * i >= count;
        const sub_step s = {layered_air_of(p->world.loads.forcing[late ? step : step - 1]),
                            (float)(i + 1) / (float)count, span.step_s / (float)count, i, count};
        for (uint first = p->first; first < p->end; first += LANES_WIDTH) go_alone(p, first, &s);
        work += conduction_solve(p->links, p->rows, p->first, p->end);
        for (uint first = p->first; first < p->end; first += LANES_WIDTH) {
            go_together(p, first, &s);
            if (2 * (i + 1) % count == 0)
                lanes_store(p->groups[first / LANES_WIDTH].sum_w_m2 * (2.0f / (float)count),
                            out_w_m2 + (size_t)(2 * step - 2 + late) * span.facet_count, first,
                            p->end);
        }
    }
    return work;
}

/* Each facet's own start. */
static void begin(const patch_run *p)
{
    layered_world w = p->world;

    for (w.first = p->first; w.first < p->end; w.first += LANES_WIDTH) {
        global conduction_group *group = &p->groups[w.first / LANES_WIDTH];
        const layered_body body = layered_body_of(p->facets, w.first, w.span.facet_count);
        group->body = body;
        group->state = layered_start(w, &body);
    }
}

/* Keeps the state in which the first day begins. */
static void begin_day(const patch_run *p)
{
    for (uint first = p->first; first < p->end; first += LANES_WIDTH)
        p->groups[first / LANES_WIDTH].day_before = p->groups[first / LANES_WIDTH].state;
}

/* Whether a node has moved over the first day. */
static bool has_moved(const patch_run *p)
{
    bool moves = false;

    for (uint first = p->first; first < p->end; first += LANES_WIDTH) {
        const facet_state now = p->groups[first / LANES_WIDTH].state;
        const facet_state before = p->groups[first / LANES_WIDTH].day_before;
        moves |= lanes_any(facet_state_difference(&now, &before) > (lanes)FACET_SETTLED_K);
    }
    return moves;
}

/* Goes one step further: through the first day over and over until no node moves, then on. Returns the
 * work of it. */
static uint go_on(const patch_run *p, conduction_progress *at, global float *out_w_m2)
{
    const thermal_span span = p->world.span;
    const uint day = facet_steps_a_day(span);

    if (at->days == 0) begin(p);
    if (at->days == 0) at->is_settled = span.step_count <= day;
    if (!at->is_settled && at->step == 0) begin_day(p);
    if (at->step == 0) at->days++;
    at->is_done = at->is_settled && at->step + 1 >= span.step_count;
    if (at->is_done) return 0;
    const uint work = go(p, ++at->step, out_w_m2);
    if (at->is_settled || at->step < day) return work;
    at->is_settled = at->days == FACET_SETTLING_DAYS || !has_moved(p);
    if (!at->is_settled) at->step = 0;
    return work;
}

/* A patch a work-item, through the weather.
 * Launch: (patch_count). Arrays of facets have span.facet_count of them, patch after patch, each
 * patch filled up to a multiple of 16 with facets without neighbours. patch_first: (patch_count + 1);
 * facets, loads, exchange: as in layered.cl, but nothing is lateral yet; launched again until all patches
 * are done; out_w_m2: (2 steps, facet_count), lateral_w_m2 of layered_history.h. */
SHARED_BODY kernel void conduction(const thermal_span span, const uint patch_count,
                                   global const layered_record *facets, TABLES(LOAD_TABLES),
                                   TABLES(EXCHANGE_TABLES), TABLES(PATCH_TABLES),
                                   global float *out_w_m2)
{
    const uint patch = get_global_id(0);
    const size_t n = span.facet_count;
    if (patch >= patch_count) return;

    const patch_tables t = TABLES_GIVEN(PATCH_TABLES);
    global float *row = t.numbers;
    const patch_run p = {.world = {.span = span,
                                   .loads = TABLES_GIVEN(LOAD_TABLES),
                                   .exchange = TABLES_GIVEN(EXCHANGE_TABLES)},
                         .first = t.patch_first[patch],
                         .end = t.patch_first[patch + 1],
                         .facets = facets,
                         .links = t.links,
                         .groups = t.groups,
                         .rows = {row, row + n, row + 2 * n, row + 3 * n, row + 4 * n, row + 5 * n,
                                  row + 6 * n, row + 7 * n, row + 8 * n}};
    conduction_progress at = t.progress[patch];
    for (uint work = 0; !at.is_done && work < CONDUCTION_WORK;) work += go_on(&p, &at, out_w_m2);
    t.progress[patch] = at;
}
