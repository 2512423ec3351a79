/* Thermal: the heat balance of one facet, a reconstruction of THERM. Thesis 2.2; the equations of
 * the original are not public. Facets know nothing of each other.
 *   exposed area A   e = min(1, 2 |A|) scales all that the front exchanges, the sun included;
 *                    max(0, 2 |A| - 1) is the back's fraction, which sees black surroundings and air
 *                    at air temperature; A >= 0 one node, A < 0 a slab of 8
 *   surroundings     below the horizon: air temperature, reflectance 0.15; the sky's fraction of the
 *                    view is (1 + cos slope) / 2
 *   start            steady balance with the first record; outside thesis mode the first day over and
 *                    over from there (thermal_history.h)
 *   nodes            equal; outside thesis mode each half as thick again as the one before it
 *   dew              outside thesis mode, on the front alone (moisture.h)
 *   melting          matter that melts gets no warmer: what is more runs off with the water; outside
 *                    thesis mode
 * assumed: all of these; see docs/departures.md.
 * LANES_WIDTH facets go side by side; what they do not have in common is chosen lane by lane. */
#ifndef THERMAL_KERNEL_H
#define THERMAL_KERNEL_H

#include "kernels/constants.h"
#include "kernels/dialect.h"
#include "kernels/lanes.h"
#include "kernels/records.h"
#include "kernels/thermal/convection.h"
#include "kernels/thermal/facet_state.h"
#include "kernels/thermal/moisture.h"

/* At most, and on the way to a settled start. */
#define THERMAL_SUB_STEP_S 300.0f
#define THERMAL_SETTLING_SUB_STEP_S 900.0f
#define THERMAL_GROUND_REFLECTANCE 0.15f

#define THERMAL_NEVER_K 1e9f
#define THERMAL_NODE_RATIO 1.5f /* outside thesis mode */

/* How slabs are cut into nodes, of a thickness and a conductance of 1. */
typedef struct thermal_nodes {
    float fraction[FACET_NODES]; /* of the thickness */
    float centre[FACET_NODES];
    float
        way[FACET_NODES + 1];  /* conductances: face to node 0, node j - 1 to j, last to the back */
    float onward[FACET_NODES]; /* way[j + 1] / way[j] */
} thermal_nodes;

/* Each node `ratio` times as thick as the one before it; exact for 1. */
static inline thermal_nodes thermal_nodes_of(float ratio)
{
    thermal_nodes n;
    float all = 0.0f, part = 1.0f, edge = 0.0f, before = 0.0f;

    for (int j = 0; j < FACET_NODES; j++, part *= ratio) all += part;
    part = 1.0f / all;
    for (int j = 0; j < FACET_NODES; j++, part *= ratio) {
        n.fraction[j] = part;
        n.centre[j] = edge + 0.5f * part;
        n.way[j] = 1.0f / (n.centre[j] - before);
        before = n.centre[j];
        edge += part;
    }
    n.way[FACET_NODES] = 1.0f / (1.0f - before);
    for (int j = 0; j < FACET_NODES; j++) n.onward[j] = n.way[j + 1] / n.way[j];
    return n;
}

/* What does not change with time. */
typedef struct thermal_body {
    lanes normal[3];
    lanes sky;         /* its fraction of the view */
    lanes two_sided;   /* 0 or 1 */
    lanes slab;        /* 0 or 1 */
    lanes front, back; /* exposed shares */
    lanes absorptance, emissivity;
    lanes power_w_m2;
    lanes capacity_j_m2_k;    /* of the whole thickness */
    lanes conductance_w_m2_k; /* 0: no slab */
    lanes melts_k;            /* THERMAL_NEVER_K: it does not melt */
} thermal_body;

/* What one instant of the weather does to a body. */
typedef struct thermal_load {
    lanes direct_w_m2; /* absorbed of the direct beam, and power by the clock: both are held */
    lanes steady_w_m2; /* all else that the front takes in whatever its temperature */
    lanes back_w_m2;   /* the same for the back */
    lanes rain_w_m2_k;
    float air_k, rain_k;
    convection_air air;
} thermal_load;

/* A flux into a face and how much it falls per kelvin that the face gets warmer. */
typedef struct thermal_flux {
    lanes w_m2, w_m2_k;
} thermal_flux;

