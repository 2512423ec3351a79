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
                                         .tree = ray_scene_tree(scene),
                                         .hit = hit,
                                         .out_lit = out_lit});
}
