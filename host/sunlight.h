/* Sunlight: whether the sun reaches a point. Thesis 2.3, 2.4. */
#ifndef SUNLIGHT_H
#define SUNLIGHT_H

#include "ray_scene.h"

/* Casts a ray towards the sun from every point that faces it.
 *   hit       hit_record, shape (count)
 *   sun       unit vector towards the sun
 *   out_lit   float, shape (count): 1 lit; 0 in shadow, turned away, without a facet, or the sun at
 *             or below the horizon. The ground plane is never in shadow (assumed: what stands on it
 *             is small against it) */
status sunlight_run(const ray_scene *scene, const float sun[3], uint32_t count, device_memory hit,
                    device_memory out_lit);

#endif
