#include "scene/scene_parts.h"

#include <math.h>

static void read_layer(scene_reader *reader, const toml_node *node, layered_layer *out)
{
    scene_table t = scene_table_open(reader, node, "material.layers");
    double thickness_cm = 1.0, density_kg_m3 = 0.0, specific_heat_j_kg_k = 0.0;

    scene_table_require(&t, "thickness_cm", "cm");
    scene_table_require(&t, "conductivity_w_m_k", "W/m/K");
    scene_table_require(&t, "density_kg_m3", "kg/m3");
    scene_table_require(&t, "specific_heat_j_kg_k", "J/kg/K");
    scene_table_number(&t, "thickness_cm", 1e-4, 1e4, &thickness_cm);
    scene_table_number(&t, "conductivity_w_m_k", 1e-3, 5e3, &out->conductivity_w_m_k);
    scene_table_number(&t, "density_kg_m3", .01, 3e4, &density_kg_m3);
    scene_table_number(&t, "specific_heat_j_kg_k", 1.0, 2e4, &specific_heat_j_kg_k);
    scene_table_close(&t);
    out->thickness_m = .01 * thickness_cm;
    out->capacity_j_m3_k = density_kg_m3 * specific_heat_j_kg_k;
}

static void read_layers(scene_table *t, layered_matter *out)
{
    const toml_node *list = scene_table_node(t, "layers");
    const size_t count = list ? toml_node_count(list) : 0;

    if (!list) return;
    if (toml_node_kind(list) != TOML_ARRAY || count < 1 || count > LAYERED_LAYERS_BEHIND) {
        scene_fail(t->reader, list,
                   "%s: expected 1 to %d tables, from the front to the back: layers = "
                   "[{ thickness_cm = 10, conductivity_w_m_k = 1.0, density_kg_m3 = 1800, "
                   "specific_heat_j_kg_k = 900 }]",
                   toml_node_name(list), LAYERED_LAYERS_BEHIND);
        return;
    }
    for (size_t i = 0; i < count; i++) read_layer(t->reader, toml_node_at(list, i), &out->layer[i]);
    out->layer_count = count;
}

static void read_resistance(scene_table *t, layered_matter *out)
{
    const toml_node *node = scene_table_node(t, "surface_resistance_s_m");
    scene_table r = scene_table_open(t->reader, node, "material.surface_resistance_s_m");

    if (!node) return;
    scene_table_require(&r, "day", "s/m, 0 for a wet surface");
    scene_table_require(&r, "night", "s/m");
    scene_table_number(&r, "day", 0.0, LAYERED_RESISTANCE_MOST_S_M, &out->resistance_day_s_m);
    scene_table_number(&r, "night", 0.0, LAYERED_RESISTANCE_MOST_S_M, &out->resistance_night_s_m);
    scene_table_close(&r);
}

void scene_read_layered(scene_table *t, layered_matter *out)
{
    static const char *const backs[] = {"adiabatic", "air", "stated", "ground"};
    int back = 0;
    double celsius;

    read_layers(t, out);
    read_resistance(t, out);
    if (scene_table_word(t, "back", backs, 4, &back))
        out->back = (layered_back)(LAYERED_BACK_ADIABATIC + back);
    if (scene_table_number(t, "back_temperature_c", -100.0, 1000.0, &celsius))
        out->back_k = celsius + 273.15;
    if (!isnan(out->back_k) && out->back != LAYERED_BACK_STATED && out->back != LAYERED_BACK_GROUND)
        scene_fail(t->reader, scene_table_node(t, "back_temperature_c"),
                   "back_temperature_c: needs back = \"stated\" or \"ground\"");
}
