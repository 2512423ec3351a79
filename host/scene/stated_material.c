#include "scene/stated_material.h"

#include <math.h>

stated_material stated_material_default(void)
{
    return (stated_material){.name = "",
                             .emissivity = NAN,
                             .specular_share = NAN,
                             .roughness = NAN,
                             .temperature_k = NAN,
                             .thickness_cm = NAN,
                             .density_kg_m3 = NAN,
                             .specific_heat_j_kg_k = NAN,
                             .conductivity_w_m_k = NAN,
                             .solar_absorptance = NAN,
                             .exposed_area = NAN,
                             .extinction_per_km = NAN,
                             .melting_c = NAN,
                             .layered = layered_matter_default(),
                             .spectrum = stated_spectrum_default()};
}

/* What a table begins with: the base, without its emissivity where the table states another one. */
static stated_material begin(scene_table *t, const stated_material *base)
{
    static const char *const keys[] = {"emissivity", "emissivity_file", "spectrum_file"};
    stated_material m = base ? *base : stated_material_default();

    for (size_t i = 0; i < sizeof keys / sizeof *keys; i++) {
        if (!scene_table_has(t, keys[i])) continue;
        m.emissivity = NAN;
        m.emissivity_path = NULL;
        m.spectrum = stated_spectrum_default();
    }
    m.node = t->node;
    return m;
}

stated_material stated_material_read(scene_reader *reader, const toml_node *node,
                                     const stated_material *base)
{
    scene_table t = scene_table_open(reader, node, "material");
    stated_material m = begin(&t, base);

    scene_table_require(&t, "name", "the name that the geometry gives it");
    scene_table_name(&t, "name", "", "a name", &m.name);
    scene_table_number(&t, "emissivity", 0.0, 1.0, &m.emissivity);
    scene_table_file(&t, "emissivity_file", &m.emissivity_path);
    scene_read_spectrum(&t, &m.spectrum);
    scene_table_number(&t, "extinction_per_km", 0.0, 1e6, &m.extinction_per_km);
    scene_table_file(&t, "extinction_file", &m.extinction_path);
    scene_table_file(&t, "scattering_file", &m.scattering_path);
    scene_table_number(&t, "specular_share", 0.0, 1.0, &m.specular_share);
    scene_table_number(&t, "roughness", 0.0, 1.0, &m.roughness);
    scene_table_number(&t, "temperature_k", 1.0, 6000.0, &m.temperature_k);
    scene_table_number(&t, "thickness_cm", 1e-4, 1e4, &m.thickness_cm);
    scene_table_number(&t, "density_kg_m3", .01, 3e4, &m.density_kg_m3);
    scene_table_number(&t, "specific_heat_j_kg_k", 1.0, 2e4, &m.specific_heat_j_kg_k);
    scene_table_number(&t, "conductivity_w_m_k", 0.0, 5e3, &m.conductivity_w_m_k);
    scene_table_number(&t, "solar_absorptance", 0.0, 1.0, &m.solar_absorptance);
    scene_table_number(&t, "exposed_area", -1.0, 1.0, &m.exposed_area);
    scene_table_number(&t, "melting_temperature_c", -100.0, 1000.0, &m.melting_c);
    scene_table_bool(&t, "two_sided", &m.two_sided);
    scene_read_layered(&t, &m.layered);
    scene_read_power(&t, &m.power);
    scene_table_close(&t);
    return m;
}
