/* Thermal: the heat balance of one facet, a reconstruction of THERM. Thesis 2.2; the equations of
 * the original are not public. Facets know nothing of each other.
 *   exposed area A   e = min(1, 2 |A|) scales all that the front exchanges, the sun included;
 *                    max(0, 2 |A| - 1) is the back's share, which sees black surroundings and air
 *                    at air temperature; A >= 0 one node, A < 0 a slab of 8
 *   surroundings     below the horizon: air temperature, reflectance .15; the sky's share of the
 *                    view is (1 + cos slope) / 2
 *   start            steady balance with the first record
 * assumed: all of these; see docs/departures.md. */
#ifndef THERMAL_KERNEL_H
#define THERMAL_KERNEL_H

#include "constants.h"
#include "dialect.h"
#include "records.h"

#define THERMAL_NODES 8
#define THERMAL_SUB_STEP_S 300.0f /* at most */
#define THERMAL_GROUND_REFLECTANCE 0.15f

/* What to compute. Row r holds the temperature at step first_step + r - 1 + weight, linear between
 * steps; at step 0 the weight is 1. */
typedef struct thermal_span {
    uint facet_count;
    uint first_step;
    uint row_count;
    uint sunlit_words; /* words per facet in the sunlit mask; 0: no mask, always lit */
    float weight;      /* above 0, at most 1 */
    float step_s;
    uint sunlit_period; /* steps after which the mask begins anew; 0: never */
    uint unused;
} thermal_span;
RECORD_SIZE(thermal_span, 32);

/* What does not change with time. */
typedef struct thermal_body {
    float normal[3];
    uint two_sided;
    uint slab;
    float front, back; /* exposed shares */
    float absorptance, emissivity;
    float power_w_m2;
    float capacity_j_m2_k; /* of the whole thickness */
    float conductance_w_m2_k;
} thermal_body;

/* What one instant of the weather does to a body. */
typedef struct thermal_load {
    float direct_w_m2; /* absorbed of the direct beam */
    float steady_w_m2; /* all else that the front takes in whatever its temperature */
    float back_w_m2;   /* the same for the back */
    float convection_w_m2_k, air_k;
    float rain_w_m2_k, rain_k;
} thermal_load;

typedef struct thermal_state {
    float front_k, back_k;
    float node_k[THERMAL_NODES];
} thermal_state;

/* A flux into a face and how much it falls per kelvin that the face gets warmer. */
typedef struct thermal_flux {
    float w_m2, w_m2_k;
} thermal_flux;

static inline thermal_body thermal_body_of(facet_record facet, material_record material)
{
    const float twice = 2.0f * fabs(material.exposed_area);
    thermal_body body;

    for (int i = 0; i < 3; i++) body.normal[i] = facet.normal[i];
    body.two_sided = facet.two_sided;
    body.slab = material.exposed_area < 0.0f && facet.thickness_m > 0.0f &&
                material.conductivity_w_m_k > 0.0f;
    body.front = fmin(1.0f, twice);
    body.back = fmax(0.0f, twice - 1.0f);
    body.absorptance = material.solar_absorptance;
    body.emissivity = material.thermal_emissivity;
    body.power_w_m2 = facet.power_w_m2;
    body.capacity_j_m2_k =
        material.density_kg_m3 * material.specific_heat_j_kg_k * facet.thickness_m;
    body.conductance_w_m2_k = body.slab ? material.conductivity_w_m_k / facet.thickness_m : 0.0f;
    return body;
}

static inline float thermal_black_w_m2(float temperature_k)
{
    const float square = temperature_k * temperature_k;

    return STEFAN_BOLTZMANN * square * square;
}

/* lit: 1 where the sun reaches the facet, 0 in shadow. */
static inline thermal_load thermal_load_of(thermal_body body, forcing_record now, float lit)
{
    const float sky = 0.5f * (1.0f + body.normal[2]), ground = 1.0f - sky;
    const float cosine =
        body.normal[0] * now.sun[0] + body.normal[1] * now.sun[1] + body.normal[2] * now.sun[2];
    const float facing = body.two_sided ? fabs(cosine) : fmax(0.0f, cosine);
    const float level_w_m2 = now.direct_w_m2 * fmax(0.0f, now.sun[2]) + now.diffuse_w_m2;
    const float air_w_m2 = thermal_black_w_m2(now.air_temperature_k);
    const float sun_w_m2 =
        sky * now.diffuse_w_m2 + ground * THERMAL_GROUND_REFLECTANCE * level_w_m2;
    const float longwave_w_m2 = sky * now.sky_longwave_w_m2 + ground * air_w_m2;
    thermal_load load;

    load.direct_w_m2 = body.front * body.absorptance * lit * facing * now.direct_w_m2;
    load.steady_w_m2 = body.power_w_m2 +
                       body.front * (body.absorptance * sun_w_m2 + body.emissivity * longwave_w_m2);
    load.back_w_m2 = body.back * body.emissivity * air_w_m2;
    load.convection_w_m2_k = now.convection_w_m2_k;
    load.air_k = now.air_temperature_k;
    /* assumed: rain falls straight down. */
    load.rain_w_m2_k = body.front * fmax(0.0f, body.normal[2]) * now.rain_w_m2_k;
    load.rain_k = now.rain_temperature_k;
    return load;
}

