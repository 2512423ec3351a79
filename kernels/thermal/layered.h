/* Layered: the heat balance of one facet of several layers, beyond the thesis' THERM: unequal nodes,
 * a condition behind, evaporation. Backward Euler, relinearised each sub-step.
 *   surroundings, sky, rain   as thermal.h has them; the whole front is exposed; or longwave as it
 *                             comes from sky and facets
 *   evaporation               rho L (q*(Ts) - qa) / (ra + rs), ra = rho cp / h; none from dry matter
 *   film                      rain that stays, up to a limit, and dew (moisture.h) evaporate without rs
 *   along the facet           heat from its neighbours is spread over the nodes of its own material by
 *                             their thickness
 *   start                     the first day over and over until no node moves by 0.01 K */
#ifndef LAYERED_KERNEL_H
#define LAYERED_KERNEL_H

#include "kernels/thermal/thermal.h"

#define LAYERED_RAIN_J_M3_K 4.182e6f /* density times specific heat of water */

#define LAYERED_ADIABATIC 0u
#define LAYERED_AIR 1u    /* air and black surroundings at its temperature */
#define LAYERED_STATED 2u /* the back face keeps a temperature */

/* A facet. The ladder runs from the front: conductance 0 from the face to node 0, j from node j - 1
 * to node j, the last from the last node to the back face. */
typedef struct layered_record {
    float capacity_j_m2_k[FACET_NODES];
    float conductance_w_m2_k[FACET_NODES + 1];
    float normal[3];
    float absorptance, emissivity;
    float power_w_m2;
    uint two_sided;
    uint back; /* LAYERED_... */
    float back_k;
    float resistance_day_s_m, resistance_night_s_m; /* below 0: dry */
    float film_limit_kg_m2;
    float stated_temperature_k; /* 0: to be computed */
    uint material;
    uint lateral_column; /* of rows of heat along the facet, counted from 1; 0: none */
    float lateral_fraction[FACET_NODES]; /* of that heat, for each node; sum 1 */
    float sky_fraction;                  /* of the view */
    uint received_column; /* of rows of longwave that reaches the front, counted from 1; 0: none */
    float melts_k;        /* the surface gets no warmer; 0: it does not melt */
    uint unused;
} layered_record;
RECORD_SIZE(layered_record, 176);

typedef struct layered_body {
    thermal_body face; /* capacity and conductance are not used */
    lanes capacity[FACET_NODES], conductance[FACET_NODES + 1];
    lanes is_stated, back_k;
    lanes day_s_m, night_s_m, film_limit;
    lanes stated_k;
    lanes lateral_fraction[FACET_NODES];
    uint material[LANES_WIDTH];
    uint lateral_column[LANES_WIDTH], received_column[LANES_WIDTH];
} layered_body;

/* What the air does to a wet surface: the same for all lanes. */
typedef struct layered_air {
    moisture_air moist;
    convection_air convection;
    float is_day;
    float rain_kg_m2_s;
} layered_air;

#define LAYERED_SET(body, name, lane, value) LANES_SET((body)->name, lane, value)