#define THERMAL_SET(body, name, lane, value) LANES_SET((body)->name, lane, value)

/* Fills one lane. */
static inline void thermal_set_body(thermal_body *body, int lane, facet_record facet,
                                    material_record matter)
{
    const float twice = 2.0f * fabs(matter.exposed_area);
    const uint slab =
        matter.exposed_area < 0.0f && facet.thickness_m > 0.0f && matter.conductivity_w_m_k > 0.0f;

    for (int i = 0; i < 3; i++) THERMAL_SET(body, normal[i], lane, facet.normal[i]);
    THERMAL_SET(body, sky, lane, 0.5f * (1.0f + facet.normal[2]));
    THERMAL_SET(body, two_sided, lane, (float)facet.two_sided);
    THERMAL_SET(body, slab, lane, (float)slab);
    THERMAL_SET(body, front, lane, fmin(1.0f, twice));
    THERMAL_SET(body, back, lane, fmax(0.0f, twice - 1.0f));
    THERMAL_SET(body, absorptance, lane, matter.solar_absorptance);
    THERMAL_SET(body, emissivity, lane, matter.thermal_emissivity);
    THERMAL_SET(body, power_w_m2, lane, facet.power_w_m2);
    THERMAL_SET(body, capacity_j_m2_k, lane,
                matter.density_kg_m3 * matter.specific_heat_j_kg_k * facet.thickness_m);
    THERMAL_SET(body, conductance_w_m2_k, lane,
                slab ? matter.conductivity_w_m_k / facet.thickness_m : 0.0f);
    THERMAL_SET(body, melts_k, lane, matter.melts_k > 0.0f ? matter.melts_k : THERMAL_NEVER_K);
}

/* Rise of the node behind a face that would be warmer than its matter melts: the face keeps that.
 *   free_k         where the face would come to, by `rise` of the node
 *   right, taken   of the node, without the face
 *   between        conductance from the face to it */
static inline lanes thermal_melting_rise(const thermal_body *body, lanes rise, lanes free_k,
                                         lanes node_k, lanes right, lanes taken, lanes between)
{
    const lanes held = (right + between * (body->melts_k - node_k)) / (taken + between);

    return free_k > body->melts_k ? held : rise;
}

static inline lanes_mask thermal_melts(const thermal_body *body)
{
    const lanes never = THERMAL_NEVER_K;

    return body->melts_k < never;
}

static inline float thermal_black_w_m2(float temperature_k)
{
    const float square_k2 = temperature_k * temperature_k;

    return STEFAN_BOLTZMANN * square_k2 * square_k2;
}

/* Longwave that reaches the front of a facet that knows nothing of the others. */
static inline lanes thermal_longwave_of(const thermal_body *body, forcing_record now)
{
    return body->sky * now.sky_longwave_w_m2 +
           (1.0f - body->sky) * thermal_black_w_m2(now.air_temperature_k);
}

static inline convection_air thermal_air_of(forcing_record now)
{
    convection_air air;

    air.law = now.convection_law;
    air.temperature_k = now.air_temperature_k;
    air.wind_w_m2_k = now.convection_w_m2_k;
    air.buoyancy = now.buoyancy;
    air.roughness = now.roughness;
    air.plate_w_m2_k = now.plate_w_m2_k;
    return air;
}

/* lit: 1 where the sun reaches the facet, 0 in shadow. */
static inline thermal_load thermal_load_of(const thermal_body *body, forcing_record now, lanes lit)
{
    const lanes none = 0.0f;
    const lanes cosine =
        body->normal[0] * now.sun[0] + body->normal[1] * now.sun[1] + body->normal[2] * now.sun[2];
    const lanes facing = body->two_sided != none ? fabs(cosine) : fmax(cosine, none);
    const float level_w_m2 = now.direct_w_m2 * fmax(0.0f, now.sun[2]) + now.diffuse_w_m2;
    const lanes sun_w_m2 = body->sky * now.diffuse_w_m2 +
                           (1.0f - body->sky) * (THERMAL_GROUND_REFLECTANCE * level_w_m2);
    const lanes longwave_w_m2 = thermal_longwave_of(body, now);
    thermal_load load;

    load.direct_w_m2 = body->front * body->absorptance * lit * facing * now.direct_w_m2;
    load.steady_w_m2 = body->power_w_m2 + body->front * (body->absorptance * sun_w_m2 +
                                                         body->emissivity * longwave_w_m2);
    load.back_w_m2 = body->back * body->emissivity * thermal_black_w_m2(now.air_temperature_k);
    load.air = thermal_air_of(now);
    load.air_k = now.air_temperature_k;
    /* assumed: rain falls straight down. */
    load.rain_w_m2_k = body->front * fmax(body->normal[2], none) * now.rain_w_m2_k;
    load.rain_k = now.rain_temperature_k;
    return load;
}