/* Linear between two records but for the direct beam: that of the nearer one is held, so that the
 * edge of a shadow stays an edge. */
static inline thermal_load thermal_load_between(thermal_load a, thermal_load b, float share,
                                                float direct_w_m2)
{
    thermal_load load;

    load.direct_w_m2 = direct_w_m2;
    load.steady_w_m2 = a.steady_w_m2 + share * (b.steady_w_m2 - a.steady_w_m2);
    load.back_w_m2 = a.back_w_m2 + share * (b.back_w_m2 - a.back_w_m2);
    load.convection_w_m2_k =
        a.convection_w_m2_k + share * (b.convection_w_m2_k - a.convection_w_m2_k);
    load.air_k = a.air_k + share * (b.air_k - a.air_k);
    load.rain_w_m2_k = a.rain_w_m2_k + share * (b.rain_w_m2_k - a.rain_w_m2_k);
    load.rain_k = a.rain_k + share * (b.rain_k - a.rain_k);
    return load;
}

static inline thermal_flux thermal_front_flux(thermal_body body, thermal_load load, float front_k)
{
    const float emitted_w_m2 = body.front * body.emissivity * thermal_black_w_m2(front_k);
    const float convection_w_m2_k = body.front * load.convection_w_m2_k;
    thermal_flux flux;

    flux.w_m2 = load.direct_w_m2 + load.steady_w_m2 - emitted_w_m2 +
                convection_w_m2_k * (load.air_k - front_k) +
                load.rain_w_m2_k * (load.rain_k - front_k);
    flux.w_m2_k = 4.0f * emitted_w_m2 / front_k + convection_w_m2_k + load.rain_w_m2_k;
    return flux;
}

static inline thermal_flux thermal_back_flux(thermal_body body, thermal_load load, float back_k)
{
    const float emitted_w_m2 = body.back * body.emissivity * thermal_black_w_m2(back_k);
    const float convection_w_m2_k = body.back * load.convection_w_m2_k;
    thermal_flux flux;

    flux.w_m2 = load.back_w_m2 - emitted_w_m2 + convection_w_m2_k * (load.air_k - back_k);
    flux.w_m2_k = 4.0f * emitted_w_m2 / back_k + convection_w_m2_k;
    return flux;
}

/* Steady balance by Newton's method: both faces of a slab, or one temperature. Starts at the
 * air temperature and stays there where nothing is exchanged. */
static inline thermal_state thermal_start(thermal_body body, thermal_load load)
{
    const float through = body.conductance_w_m2_k;
    thermal_state state;

    state.front_k = state.back_k = load.air_k;
    for (int i = 0; i < 24; i++) {
        const thermal_flux front = thermal_front_flux(body, load, state.front_k);
        const thermal_flux back = thermal_back_flux(body, load, state.back_k);
        const float both = front.w_m2_k + back.w_m2_k;
        if (both <= 0.0f) break;
        if (body.slab) {
            const float passed = through * (state.front_k - state.back_k);
            const float in_front = front.w_m2 - passed, in_back = back.w_m2 + passed;
            const float scale = 1.0f / (front.w_m2_k * back.w_m2_k + through * both);
            state.front_k += scale * ((back.w_m2_k + through) * in_front + through * in_back);
            state.back_k += scale * ((front.w_m2_k + through) * in_back + through * in_front);
        } else {
            state.front_k += (front.w_m2 + back.w_m2) / both;
            state.back_k = state.front_k;
        }
    }
    for (int i = 0; i < THERMAL_NODES; i++)
        state.node_k[i] =
            state.front_k + ((float)i + 0.5f) / THERMAL_NODES * (state.back_k - state.front_k);
    return state;
}

/* One node: T <- Teq + (T - Teq) exp(-Lambda dt / C), exact for a constant load, so that thin
 * sheets need no shorter steps. */
