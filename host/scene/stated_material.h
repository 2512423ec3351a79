/* Stated material: what one [[material]] says, of a scene or of a library. */
#ifndef STATED_MATERIAL_H
#define STATED_MATERIAL_H

#include "scene/scene_parts.h"

/* Not-a-number and NULL: nothing was stated. */
typedef struct stated_material {
    const toml_node *node;
    const char *name, *emissivity_path, *extinction_path, *scattering_path;
    double emissivity, specular_share, roughness, temperature_k, thickness_cm;
    double density_kg_m3, specific_heat_j_kg_k, conductivity_w_m_k;
    double solar_absorptance, exposed_area, extinction_per_km, melting_c;
    bool two_sided;
    layered_matter layered;
    heat_schedule power;
    stated_spectrum spectrum;
    uint32_t number; /* among those that no .mat has, from 0 */
} stated_material;

/* States nothing. */
stated_material stated_material_default(void);

/* Reads a table; its failures are kept by the reader.
 *   base   of a library, which it changes in what it states; NULL: none. Stating one of emissivity,
 *          emissivity_file and spectrum_file drops the others of the base */
stated_material stated_material_read(scene_reader *reader, const toml_node *node,
                                     const stated_material *base);

#endif
