#include "sunlight/sunlight.h"

status sunlight_cast(const ray_scene *scene, const float sun[3], uint32_t count,
                     hit_record_buffer hit, float_buffer out_lit)
{
    device *dev = ray_scene_device(scene);

    return sunlight_run(dev, device_ray_shape(dev, count, 1),
                        &(sunlight_args){.count = count,
                                         .sun_x = sun[0],
                                         .sun_y = sun[1],
                                         .sun_z = sun[2],
                                         .world = ray_scene_world(scene),
                                         .nodes = ray_scene_nodes(scene),
                                         .blocks = ray_scene_blocks(scene),
                                         .hit = hit,
                                         .out_lit = out_lit});
}
