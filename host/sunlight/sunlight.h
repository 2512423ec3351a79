/* Sunlight: whether the sun reaches a point. Thesis 2.3, 2.4. */
#ifndef SUNLIGHT_H
#define SUNLIGHT_H

#include "rays/ray_scene.h"

/* Casts a ray towards the sun from every point that faces it.
 *   hit       shape (count)
 *   sun       unit vector towards the sun
 *   out_lit   shape (count): 1 lit; 0 in shadow, turned away, without a facet, or the sun at
 *             or below the horizon. The ground plane is never in shadow (assumed: what stands on it
 *             is small against it) */
status sunlight_cast(const ray_scene *scene, const float sun[3], uint32_t count,
                     hit_record_buffer hit, float_buffer out_lit);

#endif