/* Linear between two records but for the direct beam: that of the nearer one is held, so that the
 * edge of a shadow stays an edge. */
static inline thermal_load thermal_load_between(const thermal_load *a, const thermal_load *b,
                                                float fraction, lanes direct_w_m2)
{
    thermal_load load;

    load.direct_w_m2 = direct_w_m2;
    load.steady_w_m2 = a->steady_w_m2 + fraction * (b->steady_w_m2 - a->steady_w_m2);
    load.back_w_m2 = a->back_w_m2 + fraction * (b->back_w_m2 - a->back_w_m2);
    load.air_k = a->air_k + fraction * (b->air_k - a->air_k);
    load.air = b->air;
    load.air.temperature_k = load.air_k;
    load.air.wind_w_m2_k =
        a->air.wind_w_m2_k + fraction * (b->air.wind_w_m2_k - a->air.wind_w_m2_k);
    load.rain_w_m2_k = a->rain_w_m2_k + fraction * (b->rain_w_m2_k - a->rain_w_m2_k);
    load.rain_k = a->rain_k + fraction * (b->rain_k - a->rain_k);
    return load;
}

/* Heat that air takes per kelvin from a face that looks up by `up`. */
static inline lanes thermal_convection(const thermal_load *load, lanes fraction, lanes up,
                                       lanes face_k)
{
    lanes taken = fraction * load->air.wind_w_m2_k;

    if (load->air.law != CONVECTION_WIND) taken = fraction * convection_of(load->air, up, face_k);
    return taken;
}

static inline thermal_flux thermal_front_flux(const thermal_body *body, const thermal_load *load,
                                              lanes front_k)
{
    const lanes fraction = body->front * body->emissivity * STEFAN_BOLTZMANN;
    const lanes cube_w_m2_k = fraction * front_k * front_k * front_k;
    const lanes convection_w_m2_k = thermal_convection(load, body->front, body->normal[2], front_k);
    thermal_flux flux;

    flux.w_m2 = load->direct_w_m2 + load->steady_w_m2 - cube_w_m2_k * front_k +
                convection_w_m2_k * (load->air_k - front_k) +
                load->rain_w_m2_k * (load->rain_k - front_k);
    flux.w_m2_k = 4.0f * cube_w_m2_k + convection_w_m2_k + load->rain_w_m2_k;
    return flux;
}

/* The same with dew, which is the part of it that `out_dew` tells. */
static inline thermal_flux thermal_wet_flux(const thermal_body *body, const thermal_load *load,
                                            moisture_air air, const facet_state *state,
                                            float step_s, moisture_flux *out_dew)
{
    const lanes convection_w_m2_k =
        thermal_convection(load, body->front, body->normal[2], state->front_k);
    thermal_flux flux = thermal_front_flux(body, load, state->front_k);

    out_dew->w_m2 = out_dew->w_m2_k = 0.0f;
    if (lanes_any(moisture_may_wet(air, state->front_k, state->film_kg_m2))) {
        *out_dew =
            moisture_of_dew(air, convection_w_m2_k, state->front_k, state->film_kg_m2, step_s);
        flux.w_m2 -= out_dew->w_m2;
        flux.w_m2_k += out_dew->w_m2_k;
    }
    return flux;
}

/* The film after a step in which the front was `rise_k` warmer in the mean than it began. */
static inline void thermal_step_film(facet_state *state, moisture_air air, lanes began_k,
                                     const moisture_flux *dew, lanes rise_k, float step_s)
{
    if (lanes_any(moisture_may_wet(air, began_k, state->film_kg_m2)))
        state->film_kg_m2 = moisture_film(air, began_k, state->film_kg_m2,
                                          dew->w_m2 + dew->w_m2_k * rise_k, step_s);
}