static inline void layered_set_body(layered_body *body, int lane, const layered_record *record)
{
    for (int i = 0; i < 3; i++) LAYERED_SET(body, face.normal[i], lane, record->normal[i]);
    for (int i = 0; i < FACET_NODES; i++)
        LAYERED_SET(body, capacity[i], lane, record->capacity_j_m2_k[i]);
    for (int i = 0; i <= FACET_NODES; i++)
        LAYERED_SET(body, conductance[i], lane, record->conductance_w_m2_k[i]);
    LAYERED_SET(body, face.two_sided, lane, (float)record->two_sided);
    LAYERED_SET(body, face.slab, lane, 1.0f);
    LAYERED_SET(body, face.front, lane, 1.0f);
    LAYERED_SET(body, face.back, lane, record->back == LAYERED_AIR ? 1.0f : 0.0f);
    LAYERED_SET(body, face.absorptance, lane, record->absorptance);
    LAYERED_SET(body, face.emissivity, lane, record->emissivity);
    LAYERED_SET(body, face.power_w_m2, lane, record->power_w_m2);
    LAYERED_SET(body, is_stated, lane, record->back == LAYERED_STATED ? 1.0f : 0.0f);
    LAYERED_SET(body, back_k, lane, record->back_k);
    LAYERED_SET(body, day_s_m, lane, record->resistance_day_s_m);
    LAYERED_SET(body, night_s_m, lane, record->resistance_night_s_m);
    LAYERED_SET(body, film_limit, lane, record->film_limit_kg_m2);
    LAYERED_SET(body, stated_k, lane, record->stated_temperature_k);
    for (int i = 0; i < FACET_NODES; i++)
        LAYERED_SET(body, lateral_fraction[i], lane, record->lateral_fraction[i]);
    LAYERED_SET(body, face.melts_k, lane,
                record->melts_k > 0.0f ? record->melts_k : THERMAL_NEVER_K);
    body->material[lane] = record->material;
    LAYERED_SET(body, face.sky, lane, record->sky_fraction);
    body->lateral_column[lane] = record->lateral_column;
    body->received_column[lane] = record->received_column;
}

static inline layered_air layered_air_of(forcing_record now)
{
    layered_air air;

    air.moist = moisture_air_of(now);
    air.convection = thermal_air_of(now);
    air.is_day = now.sun[2] > 0.0f ? 1.0f : 0.0f;
    air.rain_kg_m2_s = 1000.0f * now.rain_w_m2_k / LAYERED_RAIN_J_M3_K;
    return air;
}

/* The air's resistance, s/m. */
static inline lanes layered_resistance(const layered_body *body, layered_air air, lanes face_k)
{
    const float heat_j_m3_k = air.moist.density_kg_m3 * MOISTURE_AIR_J_KG_K, least = 1e-3f;

    if (air.convection.law != CONVECTION_WIND)
        return heat_j_m3_k /
               fmax(convection_of(air.convection, body->face.normal[2], face_k), (lanes)least);
    return (lanes)(heat_j_m3_k / fmax(air.convection.wind_w_m2_k, least));
}

/* Heat that evaporation takes, and how much more per kelvin. Dew and a film know no resistance but the
 * air's; what a film does not hold for a step passes through the surface's own. */
static inline moisture_flux layered_latent(const layered_body *body, layered_air air, lanes face_k,
                                           lanes film_kg_m2, float step_s)
{
    const lanes none = 0.0f, one = 1.0f, below_k = air.moist.wet_below_k;
    const lanes stated = air.is_day > 0.0f ? body->day_s_m : body->night_s_m;
    const lanes surface_s_m = film_kg_m2 > none ? none : stated;
    moisture_flux latent = {none, none};

    if (!lanes_any(surface_s_m >= none || face_k < below_k)) return latent;
    const moisture_excess over = moisture_over(air.moist, face_k);
    const lanes heat = moisture_heat(air.moist, face_k);
    const lanes air_s_m = layered_resistance(body, air, face_k);
    const lanes evaporates = surface_s_m < none ? none : one;
    const lanes fraction = evaporates * air.moist.density_kg_m3 * heat / (air_s_m + surface_s_m);
    latent.w_m2 = fraction * over.humidity;
    latent.w_m2_k = fraction * over.per_k;
    if (air.moist.wet_below_k > 0.0f) {
        const lanes bare = air.moist.density_kg_m3 * heat / air_s_m;
        const lanes behind = stated < none ? none : air_s_m / (air_s_m + stated);
        const moisture_flux free = {bare * over.humidity, bare * over.per_k};
        const moisture_flux film = moisture_from_film(free, film_kg_m2, heat, step_s);
        const lanes_mask passes = free.w_m2 > none && behind * free.w_m2 > film.w_m2;
        latent.w_m2 = passes ? behind * free.w_m2 : film.w_m2;
        latent.w_m2_k = passes ? behind * free.w_m2_k : film.w_m2_k;
    }
    return latent;
}

