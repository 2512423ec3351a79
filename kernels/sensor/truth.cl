#include "kernels/radiance/pixel.h"

/* The planes that do not depend on the band (Figures 3-4 to 3-14).
 * Launch: (frame.pixel_count).
 * facet_id: per facet; the ground's is RECORD_NONE
 * planes: shape (TRUTH_PLANES, pixel_count): material and background material (numbers), sunlit and
 *   background sunlit (0..1), temperature and background temperature (C), interaction, view angle
 *   (degrees), shape factor, range (m), facet (id); NO_VALUE where there is none */
kernel void truth(const radiometry_record frame, const camera_record camera, TABLES(SURFACE_TABLES),
                  global const uint *facet_id, TABLES(PIXEL_TABLES), global float *planes)
{
    const uint pixel = get_global_id(0);
    if (pixel >= frame.pixel_count) return;

    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const pixel_tables pixels = TABLES_GIVEN(PIXEL_TABLES);
    const hit_record target = pixels.hit[pixel];
    const background_record behind = pixels.background[pixel];
    global float *out = planes + pixel;
    float value[TRUTH_PLANES], ray[3];

    for (uint k = 0; k < TRUTH_PLANES; k++) value[k] = NO_VALUE;
    value[6] = (float)INTERACTION_MISSED;
    if (target.facet != RECORD_NONE) {
        const material_record material = surfaces.materials[surfaces.facets[target.facet].material];
        pixel_ray(camera, frame.columns, frame.first_pixel + pixel, ray);
        value[0] = (float)material.number;
        value[2] = pixels.sunlit[pixel];
        value[4] = pixels.temperature_k[pixel] - ZERO_CELSIUS_K;
        value[6] = (float)pixel_interaction(material, behind);
        value[7] = pixel_angle_deg(-pixel_dot(target.normal, ray));
        value[8] = behind.shape_factor;
        value[9] = target.range_m;
        if (facet_id[target.facet] != RECORD_NONE) value[10] = (float)facet_id[target.facet];
        if (behind.facet != RECORD_NONE) {
            value[1] = (float)surfaces.materials[behind.material].number;
            value[3] = pixels.background_sunlit[pixel];
            value[5] = behind.mean_temperature_k - ZERO_CELSIUS_K;
        }
    }
    for (uint k = 0; k < TRUTH_PLANES; k++) out[(size_t)k * frame.pixel_count] = value[k];
}
