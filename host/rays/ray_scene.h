/* A tree on a device, and the plane around it: what camera, sun and hemisphere rays share. */
#ifndef RAY_SCENE_H
#define RAY_SCENE_H

#include "launches.h"
#include "tree/bvh.h"

#include <stdbool.h>

typedef struct ray_scene ray_scene;

/* Puts the tree on the device and takes it over: *tree is NULL where that succeeds. The scene has no
 * ground plane yet, and both sides of its facets are met; the device must outlive it. */
status ray_scene_open(ray_scene **out, device *dev, bvh **tree);
void ray_scene_free(ray_scene *scene);

/* Gives the scene an endless level plane at z_m, met by what leaves the geometry below the horizon.
 *   facet   its index in the tables of facets, past the real ones; RECORD_NONE: no plane */
void ray_scene_set_ground(ray_scene *scene, uint32_t facet, float z_m);

/* Lets rays pass through facets that they meet from behind, or not (the default): those of the
 * camera, and all others. */
void ray_scene_set_cull(ray_scene *scene, bool by_camera, bool by_others);

device *ray_scene_device(const ray_scene *scene);

/* What kernels need of it. */
tree_tables ray_scene_tree(const ray_scene *scene);

/* Casts the rays of pixels first_pixel .. first_pixel + count - 1, counted along the rows.
 * Ranges are metres. Thesis 2.5.3.
 *   out_hit   shape (count); the ground plane is met as its facet */
status ray_scene_primary(const ray_scene *scene, const camera_record *camera, uint32_t columns,
                         uint32_t first_pixel, uint32_t count, hit_record_buffer out_hit);

/* Casts any rays. Direction need not be unit; ranges are in its lengths, above 0.
 *   rays        shape (6, stride), stride >= count: origins, directions
 *   out_range   shape (count): INFINITY for a miss
 *   out_facet   shape (count): RECORD_NONE for a miss; of equal ranges the lowest facet */
status ray_scene_trace(const ray_scene *scene, uint32_t count, uint32_t stride, float_buffer rays,
                       float_buffer out_range, uint_buffer out_facet);

/* As ray_scene_trace, but only tells whether a ray meets anything.
 *   out_met   shape (count): 0 or 1 */
status ray_scene_occluded(const ray_scene *scene, uint32_t count, uint32_t stride,
                          float_buffer rays, uchar_buffer out_met);

#endif