typedef struct layered_elimination {
    lanes passed[FACET_NODES + 1]; /* share of what stands behind that node j passes on */
    lanes inverse[FACET_NODES];
    lanes front_taken;          /* what all nodes take up per kelvin of node 0 */
    lanes back_slope, back_way; /* and 1 / what the back's face gives inwards and outwards */
} layered_elimination;

/* As thermal_eliminate, for unequal nodes. */
static inline layered_elimination layered_eliminate(const layered_body *body, lanes back_slope,
                                                    float step_s)
{
    const int last = FACET_NODES - 1;
    const lanes none = 0.0f, one = 1.0f, behind = body->conductance[FACET_NODES];
    layered_elimination e;
    lanes taken;

    e.back_slope = back_slope;
    e.back_way = 1.0f / (behind + back_slope);
    e.passed[FACET_NODES] = body->is_stated != none ? one : behind * e.back_way;
    taken = body->capacity[last] / step_s +
            (body->is_stated != none ? behind : back_slope * e.passed[FACET_NODES]);
    for (int j = last; j > 0; j--) {
        e.inverse[j] = 1.0f / (body->conductance[j] + taken);
        e.passed[j] = body->conductance[j] * e.inverse[j];
        taken = body->capacity[j - 1] / step_s + taken * e.passed[j];
    }
    e.inverse[0] = none;
    e.passed[0] = none;
    e.front_taken = taken;
    return e;
}

/* What the front takes in, linear about its temperature at the start of a step. */
typedef struct layered_front {
    thermal_flux all;
    moisture_flux latent;
    lanes way;      /* 1 / what the face gives to node 0 and outwards, per kelvin */
    lanes fraction; /* of what reaches the face that goes on to node 0 */
} layered_front;

static inline layered_front layered_front_of(const facet_state *s, const layered_body *body,
                                             const thermal_load *load, layered_air air,
                                             float step_s)
{
    layered_front front;

    front.all = thermal_front_flux(&body->face, load, s->front_k);
    front.latent = layered_latent(body, air, s->front_k, s->film_kg_m2, step_s);
    front.all.w_m2 -= front.latent.w_m2;
    front.all.w_m2_k += front.latent.w_m2_k;
    front.way = 1.0f / (body->conductance[0] + front.all.w_m2_k);
    front.fraction = body->conductance[0] * front.way;
    return front;
}

/* What rain adds up to its own limit, and vapour takes or leaves. */
static inline void layered_step_film(facet_state *s, const layered_body *body,
                                     const layered_front *front, lanes old_front_k, layered_air air,
                                     float step_s)
{
    const lanes none = 0.0f;
    const lanes_mask wet = s->film_kg_m2 > none || front->latent.w_m2 < none;
    const lanes rain = step_s * air.rain_kg_m2_s * fmax(body->face.normal[2], none);

    if (!(air.rain_kg_m2_s > 0.0f) && !lanes_any(wet)) return;
    const lanes lost_w_m2 = front->latent.w_m2 + front->latent.w_m2_k * (s->front_k - old_front_k);
    if (air.moist.wet_below_k > 0.0f) {
        const lanes room = fmax(body->film_limit - s->film_kg_m2, none);
        const lanes film = s->film_kg_m2 + fmin(rain, room);
        s->film_kg_m2 = moisture_film(air.moist, old_front_k, film, wet ? lost_w_m2 : none, step_s);
        return;
    }
    const lanes film =
        s->film_kg_m2 + rain -
        (s->film_kg_m2 > none ? step_s * lost_w_m2 / moisture_heat(air.moist, old_front_k) : none);
    s->film_kg_m2 = fmin(fmax(film, none), body->film_limit);
}

