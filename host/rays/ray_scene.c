#include "rays/ray_scene.h"

#include "tree/bvh_memory.h"

#include <math.h>
#include <stdlib.h>

/* What a secondary ray keeps from its surface, per metre of coordinate: 16 roundings. */
static const float offset_per_m = 9.5367431640625e-7f;

struct ray_scene {
    device *dev;
    bvh_memory tree;
    world_record world;
    bool camera_culls;
};

/* The largest coordinate of the geometry. */
static float reach(const bvh_tables *tables)
{
    float largest = 0;

    for (int k = 0; k < 3; k++)
        largest = fmaxf(largest, fmaxf(fabsf(tables->low[k]), fabsf(tables->high[k])));
    return largest;
}

status ray_scene_open(ray_scene **out, device *dev, bvh **tree)
{
    status rc = STATUS_OK;
    const bvh_tables *tables = bvh_look(*tree);
    ray_scene *scene = calloc(1, sizeof *scene);

    NEED(scene, STATUS_MEMORY, "no memory for a scene of rays");
    scene->dev = dev;
    scene->world.ground_facet = RECORD_NONE;
    scene->world.offset_m = offset_per_m * fminf(reach(tables), RAY_OFFSET_REACH_M);
    TRY(bvh_memory_take(&scene->tree, dev, tree));
    *out = scene;
    scene = NULL;
out:
    ray_scene_free(scene);
    return rc;
}

void ray_scene_free(ray_scene *scene)
{
    if (!scene) return;
    bvh_memory_free(&scene->tree);
    free(scene);
}

void ray_scene_set_ground(ray_scene *scene, uint32_t facet, float z_m)
{
    scene->world.ground_facet = facet;
    scene->world.ground_z_m = z_m;
}

void ray_scene_set_cull(ray_scene *scene, bool by_camera, bool by_others)
{
    scene->camera_culls = by_camera;
    scene->world.cull_back = by_others;
}

device *ray_scene_device(const ray_scene *scene)
{
    return scene->dev;
}

tree_tables ray_scene_tree(const ray_scene *scene)
{
    return (tree_tables){scene->world, scene->tree.node, scene->tree.block};
}

status ray_scene_primary(const ray_scene *scene, const camera_record *camera, uint32_t columns,
                         uint32_t first_pixel, uint32_t count, hit_record_buffer out_hit)
{
    const uint32_t side = device_describe(scene->dev)->ray_lanes == 1 ? 1 : 4;
    const uint32_t rows = (first_pixel + count + columns - 1) / columns - first_pixel / columns;
    const device_shape shape =
        camera->samples_per_side > 1
            ? device_ray_shape(scene->dev, count, 1)
            : device_ray_shape(scene->dev, (size_t)columns * side, (rows + side - 1) / side);
    tree_tables tree = ray_scene_tree(scene);

    tree.world.cull_back = scene->camera_culls;
    return primary_run(scene->dev, shape,
                       &(primary_args){.count = count,
                                       .first_pixel = first_pixel,
                                       .columns = columns,
                                       .camera = *camera,
                                       .tree = tree,
                                       .out_hit = out_hit});
}

/* A work-item has a batch of rays where it has packets; kernels/rays/ray_order.h. */
static device_shape batches(const device *dev, uint32_t count)
{
    const size_t packed = 1024;

    if (device_describe(dev)->ray_lanes == 1) return shape1(count);
    return (device_shape){{(count + packed - 1) / packed, 1}, 1, 0.0};
}

status ray_scene_trace(const ray_scene *scene, uint32_t count, uint32_t stride, float_buffer rays,
                       float_buffer out_range, uint_buffer out_facet)
{
    return trace_run(scene->dev, batches(scene->dev, count),
                     &(trace_args){.count = count,
                                   .stride = stride,
                                   .tree = ray_scene_tree(scene),
                                   .rays = rays,
                                   .out_range = out_range,
                                   .out_facet = out_facet});
}

status ray_scene_occluded(const ray_scene *scene, uint32_t count, uint32_t stride,
                          float_buffer rays, uchar_buffer out_met)
{
    return occluded_run(scene->dev, batches(scene->dev, count),
                        &(occluded_args){.count = count,
                                         .stride = stride,
                                         .tree = ray_scene_tree(scene),
                                         .rays = rays,
                                         .out_met = out_met});
}
