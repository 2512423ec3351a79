#include "kernels/rays/camera.h"
#include "kernels/rays/ray.h"
#include "kernels/tables.h"

/* Replaces the background of targets with a specular share by what the mirrored ray meets (thesis 2.5.6): a facet
 * (shape factor 0) or the sky (1).
 * Launch: (count). hit: per pixel; background: per pixel, changed where the target has a specular fraction */
SHARED_BODY kernel void mirror(const uint count, const camera_record camera, TABLES(TREE_TABLES),
                               TABLES(SURFACE_TABLES), global const hit_record *hit,
                               global background_record *background)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const hit_record at = hit[i];
    if (at.facet == RECORD_NONE) return;
    if (surfaces.materials[surfaces.facets[at.facet].material].specular_share == 0.0f) return;

    background_record back = {.shape_factor = 1.0f, .material = RECORD_NONE, .facet = RECORD_NONE};
    float direction[3], towards = 0.0f;

    camera_towards(camera, at.point, direction);
    for (int k = 0; k < 3; k++) towards += direction[k] * at.normal[k];
    for (int k = 0; k < 3; k++) direction[k] -= 2.0f * towards * at.normal[k];
    vstore3(normalize(vload3(0, direction)), 0, direction);
    const ray r = ray_leaving(&tree.world, at.point, at.normal, direction);
    hit_record met = ray_record(tree.blocks, &r, ray_closest(tree.nodes, tree.blocks, &r));
    if (met.facet == RECORD_NONE) ray_meet_ground(&tree.world, &r, &met);
    if (met.facet != RECORD_NONE) {
        back.shape_factor = 0.0f;
        back.mean_temperature_k = surfaces.facet_temperature_k[met.facet];
        back.material = surfaces.facets[met.facet].material;
        back.facet = met.facet;
        back.met_count = 1;
        vstore3(vload3(0, met.point), 0, back.point);
        vstore3(vload3(0, met.normal), 0, back.normal);
    }
    background[i] = back;
}
