#include "kernels/media/crossing.h"
#include "kernels/radiance/pixel.h"

/* Makes the ray from one point to another. */
static ray between(const world_record *world, const float *from, const float *normal,
                   const float *to)
{
    float direction[3], length = 0.0f;

    for (int k = 0; k < 3; k++) length += (to[k] - from[k]) * (to[k] - from[k]);
    pixel_direction(from, to, direction);
    ray r = ray_leaving(world, from, normal, direction);
    r.limit = sqrt(length);
    return r;
}

/* The bodies on the four ways of a pixel: sensor to target or sky, target to sun, target to
 * background, background to sun; without such a way, none.
 * Launch: (frame.pixel_count).
 * out_paths: shape (TRANSMISSION_PATHS, pixel_count)
 * direct, background_direct: per pixel, what of the sun's broad band reaches them */
SHARED_BODY kernel void crossing(const radiometry_record frame, const camera_record camera,
                                 const world_record world, TABLES(MEDIUM_TABLES),
                                 TABLES(PIXEL_TABLES), global transmission_path *out_paths,
                                 global float *direct, global float *background_direct)
{
    const uint pixel = get_global_id(0);
    if (pixel >= frame.pixel_count) return;
    const medium_tables medium = TABLES_GIVEN(MEDIUM_TABLES);
    const pixel_tables pixels = TABLES_GIVEN(PIXEL_TABLES);
    const hit_record at = pixels.hit[pixel];
    const background_record behind = pixels.background[pixel];
    const transmission_path none = {{0.0f}, {0.0f}, {0.0f}, {0.0f}, {0}};
    transmission_path found[TRANSMISSION_PATHS] = {none, none, none, none};
    ray r = {.limit = at.facet == RECORD_NONE ? INFINITY : at.range_m};

    camera_origin(camera, frame.columns, frame.first_pixel + pixel, r.origin);
    pixel_ray(camera, frame.columns, frame.first_pixel + pixel, r.direction);
    found[TRANSMISSION_CAMERA] = crossing_path(&medium, &r);
    if (!frame.thesis) crossing_set_vertical(&medium, &r, &found[TRANSMISSION_CAMERA]);
    if (at.facet != RECORD_NONE && frame.sun[2] > 0.0f) {
        r = ray_leaving(&world, at.point, at.normal, frame.sun);
        found[TRANSMISSION_SUN] = crossing_path(&medium, &r);
    }
    if (at.facet != RECORD_NONE && behind.facet != RECORD_NONE) {
        r = between(&world, at.point, at.normal, behind.point);
        found[TRANSMISSION_BACKGROUND] = crossing_path(&medium, &r);
        r = ray_leaving(&world, behind.point, behind.normal, frame.sun);
        if (frame.sun[2] > 0.0f) found[TRANSMISSION_BACKGROUND_SUN] = crossing_path(&medium, &r);
    }
    for (uint p = 0; p < TRANSMISSION_PATHS; p++)
        out_paths[(size_t)p * frame.pixel_count + pixel] = found[p];
    direct[pixel] = pixels.sunlit[pixel] * transmission_broad_band(medium.media.broad_band_per_m,
                                                                   &found[TRANSMISSION_SUN]);
    background_direct[pixel] =
        pixels.background_sunlit[pixel] *
        transmission_broad_band(medium.media.broad_band_per_m, &found[TRANSMISSION_BACKGROUND_SUN]);
}
