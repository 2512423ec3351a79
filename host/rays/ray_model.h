/* Ray model: mesh files ready for rays on a device, for the commands that need nothing else. */
#ifndef RAY_MODEL_H
#define RAY_MODEL_H

#include "mesh/geometry.h"
#include "rays/ray_scene.h"

typedef struct ray_model ray_model;

/* Reads the meshes in the order given and opens device `index` as device_open does. */
status ray_model_open(ray_model **out, int device_index, char *const *path, size_t path_count);
void ray_model_free(ray_model *model);

/* Positions on the device are relative to the geometry's origin. */
const geometry *ray_model_geometry(const ray_model *model);
ray_scene *ray_model_scene(const ray_model *model);

#endif
