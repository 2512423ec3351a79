#include "material/layered.h"

#include <math.h>
#include <string.h>

#define NODE_RATIO 1.5
#define GROUND_DEPTH_M 1.0
#define FILM_LIMIT_KG_M2 0.2 /* assumed: what rain leaves on a surface */

#define LUMP_W_M2_K 1e4 /* far above all that a surface exchanges */

enum { LAYERS = LAYERED_LAYERS_BEHIND + 1 };

layered_matter layered_matter_default(void)
{
    return (layered_matter){.back_k = NAN, .resistance_day_s_m = NAN, .resistance_night_s_m = NAN};
}

/* Heat capacity and resistance from the surface down to a depth. */
typedef struct column {
    size_t count;
    layered_layer layer[LAYERS];
    double depth_m;
} column;

static double resistance_to(const column *c, double depth_m)
{
    double sum = 0.0, top_m = 0.0;

    for (size_t i = 0; i < c->count; i++) {
        const double part_m = fmin(c->layer[i].thickness_m, depth_m - top_m);
        if (part_m > 0.0) sum += part_m / c->layer[i].conductivity_w_m_k;
        top_m += c->layer[i].thickness_m;
    }
    return sum;
}

static double capacity_to(const column *c, double depth_m)
{
    double sum = 0.0, top_m = 0.0;

    for (size_t i = 0; i < c->count; i++) {
        const double part_m = fmin(c->layer[i].thickness_m, depth_m - top_m);
        if (part_m > 0.0) sum += part_m * c->layer[i].capacity_j_m3_k;
        top_m += c->layer[i].thickness_m;
    }
    return sum;
}

static column column_of(const facet_record *facet, const material_record *material,
                        const layered_matter *matter)
{
    column c = {.count = 1 + matter->layer_count};
    const double stated = (double)material->conductivity_w_m_k;
    const double lump = LUMP_W_M2_K * (double)facet->thickness_m;

    c.layer[0] = (layered_layer){
        .thickness_m = (double)facet->thickness_m,
        .conductivity_w_m_k = stated > 0.0 ? stated : lump,
        .capacity_j_m3_k = (double)material->density_kg_m3 * (double)material->specific_heat_j_kg_k,
    };
    for (size_t i = 0; i < matter->layer_count; i++) c.layer[i + 1] = matter->layer[i];
    for (size_t i = 0; i < c.count; i++) c.depth_m += c.layer[i].thickness_m;
    if (matter->back == LAYERED_BACK_GROUND && c.depth_m < GROUND_DEPTH_M) {
        c.layer[c.count - 1].thickness_m += GROUND_DEPTH_M - c.depth_m;
        c.depth_m = GROUND_DEPTH_M;
    }
    return c;
}

static void fill_ladder(layered_record *out, const column *c)
{
    double edge_m = 0.0, before = 0.0;
    double node_m = c->depth_m * (NODE_RATIO - 1.0) / (pow(NODE_RATIO, FACET_NODES) - 1.0);

    for (int j = 0; j < FACET_NODES; j++) {
        const double to_centre = resistance_to(c, edge_m + 0.5 * node_m);
        out->capacity_j_m2_k[j] = (float)(capacity_to(c, edge_m + node_m) - capacity_to(c, edge_m));
        out->conductance_w_m2_k[j] = (float)(1.0 / (to_centre - before));
        before = to_centre;
        edge_m += node_m;
        node_m *= NODE_RATIO;
    }
    out->conductance_w_m2_k[FACET_NODES] = (float)(1.0 / (resistance_to(c, c->depth_m) - before));
}

/* How heat along the facet is spread: by the thickness that nodes have of the front's material. */
static void fill_lateral_fraction(layered_record *out, const column *c)
{
    const double front_m = c->layer[0].thickness_m;
    double edge_m = 0.0;
    double node_m = c->depth_m * (NODE_RATIO - 1.0) / (pow(NODE_RATIO, FACET_NODES) - 1.0);

    for (int j = 0; j < FACET_NODES; j++) {
        const double part_m = fmin(node_m, front_m - edge_m);
        out->lateral_fraction[j] = (float)(fmax(0.0, part_m) / front_m);
        edge_m += node_m;
        node_m *= NODE_RATIO;
    }
}

static uint32_t back_of(const layered_matter *matter, const material_record *material)
{
    switch (matter->back) {
    case LAYERED_BACK_AIR:
        return LAYERED_AIR;
    case LAYERED_BACK_STATED:
    case LAYERED_BACK_GROUND:
        return LAYERED_STATED;
    case LAYERED_BACK_BY_AREA:
        return fabsf(material->exposed_area) > 0.75f ? LAYERED_AIR : LAYERED_ADIABATIC;
    case LAYERED_BACK_ADIABATIC:
        break;
    }
    return LAYERED_ADIABATIC;
}

static float resistance(double stated_s_m)
{
    return isnan(stated_s_m) ? -1.0f : (float)stated_s_m;
}

void layered_fill(layered_record *out, const facet_record *facet, const material_record *material,
                  const layered_matter *matter, double mean_air_k)
{
    const column c = column_of(facet, material, matter);

    *out = (layered_record){
        .absorptance = material->solar_absorptance,
        .emissivity = material->thermal_emissivity,
        .melts_k = material->melts_k,
        .power_w_m2 = facet->power_w_m2,
        .two_sided = facet->two_sided,
        .back = back_of(matter, material),
        .back_k = (float)(isnan(matter->back_k) ? mean_air_k : matter->back_k),
        .resistance_day_s_m = resistance(matter->resistance_day_s_m),
        .resistance_night_s_m = resistance(matter->resistance_night_s_m),
        .film_limit_kg_m2 = (float)FILM_LIMIT_KG_M2,
        .material = facet->material,
        .lateral_column = facet->lateral_column,
        .received_column = facet->received_column,
    };
    memcpy(out->normal, facet->normal, sizeof out->normal);
    fill_ladder(out, &c);
    fill_lateral_fraction(out, &c);
}