static inline thermal_flux thermal_back_flux(const thermal_body *body, const thermal_load *load,
                                             lanes back_k)
{
    const lanes fraction = body->back * body->emissivity * STEFAN_BOLTZMANN;
    const lanes cube_w_m2_k = fraction * back_k * back_k * back_k;
    const lanes convection_w_m2_k = thermal_convection(load, body->back, -body->normal[2], back_k);
    thermal_flux flux;

    flux.w_m2 = load->back_w_m2 - cube_w_m2_k * back_k + convection_w_m2_k * (load->air_k - back_k);
    flux.w_m2_k = 4.0f * cube_w_m2_k + convection_w_m2_k;
    return flux;
}

static inline void thermal_melt(facet_state *state, const thermal_body *body)
{
    if (!lanes_any(thermal_melts(body))) return;
    state->front_k = fmin(state->front_k, body->melts_k);
    for (int j = 0; j < FACET_NODES; j++) state->node_k[j] = fmin(state->node_k[j], body->melts_k);
}

/* Steady balance by Newton's method: both faces of a slab, or one temperature. Starts at the
 * air temperature and stays there where nothing is exchanged. */
static inline facet_state thermal_start(const thermal_body *body, const thermal_load *load,
                                        const thermal_nodes *nodes)
{
    const lanes none = 0.0f, one = 1.0f, through = body->conductance_w_m2_k;
    facet_state state;

    state.front_k = state.back_k = (lanes)load->air_k;
    state.film_kg_m2 = none;
    for (int i = 0; i < 24; i++) {
        const thermal_flux front = thermal_front_flux(body, load, state.front_k);
        const thermal_flux back = thermal_back_flux(body, load, state.back_k);
        const lanes both = front.w_m2_k + back.w_m2_k;
        const lanes exchanges = both > none ? one : none;
        const lanes passed = through * (state.front_k - state.back_k);
        const lanes in_front = front.w_m2 - passed, in_back = back.w_m2 + passed;
        const lanes scale =
            exchanges / (front.w_m2_k * back.w_m2_k + through * both + (1.0f - exchanges));
        const lanes lump = exchanges * (front.w_m2 + back.w_m2) / (both + (1.0f - exchanges));
        const lanes front_rise = scale * ((back.w_m2_k + through) * in_front + through * in_back);
        const lanes back_rise = scale * ((front.w_m2_k + through) * in_back + through * in_front);
        state.front_k += body->slab != none ? front_rise : lump;
        state.back_k += body->slab != none ? back_rise : lump;
    }
    for (int i = 0; i < FACET_NODES; i++)
        state.node_k[i] = state.front_k + nodes->centre[i] * (state.back_k - state.front_k);
    thermal_melt(&state, body);
    return state;
}

/* One node: T <- Teq + (T - Teq) exp(-Lambda dt / C), exact for a constant load, so that thin
 * sheets need no shorter steps.
 *   step_k_m2_w   dt / C */
static inline void thermal_step_lump(facet_state *state, const thermal_body *body,
                                     const thermal_load *load, moisture_air air, lanes step_k_m2_w,
                                     float step_s)
{
    const lanes began_k = state->front_k;
    moisture_flux dew;
    thermal_flux all = thermal_wet_flux(body, load, air, state, step_s, &dew);

    if (lanes_any(body->back > (lanes)0.0f)) {
        const thermal_flux back = thermal_back_flux(body, load, state->front_k);
        all.w_m2 += back.w_m2;
        all.w_m2_k += back.w_m2_k;
    }
    const lanes decay = all.w_m2_k * step_k_m2_w;
    /* 1 - exp is good to 1e-7 of the way to the balance, far below what 300 K are rounded to. */
    const lanes gain = decay > (lanes)1e-4f ? (1.0f - exp(-decay)) / all.w_m2_k : step_k_m2_w;
    state->front_k = fmin(state->front_k + gain * all.w_m2, body->melts_k);
    /* Of the flux, what did not warm the node went with its mean rise. */
    const lanes mean_k = decay > (lanes)1e-2f ? (1.0f - gain / step_k_m2_w) * all.w_m2 / all.w_m2_k
                                              : 0.5f * gain * all.w_m2;
    thermal_step_film(state, air, began_k, &dew, mean_k, step_s);
}

