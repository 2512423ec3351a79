/* Gloss: the rays of a pixel's specular fraction: one for a mirror, LOBE_RAYS for a rough surface. Device
 * only. */
#ifndef GLOSS_H
#define GLOSS_H

#include "kernels/hemisphere/hemisphere.h"
#include "kernels/radiance/pixel.h"

/* Rays of a surface. */
static inline uint gloss_count(material_record material)
{
    if (material.specular_share == 0.0f) return 0u;
    return material.roughness < LOBE_SMOOTH ? 1u : LOBE_RAYS;
}

/* Where ray `number` of them goes. */
static inline void gloss_direction(radiometry_record frame, camera_record camera,
                                   const hit_record *at, material_record material, uint pixel,
                                   uint number, float *out)
{
    const uint in_picture = frame.first_pixel + pixel;
    float ray[3], to_sensor[3];

    pixel_ray(camera, frame.columns, in_picture, ray);
    for (int k = 0; k < 3; k++) to_sensor[k] = -ray[k];
    if (material.roughness < LOBE_SMOOTH)
        lobe_turn(at->normal, ray, out);
    else
        lobe_ray(material.roughness, at->normal, to_sensor, camera.seed, in_picture, number,
                 LOBE_RAYS, out);
}

/* What ray `number` met: a facet, with HEMISPHERE_LIT where the sun reaches it, or RECORD_NONE.
 *   mirrored, mirrored_lit   of the pixel, for mirrors; met: (LOBE_RAYS, pixel_count), for others */
static inline uint gloss_met(radiometry_record frame, material_record material, uint mirrored,
                             float mirrored_lit, global const uint *met, uint pixel, uint number)
{
    if (material.roughness >= LOBE_SMOOTH) return met[(size_t)number * frame.pixel_count + pixel];
    return mirrored == RECORD_NONE || mirrored_lit == 0.0f ? mirrored : mirrored | HEMISPHERE_LIT;
}

#endif
