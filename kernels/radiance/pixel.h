/* Pixel: what the spectra of one pixel need to know: angles, temperatures, rows of tables. */
#ifndef PIXEL_H
#define PIXEL_H

#include "kernels/media/air_path.h"
#include "kernels/media/transmission.h"
#include "kernels/radiance/lobe.h"
#include "kernels/radiance/sky.h"
#include "kernels/rays/camera.h"
#include "kernels/tables.h"

/* Interactions of a ray with the scene, as the plane `interaction` holds them (Figure 3-10). */
#define INTERACTION_MISSED 0u
#define INTERACTION_DIFFUSE 1u
#define INTERACTION_SPECULAR_SKY 2u
#define INTERACTION_SPECULAR_BACKGROUND 3u
#define INTERACTION_PARTLY_SKY 4u /* a specular share between 0 and 1 */
#define INTERACTION_PARTLY_BACKGROUND 5u

/* Pixels of a tile.
 *   sunlit, background_sunlit   what of the sun reaches the target, and its background: 0..1
 *   temperature_k               of the target
 *   paths      shape (TRANSMISSION_PATHS, count), see crossing.cl; NULL: no bodies
 *   incident   shape (count, 2, knot_count), see incident.cl; NULL in thesis mode, which takes the mean
 *              background instead */
#define PIXEL_TABLES(TABLE, AND)                                                                   \
    TABLE(global const hit_record *, hit)                                                          \
    AND TABLE(global const background_record *, background)                                        \
    AND TABLE(global const float *, temperature_k)                                                 \
    AND TABLE(global const float *, sunlit)                                                        \
    AND TABLE(global const float *, background_sunlit)                                             \
    AND TABLE(OPTIONAL global const transmission_path *, paths)                                    \
    AND TABLE(OPTIONAL global const float *, incident)

#ifdef __OPENCL_C_VERSION__
TABLES_STRUCT(pixel_tables, PIXEL_TABLES);
#endif

typedef struct pixel_state {
    uint interaction;
    float temperature_k;
    float sunlit, sun_cosine; /* tau1c, cos(theta_S) */
    float view_angle_deg;     /* theta: from the normal to the sensor */
    lookup emissivity;
    lookup sun_emissivity; /* at theta_S */
    uint lobe_row;         /* 1 / (1 - e_hemi), RECORD_NONE: Lambertian */
    float specular_share;  /* k_s; of the sun in exact mode */
    float glint;           /* D: its lobe towards the sun, per sr */
    air_way way;           /* of the sensor's ray */
    float shape_factor;    /* F */
    float background_temperature_k;
    float background_sunlit, background_sun_cosine; /* tau_SB, cos(theta_B) */
    lookup background_emissivity;                   /* at theta_BT */
    sky_lookup sky;                                 /* of a missed ray or of the specular bounce */
} pixel_state;

static inline float pixel_dot(const float *a, const float *b)
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static inline float pixel_angle_deg(float cosine)
{
    return acos(cosine > 1.0f ? 1.0f : cosine < -1.0f ? -1.0f : cosine) * (180.0f / PI_F);
}

/* Unit direction from one point to another. */
static inline void pixel_direction(const float *from, const float *to, float *out)
{
    float length;

    for (int k = 0; k < 3; k++) out[k] = to[k] - from[k];
    length = sqrt(pixel_dot(out, out));
    for (int k = 0; k < 3; k++) out[k] /= length > 0.0f ? length : 1.0f;
}

/* Unit direction of the ray of a pixel. */
static inline void pixel_ray(camera_record camera, uint columns, uint pixel, float *out)
{
    float length;

    camera_direction(camera, columns, pixel, out);
    length = sqrt(pixel_dot(out, out));
    for (int k = 0; k < 3; k++) out[k] /= length;
}

/* The ray of a pixel through the air.
 *   range_m   of what it meets */