/* Rise of node 0 where the face would melt.
 *   right   of the node, with what comes through a face that does not */
static inline lanes layered_melting_rise(const facet_state *s, const layered_body *body,
                                         const layered_elimination *e, const layered_front *front,
                                         lanes right, lanes rise)
{
    const lanes before = body->conductance[0], node_k = s->node_k[0];
    const lanes through =
        front->fraction * (front->all.w_m2 + front->all.w_m2_k * (s->front_k - node_k));
    const lanes free_k =
        s->front_k + (front->all.w_m2 - before * (s->front_k - node_k - rise)) * front->way;

    return thermal_melting_rise(&body->face, rise, free_k, node_k, right - through, e->front_taken,
                                before);
}

/* Nodes of the front's own material melt too. */
static inline void layered_melt(facet_state *s, const layered_body *body)
{
    const lanes none = 0.0f;

    if (!lanes_any(thermal_melts(&body->face))) return;
    s->front_k = fmin(s->front_k, body->face.melts_k);
    for (int j = 0; j < FACET_NODES; j++)
        s->node_k[j] = body->lateral_fraction[j] > none ? fmin(s->node_k[j], body->face.melts_k)
                                                        : s->node_k[j];
}

/* One implicit step; film and face change with it.
 *   lateral_w_m2   heat that comes along the facet */
static inline void layered_step(facet_state *s, const layered_body *body,
                                const layered_elimination *e, const thermal_load *load,
                                layered_air air, lanes lateral_w_m2, float step_s)
{
    const int last = FACET_NODES - 1;
    const lanes behind = body->conductance[FACET_NODES], before = body->conductance[0];
    const layered_front front = layered_front_of(s, body, load, air, step_s);
    const thermal_flux back = thermal_back_flux(&body->face, load, s->back_k);
    const lanes none = 0.0f, old_front_k = s->front_k;
    const lanes from_back =
        body->is_stated != none
            ? behind * (body->back_k - s->node_k[last])
            : e->passed[FACET_NODES] * (back.w_m2 + e->back_slope * (s->back_k - s->node_k[last]));
    lanes right[FACET_NODES], rise;

    right[last] = body->conductance[last] * (s->node_k[last - 1] - s->node_k[last]) + from_back +
                  body->lateral_fraction[last] * lateral_w_m2;
    for (int j = last - 1; j > 0; j--)
        right[j] = fma(e->passed[j + 1], right[j + 1],
                       body->conductance[j] * (s->node_k[j - 1] - s->node_k[j]) +
                           body->conductance[j + 1] * (s->node_k[j + 1] - s->node_k[j]) +
                           body->lateral_fraction[j] * lateral_w_m2);
    right[0] = body->conductance[1] * (s->node_k[1] - s->node_k[0]) +
               body->lateral_fraction[0] * lateral_w_m2 + e->passed[1] * right[1] +
               front.fraction * (front.all.w_m2 + front.all.w_m2_k * (s->front_k - s->node_k[0]));
    rise = right[0] / (e->front_taken + front.fraction * front.all.w_m2_k);
    if (lanes_any(thermal_melts(&body->face)))
        rise = layered_melting_rise(s, body, e, &front, right[0], rise);
    s->node_k[0] += rise;
    for (int j = 1; j <= last; j++) {
        rise = fma(e->passed[j], rise, right[j] * e->inverse[j]);
        s->node_k[j] += rise;
    }
    s->front_k += (front.all.w_m2 - before * (s->front_k - s->node_k[0])) * front.way;
    s->back_k =
        body->is_stated != none
            ? body->back_k
            : s->back_k + (back.w_m2 - behind * (s->back_k - s->node_k[last])) * e->back_way;
    layered_melt(s, body);
    layered_step_film(s, body, &front, old_front_k, air, step_s);
}