/* Eight nodes, backward Euler, solved for the rises so that single precision suffices:
 * C_j dT_j/dt = G_j (T_{j-1} - T_j) + G_{j+1} (T_{j+1} - T_j), eliminated from the back to the front. What a
 * node and all behind it take up per kelvin that it rises is
 *   taken_j = C_j / dt + G_{j+1} taken_{j+1} / (G_{j+1} + taken_{j+1}),
 * a sum without a difference, good to the last digit however thin the slab. It changes with the
 * back's slope alone and is computed once in a step of the weather. */
typedef struct thermal_elimination {
    lanes between[FACET_NODES + 1]; /* G_j, the first and the last from a face to its node */
    lanes back_slope;               /* of the back's flux */
    lanes back_way;                 /* 1 / (the last G + back_slope) */
    lanes passed[FACET_NODES];      /* G_j / (G_j + taken_j); of 0: of the back's face */
    lanes inverse[FACET_NODES];     /* 1 / (G_j + taken_j); of node 0: taken_0 itself */
} thermal_elimination;

static inline thermal_elimination thermal_eliminate(const thermal_body *body,
                                                    const thermal_nodes *nodes, lanes back_slope,
                                                    float step_s)
{
    const int last = FACET_NODES - 1;
    thermal_elimination e;
    lanes taken;

    for (int j = 0; j <= FACET_NODES; j++) e.between[j] = body->conductance_w_m2_k * nodes->way[j];
    e.back_slope = back_slope;
    e.back_way = 1.0f / (e.between[FACET_NODES] + back_slope);
    e.passed[0] = e.between[FACET_NODES] * e.back_way;
    taken = body->capacity_j_m2_k * nodes->fraction[last] / step_s + e.passed[0] * back_slope;
    for (int j = last; j > 0; j--) {
        e.inverse[j] = 1.0f / (e.between[j] + taken);
        e.passed[j] = e.between[j] * e.inverse[j];
        taken = body->capacity_j_m2_k * nodes->fraction[j - 1] / step_s + taken * e.passed[j];
    }
    e.inverse[0] = taken;
    return e;
}

/* What nodes take in for the time of a step, with what stands behind them, but for the front. */
static inline void thermal_slab_right(lanes right[FACET_NODES], const facet_state *state,
                                      const thermal_elimination *e, const thermal_nodes *nodes,
                                      thermal_flux back)
{
    const int last = FACET_NODES - 1;

    right[last] =
        e->between[last] * (state->node_k[last - 1] - state->node_k[last]) +
        e->passed[0] * (back.w_m2 + e->back_slope * (state->back_k - state->node_k[last]));
    for (int j = last - 1; j > 0; j--)
        right[j] =
            fma(e->passed[j + 1], right[j + 1],
                e->between[j] * ((state->node_k[j - 1] - state->node_k[j]) +
                                 nodes->onward[j] * (state->node_k[j + 1] - state->node_k[j])));
    right[0] = fma(e->passed[1], right[1], e->between[1] * (state->node_k[1] - state->node_k[0]));
}

/* The front's face has no capacity: with its flux F - S (T - T_front) and H from it to node 0, node 0
 * rises by (right_0 (H + S) + H F') / (taken_0 (H + S) + H S). One division serves both. */
