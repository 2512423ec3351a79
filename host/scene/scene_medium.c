#include "base/vector.h"
#include "scene/scene_parts.h"

#include <math.h>

/* Fails where a band needs what a table does not have. */
static void check_bands(scene_reader *reader, const scene_material *m, const toml_node *node,
                        const wavelength_grid *grid, const char *what)
{
    char ranges[256];
    const band *b = NULL;
    const double um = scene_uncovered(reader->s, grid, &b);

    if (!isnan(um))
        scene_fail(reader, node, "material %s: band %s needs %s at %.4g um, the table has %s um",
                   m->name, b->name, what, um, wavelength_grid_text(grid, ranges, sizeof ranges));
}

/* Reads a table; beside one without a broad band a number is that. */
static void take_extinction(scene_reader *reader, scene_material *m, const toml_node *node,
                            const char *path, double per_km)
{
    if (!scene_took(reader, extinction_read(&m->extinction, path))) return;
    if (!isnan(per_km)) m->extinction->broad_band_per_m = 1e-3 * per_km;
    if (isnan(m->extinction->broad_band_per_m))
        scene_fail(
            reader, node,
            "material %s: %s has no broad-band extinction, expected extinction_per_km beside "
            "it, that of sunlight",
            m->name, path);
    check_bands(reader, m, node, &m->extinction->grid, "extinction");
}

void scene_read_medium(scene_reader *reader, scene_material *m, const toml_node *node,
                       const char *path, double per_km)
{
    scene *s = reader->s;

    m->medium = RECORD_NONE;
    if (path)
        take_extinction(reader, m, node, path, per_km);
    else if (isnan(per_km))
        return;
    else
        m->grey_extinction_per_m = 1e-3 * per_km;
    if (s->medium_count == TRANSMISSION_MEDIA) {
        scene_fail(reader, node, "material %s: is transmissive, expected %u of them or fewer",
                   m->name, TRANSMISSION_MEDIA);
        return;
    }
    m->medium = s->medium_count;
    s->medium_material[s->medium_count++] = (uint32_t)(m - s->materials);
}

void scene_read_scattering(scene_reader *reader, scene_material *m, const toml_node *node,
                           const char *path)
{
    if (m->medium == RECORD_NONE)
        scene_fail(reader, node,
                   "material %s: states scattering_file and is opaque, expected extinction_file or "
                   "extinction_per_km too",
                   m->name);
    else if (scene_took(reader, scattering_read(&m->scattering, path)))
        check_bands(reader, m, node, &m->scattering->grid, "scattering");
}

/* Three times the volume that a material's facets enclose, their area, and by how much they do not
 * close: the sum of their areas as vectors. */
static void measure(const scene *s, uint32_t material, double *volume, double gap[3], double *area)
{
    const geometry *g = s->shape;

    *volume = *area = gap[0] = gap[1] = gap[2] = 0.0;
    for (uint32_t i = 0; i < g->facet_count; i++) {
        const double area_m2 = (double)g->area_m2[i];
        if (s->material_of[g->material[i]] != material) continue;
        *area += area_m2;
        for (int k = 0; k < 3; k++) {
            const double part = area_m2 * (double)g->normal[i][k];
            gap[k] += part;
            *volume += part * (double)g->position[g->corner[i][0]][k];
        }
    }
}

static void check_body(scene_reader *reader, const scene_material *m)
{
    const scene *s = reader->s;
    const uint32_t material = (uint32_t)(m - s->materials);
    double volume, gap[3], area;

    measure(s, material, &volume, gap, &area);
    if (vector_length(gap) > 1e-4 * area)
        scene_fail(reader, NULL,
                   "material %s: is transmissive, but its facets do not close: expected surfaces "
                   "without holes",
                   m->name);
    else if (area > 0.0 && volume <= 0.0)
        scene_fail(reader, NULL,
                   "material %s: is transmissive, but its facets face inwards: expected corners "
                   "that run counter-clockwise seen from outside",
                   m->name);
    if (s->air && s->air->level_count == 0 && m->temperature_k == 0.0)
        scene_fail(
            reader, NULL,
            "material %s: is transmissive and has no temperature: state temperature_k in its "
            "[[material]], the atmosphere knows none of the air",
            m->name);
    if (material == s->ground_material)
        scene_fail(reader, NULL, "ground_material %s: is transmissive, expected an opaque one",
                   m->name);
}

void scene_check_media(scene_reader *reader)
{
    for (uint32_t i = 0; i < reader->s->medium_count; i++)
        check_body(reader, &reader->s->materials[reader->s->medium_material[i]]);
}
