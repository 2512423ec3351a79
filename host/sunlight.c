#include "sunlight.h"

status sunlight_run(const ray_scene *scene, const float sun[3], uint32_t count, device_memory hit,
                    device_memory out_lit)
{
    const world_record world = ray_scene_world(scene);
    const device_memory nodes = ray_scene_nodes(scene), blocks = ray_scene_blocks(scene);

    return device_run(ray_scene_device(scene), "sunlight",
                      device_ray_shape(ray_scene_device(scene), count, 1), ARG(count), ARG(sun[0]),
                      ARG(sun[1]), ARG(sun[2]), ARG(world), ARG(nodes), ARG(blocks), ARG(hit),
                      ARG(out_lit));
}