static inline void thermal_step_slab(facet_state *state, const thermal_body *body,
                                     const thermal_elimination *e, const thermal_nodes *nodes,
                                     const thermal_load *load, moisture_air air, float step_s)
{
    const int last = FACET_NODES - 1;
    const lanes before = e->between[0];
    const lanes began_k = state->front_k;
    moisture_flux dew;
    const thermal_flux front = thermal_wet_flux(body, load, air, state, step_s, &dew);
    const lanes both = before + front.w_m2_k;
    const lanes all = e->inverse[0] * both + before * front.w_m2_k;
    const lanes quotient = 1.0f / (both * all);
    thermal_flux back = {0.0f, 0.0f};
    lanes right[FACET_NODES], rise;

    if (lanes_any(body->back > (lanes)0.0f)) back = thermal_back_flux(body, load, state->back_k);
    thermal_slab_right(right, state, e, nodes, back);
    rise = fma(right[0], both,
               before * (front.w_m2 + front.w_m2_k * (state->front_k - state->node_k[0]))) *
           (quotient * both);
    if (lanes_any(thermal_melts(body))) {
        const lanes free_k =
            state->front_k +
            (front.w_m2 - before * (state->front_k - state->node_k[0] - rise)) * (quotient * all);
        rise = thermal_melting_rise(body, rise, free_k, state->node_k[0], right[0], e->inverse[0],
                                    before);
    }
    state->node_k[0] += rise;
    for (int j = 1; j <= last; j++) {
        rise = fma(e->passed[j], rise, right[j] * e->inverse[j]);
        state->node_k[j] += rise;
    }
    state->front_k +=
        (front.w_m2 - before * (state->front_k - state->node_k[0])) * (quotient * all);
    thermal_melt(state, body);
    state->back_k +=
        (back.w_m2 - e->between[FACET_NODES] * (state->back_k - state->node_k[last])) * e->back_way;
    thermal_step_film(state, air, began_k, &dew, state->front_k - began_k, step_s);
}

static inline lanes thermal_sub_direct(const thermal_load *before, const thermal_load *after, int i,
                                       int count)
{
    return 2 * i < count ? before->direct_w_m2 : after->direct_w_m2;
}

static inline int thermal_sub_steps(float step_s, float most_s)
{
    return 2 * (int)ceil(0.5f * step_s / most_s);
}

/* The way from one record of the weather to the next; the air's vapour is held like the sun. */
typedef struct thermal_way {
    thermal_nodes nodes;
    thermal_load before, after;
    moisture_air air_before, air_after;
    float step_s;
    int count; /* of sub-steps */
} thermal_way;

static inline moisture_air thermal_sub_air(const thermal_way *way, int i)
{
    return 2 * i < way->count ? way->air_before : way->air_after;
}

/* The slab's implicit step takes the load at its end, the lump's at its middle. */
static inline void thermal_advance_slab(facet_state *state, const thermal_body *body,
                                        const thermal_way *way)
{
    const int count = way->count;
    const float step_s = way->step_s / (float)count;
    const thermal_flux back = thermal_back_flux(body, &way->before, state->back_k);
    const thermal_elimination e = thermal_eliminate(body, &way->nodes, back.w_m2_k, step_s);

    for (int i = 0; i < count; i++) {
        const thermal_load load =
            thermal_load_between(&way->before, &way->after, (float)(i + 1) / (float)count,
                                 thermal_sub_direct(&way->before, &way->after, i, count));
        thermal_step_slab(state, body, &e, &way->nodes, &load, thermal_sub_air(way, i), step_s);
    }
}

static inline void thermal_advance_lump(facet_state *state, const thermal_body *body,
                                        const thermal_way *way)
{
    const int count = way->count;
    const float step_s = way->step_s / (float)count;
    const lanes step_k_m2_w = way->step_s / (float)count / body->capacity_j_m2_k;

    for (int i = 0; i < count; i++) {
        const thermal_load load =
            thermal_load_between(&way->before, &way->after, ((float)i + 0.5f) / (float)count,
                                 thermal_sub_direct(&way->before, &way->after, i, count));
        thermal_step_lump(state, body, &load, thermal_sub_air(way, i), step_k_m2_w, step_s);
    }
    state->back_k = state->front_k;
}

/* Slabs and lumps side by side: each goes its own way, the other's is not taken. */
static inline void thermal_advance(facet_state *state, const thermal_body *body,
                                   const thermal_way *way)
{
    const lanes none = 0.0f;
    facet_state as_lump = *state;

    if (lanes_any(body->slab == none)) thermal_advance_lump(&as_lump, body, way);
    if (lanes_any(body->slab != none)) thermal_advance_slab(state, body, way);
    state->front_k = body->slab != none ? state->front_k : as_lump.front_k;
    state->back_k = body->slab != none ? state->back_k : as_lump.back_k;
    state->film_kg_m2 = body->slab != none ? state->film_kg_m2 : as_lump.film_kg_m2;
}

#endif
