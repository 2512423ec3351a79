#include "kernels/radiance/gloss.h"

/* Casts the rays of the specular lobes of rough surfaces.
 * Launch: (frame.pixel_count, LOBE_RAYS). facets, materials, hit: as incident.cl
 * out_met: (LOBE_RAYS, pixel_count): as hemisphere.cl writes it; written where a surface is rough */
kernel void gloss(const radiometry_record frame, const camera_record camera,
                  const world_record world, global const bvh_node *nodes,
                  global const bvh_block *blocks, global const facet_record *facets,
                  global const material_record *materials, global const hit_record *hit,
                  global uint *out_met)
{
    const uint pixel = get_global_id(0), number = get_global_id(1);
    if (pixel >= frame.pixel_count) return;
    const hit_record at = hit[pixel];
    if (at.facet == RECORD_NONE) return;
    const material_record material = materials[facets[at.facet].material];
    float direction[3];
    if (gloss_count(material) < 2u) return;

    gloss_direction(frame, camera, &at, material, pixel, number, direction);
    const ray r = ray_leaving(&world, at.point, at.normal, direction);
    const hit_record met = hemisphere_record(&r, ray_closest(nodes, blocks, &r), &world, blocks);
    uint word = met.facet;
    if (met.facet != RECORD_NONE && frame.sun[2] > 0.0f &&
        pixel_dot(met.normal, frame.sun) > 0.0f) {
        const ray towards_sun = ray_leaving(&world, met.point, met.normal, frame.sun);
        if (met.facet == world.ground_facet || !ray_any(nodes, blocks, &towards_sun))
            word |= HEMISPHERE_LIT;
    }
    out_met[(size_t)number * frame.pixel_count + pixel] = word;
}
