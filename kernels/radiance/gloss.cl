#include "kernels/radiance/gloss.h"

/* Casts the rays of the specular lobes of rough surfaces.
 * Launch: (frame.pixel_count, LOBE_RAYS). hit: per pixel
 * out_met: (LOBE_RAYS, pixel_count): as hemisphere.cl writes it; written where a surface is rough */
kernel void gloss(const radiometry_record frame, const camera_record camera, TABLES(TREE_TABLES),
                  TABLES(SURFACE_TABLES), global const hit_record *hit, global uint *out_met)
{
    const uint pixel = get_global_id(0), number = get_global_id(1);
    if (pixel >= frame.pixel_count) return;
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const hit_record at = hit[pixel];
    if (at.facet == RECORD_NONE) return;
    const material_record material = surfaces.materials[surfaces.facets[at.facet].material];
    float direction[3];
    if (gloss_count(material) < 2u) return;

    gloss_direction(frame, camera, &at, material, pixel, number, direction);
    const ray r = ray_leaving(&tree.world, at.point, at.normal, direction);
    const hit_record met = hemisphere_record(&r, ray_closest(tree.nodes, tree.blocks, &r), &tree);
    uint word = met.facet;
    if (met.facet != RECORD_NONE && frame.sun[2] > 0.0f &&
        pixel_dot(met.normal, frame.sun) > 0.0f) {
        const ray towards_sun = ray_leaving(&tree.world, met.point, met.normal, frame.sun);
        if (met.facet == tree.world.ground_facet || !ray_any(tree.nodes, tree.blocks, &towards_sun))
            word |= HEMISPHERE_LIT;
    }
    out_met[(size_t)number * frame.pixel_count + pixel] = word;
}