static inline void thermal_step_lump(thermal_state *state, thermal_body body, thermal_load load,
                                     float step_s)
{
    const thermal_flux front = thermal_front_flux(body, load, state->front_k);
    const thermal_flux back = thermal_back_flux(body, load, state->front_k);
    const float flux_w_m2 = front.w_m2 + back.w_m2, lambda = front.w_m2_k + back.w_m2_k;
    const float steps = step_s / body.capacity_j_m2_k, decay = lambda * steps;

    state->front_k += decay > 1e-4f ? -expm1(-decay) * flux_w_m2 / lambda : flux_w_m2 * steps;
    state->back_k = state->front_k;
}

/* A face without capacity in front of a node's half thickness, linearised: the heat that reaches
 * the node is `entering` minus `yielding` times the node's rise. */
typedef struct thermal_boundary {
    float entering, yielding;
} thermal_boundary;

static inline thermal_boundary thermal_boundary_of(thermal_flux flux, float half_w_m2_k,
                                                   float face_k, float node_k)
{
    const float share = half_w_m2_k / (half_w_m2_k + flux.w_m2_k);
    thermal_boundary boundary;

    boundary.entering = share * (flux.w_m2 + flux.w_m2_k * (face_k - node_k));
    boundary.yielding = share * flux.w_m2_k;
    return boundary;
}

static inline float thermal_face_k(thermal_flux flux, float half_w_m2_k, float face_k, float node_k)
{
    return face_k + (flux.w_m2 - half_w_m2_k * (face_k - node_k)) / (half_w_m2_k + flux.w_m2_k);
}

/* Eight equal nodes, backward Euler, solved for the rises so that single precision suffices:
 * C dT_j/dt = G (T_{j-1} - T_j) + G (T_{j+1} - T_j). */
static inline void thermal_step_slab(thermal_state *state, thermal_body body, thermal_load load,
                                     float step_s)
{
    const float between = body.conductance_w_m2_k * THERMAL_NODES, half_way = 2.0f * between;
    const float stored = body.capacity_j_m2_k / (THERMAL_NODES * step_s);
    const thermal_flux front = thermal_front_flux(body, load, state->front_k);
    const thermal_flux back = thermal_back_flux(body, load, state->back_k);
    const thermal_boundary first =
        thermal_boundary_of(front, half_way, state->front_k, state->node_k[0]);
    const thermal_boundary last =
        thermal_boundary_of(back, half_way, state->back_k, state->node_k[THERMAL_NODES - 1]);
    float upper[THERMAL_NODES], rise[THERMAL_NODES];

    for (int j = 0; j < THERMAL_NODES; j++) {
        float diagonal = stored, right = 0.0f;
        if (j > 0) {
            diagonal += between * (1.0f - upper[j - 1]);
            right += between * (state->node_k[j - 1] - state->node_k[j] + rise[j - 1]);
        } else {
            diagonal += first.yielding;
            right += first.entering;
        }
        if (j < THERMAL_NODES - 1) {
            diagonal += between;
            right += between * (state->node_k[j + 1] - state->node_k[j]);
        } else {
            diagonal += last.yielding;
            right += last.entering;
        }
        upper[j] = between / diagonal;
        rise[j] = right / diagonal;
    }
    for (int j = THERMAL_NODES - 2; j >= 0; j--) rise[j] += upper[j] * rise[j + 1];
    for (int j = 0; j < THERMAL_NODES; j++) state->node_k[j] += rise[j];
    state->front_k = thermal_face_k(front, half_way, state->front_k, state->node_k[0]);
    state->back_k = thermal_face_k(back, half_way, state->back_k, state->node_k[THERMAL_NODES - 1]);
}

/* Goes from one record of the weather to the next. */
static inline void thermal_advance(thermal_state *state, thermal_body body, thermal_load before,
                                   thermal_load after, float step_s)
{
    const int half_count = (int)ceil(0.5f * step_s / THERMAL_SUB_STEP_S), count = 2 * half_count;

    for (int i = 0; i < count; i++) {
        /* The slab's implicit step takes the load at its end, the lump's at its middle. */
        const float share = ((float)i + (body.slab ? 1.0f : 0.5f)) / (float)count;
        const float direct_w_m2 = i < half_count ? before.direct_w_m2 : after.direct_w_m2;
        const thermal_load load = thermal_load_between(before, after, share, direct_w_m2);
        if (body.slab)
            thermal_step_slab(state, body, load, step_s / (float)count);
        else
            thermal_step_lump(state, body, load, step_s / (float)count);
    }
}

#endif