static inline air_way pixel_air(radiometry_record frame, const air_record *air,
                                camera_record camera, uint pixel, const float *ray, float range_m)
{
    air_way way = {air_kind(air, frame.thesis, ray[2]), 0.0f, ray[2], range_m, {0u, 0u, 0.0f}};
    float origin[3];

    camera_origin(camera, frame.columns, frame.first_pixel + pixel, origin);
    way.z_m = origin[2];
    way.zenith = lookup_regular(pixel_angle_deg(-ray[2]), frame.path_zenith_first_deg,
                                frame.path_zenith_step_deg, frame.path_count);
    return way;
}

/* Where a mirror sends the ray of a pixel. */
static inline void pixel_bounce(const float *normal, const float *ray, float *out)
{
    const float along = 2.0f * pixel_dot(normal, ray);

    for (int k = 0; k < 3; k++) out[k] = ray[k] - along * normal[k];
}

/* Sets what a pixel sees of its background, if anything is there. A mirror sees it along its ray: the
 * points lie a little off it, which tells where they are close.
 *   ray   unit, from the sensor to the target; the interaction is set */
static inline void pixel_set_background(pixel_state *state, radiometry_record frame,
                                        material_record material, background_record background,
                                        hit_record target, const float *ray, float sunlit)
{
    float to_target[3];

    if (state->interaction == INTERACTION_DIFFUSE) {
        pixel_direction(background.point, target.point, to_target);
    } else {
        pixel_bounce(target.normal, ray, to_target);
        for (int k = 0; k < 3; k++) to_target[k] = -to_target[k];
    }
    state->background_temperature_k = background.mean_temperature_k;
    state->background_sunlit = sunlit;
    state->background_sun_cosine = pixel_dot(background.normal, frame.sun);
    state->background_emissivity = lookup_emissivity(
        material, pixel_angle_deg(pixel_dot(background.normal, to_target)), frame.thesis);
}

/* Which of the interactions a ray has that met a target. */
static inline uint pixel_interaction(material_record target, background_record background)
{
    const uint is_sky = background.facet == RECORD_NONE;

    if (target.specular_share == 0.0f) return INTERACTION_DIFFUSE;
    if (target.specular_share < 1.0f)
        return is_sky ? INTERACTION_PARTLY_SKY : INTERACTION_PARTLY_BACKGROUND;
    return is_sky ? INTERACTION_SPECULAR_SKY : INTERACTION_SPECULAR_BACKGROUND;
}

/* Sets where the target sends the sun's light in exact mode; thesis mode knows none of it. */
static inline void pixel_set_lobes(pixel_state *state, radiometry_record frame, hit_record hit,
                                   material_record material, const float *ray)
{
    float to_sensor[3];

    state->lobe_row = RECORD_NONE;
    if (frame.thesis) return;
    for (int k = 0; k < 3; k++) to_sensor[k] = -ray[k];
    state->lobe_row = material.lobe_first;
    state->sun_emissivity = lookup_emissivity(material, pixel_angle_deg(state->sun_cosine), 0u);
    state->specular_share = material.specular_share;
    if (material.specular_share > 0.0f)
        state->glint = lobe_of_sun(material.roughness, hit.normal, to_sensor, frame.sun);
}

/* Sets what a pixel sees of its target; the interaction is set.
 *   ray   unit, from the sensor to the target */
static inline void pixel_set_target(pixel_state *state, radiometry_record frame, hit_record hit,
                                    material_record material, const float *ray)
{
    const float cosine = -pixel_dot(hit.normal, ray);
    const uint at_normal = frame.thesis && state->interaction == INTERACTION_DIFFUSE;
    float bounce[3];

    state->view_angle_deg = pixel_angle_deg(cosine);
    state->sun_cosine = pixel_dot(hit.normal, frame.sun);
    pixel_set_lobes(state, frame, hit, material, ray);
    state->emissivity =
        lookup_emissivity(material, at_normal ? 0.0f : state->view_angle_deg, frame.thesis);
    if (state->interaction == INTERACTION_DIFFUSE) return;
    pixel_bounce(hit.normal, ray, bounce);
    state->sky = sky_find(frame, bounce[0], bounce[1], bounce[2]);
}

#endif
