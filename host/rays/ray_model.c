#include "rays/ray_model.h"

#include "tree/bvh_cache.h"

#include <stdlib.h>

struct ray_model {
    geometry *shape;
    device *dev;
    ray_scene *scene;
};

static status read_meshes(ray_model *model, char *const *path, size_t path_count)
{
    status rc = STATUS_OK;
    geometry_instance *instance = calloc(path_count, sizeof *instance);

    NEED(instance, STATUS_MEMORY, "no memory for a list of meshes");
    for (size_t i = 0; i < path_count; i++)
        instance[i] = (geometry_instance){.path = path[i], .scale = 1, .material = "none"};
    TRY(geometry_read(&model->shape, instance, path_count));
out:
    free(instance);
    return rc;
}

status ray_model_open(ray_model **out, int device_index, char *const *path, size_t path_count)
{
    status rc = STATUS_OK;
    bvh *tree = NULL;
    ray_model *model = calloc(1, sizeof *model);

    NEED(model, STATUS_MEMORY, "no memory for a model");
    TRY(read_meshes(model, path, path_count));
    const bvh_source source = {.facet_count = model->shape->facet_count,
                               .vertex_count = model->shape->vertex_count,
                               .corner = (const uint32_t(*)[4])model->shape->corner,
                               .position = (const float(*)[3])model->shape->position};
    TRY(bvh_cache_build(&tree, &source));
    TRY(device_open(&model->dev, device_index));
    TRY(ray_scene_open(&model->scene, model->dev, &tree));
    *out = model;
    model = NULL;
out:
    bvh_free(tree);
    ray_model_free(model);
    return rc;
}

void ray_model_free(ray_model *model)
{
    if (!model) return;
    ray_scene_free(model->scene);
    device_free(model->dev);
    geometry_free(model->shape);
    free(model);
}

const geometry *ray_model_geometry(const ray_model *model)
{
    return model->shape;
}

ray_scene *ray_model_scene(const ray_model *model)
{
    return model->scene;
}
