/* Scene rays: all that is opaque in a scene, ready for rays. Thesis 2.3.2. */
#ifndef SCENE_RAYS_H
#define SCENE_RAYS_H

#include "rays/ray_scene.h"
#include "scene/scene.h"

/* Builds the tree of a scene's opaque facets, with its ground plane. The device must outlive it. Departs
 * from the thesis (eq. 2.3.2-6): in exact mode what is opaque stops rays from behind too, but those of the
 * camera. */
status scene_rays_open(ray_scene **out, device *dev, const scene *s);

#endif