/* Temperature that goes with heat along the facet: the mean over the nodes of its own material. */
static inline lanes layered_lateral_k(const facet_state *s, const layered_body *body)
{
    lanes sum = 0.0f;

    for (int j = 0; j < FACET_NODES; j++) sum += body->lateral_fraction[j] * s->node_k[j];
    return sum;
}

/* Rise of that temperature in a step for each W m-2 that comes along the facet. */
static inline lanes layered_lateral_gain(const layered_body *body, const layered_elimination *e,
                                         const layered_front *front)
{
    lanes right[FACET_NODES], rise, sum;

    right[FACET_NODES - 1] = body->lateral_fraction[FACET_NODES - 1];
    for (int j = FACET_NODES - 2; j >= 0; j--)
        right[j] = body->lateral_fraction[j] + e->passed[j + 1] * right[j + 1];
    rise = right[0] / (e->front_taken + front->fraction * front->all.w_m2_k);
    sum = body->lateral_fraction[0] * rise;
    for (int j = 1; j < FACET_NODES; j++) {
        rise = right[j] * e->inverse[j] + e->passed[j] * rise;
        sum += body->lateral_fraction[j] * rise;
    }
    return sum;
}

/* Goes from one record of the weather to the next. Humidity, rain and day are held like the sun.
 *   lateral_w_m2   heat along the facet in the first and in the second half
 *   count          of sub-steps */
static inline void layered_advance(facet_state *state, const layered_body *body,
                                   const thermal_load *before, const thermal_load *after,
                                   layered_air air_before, layered_air air_after,
                                   const lanes lateral_w_m2[2], float step_s, int count)
{
    const thermal_flux back = thermal_back_flux(&body->face, before, state->back_k);
    const layered_elimination e = layered_eliminate(body, back.w_m2_k, step_s / (float)count);

    for (int i = 0; i < count; i++) {
        const thermal_load load = thermal_load_between(before, after, (float)(i + 1) / (float)count,
                                                       thermal_sub_direct(before, after, i, count));
        layered_step(state, body, &e, &load, 2 * i < count ? air_before : air_after,
                     lateral_w_m2[2 * i >= count], step_s / (float)count);
    }
}

/* A profile without currents but for what passes through: from face to face by resistance. */
static inline void layered_profile(facet_state *out, const layered_body *body, lanes front_k,
                                   lanes back_k)
{
    lanes resistance[FACET_NODES], all = 0.0f;

    for (int j = 0; j < FACET_NODES; j++) {
        all += 1.0f / body->conductance[j];
        resistance[j] = all;
    }
    all += 1.0f / body->conductance[FACET_NODES];
    for (int j = 0; j < FACET_NODES; j++)
        out->node_k[j] = front_k + (back_k - front_k) * (resistance[j] / all);
    out->front_k = front_k;
    out->back_k = back_k;
}

/* A guess, without evaporation: the start's days improve it. */
static inline facet_state layered_guess(const layered_body *body, const thermal_load *load)
{
    const lanes none = 0.0f;
    const lanes air_k = (lanes)load->air_k;
    facet_state state;

    layered_profile(&state, body, air_k, body->is_stated != none ? body->back_k : air_k);
    state.film_kg_m2 = none;
    return state;
}

/* Moves the nodes to where the means of a day put them, so that deep ones need no month: each keeps
 * its own swing and takes the mean of the profile between the faces' means. */
static inline void layered_settle(facet_state *state, const layered_body *body,
                                  const facet_state *mean)
{
    const lanes none = 0.0f;
    const lanes passes = body->is_stated != none || body->face.back != none ? 1.0f + none : none;
    facet_state target;

    layered_profile(&target, body, mean->front_k,
                    mean->front_k + passes * (mean->back_k - mean->front_k));
    for (int j = 0; j < FACET_NODES; j++) state->node_k[j] += target.node_k[j] - mean->node_k[j];
}

#endif
