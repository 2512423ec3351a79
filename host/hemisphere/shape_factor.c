#include "hemisphere/shape_factor.h"

/* Cells of a work-item that has packets of rays, see kernels/hemisphere/hemisphere.cl. */
enum { CELLS_AT_ONCE = 72 };

static uint_buffer sets_of(const hemisphere_grid *grid, const shape_factor_points *points)
{
    return hemisphere_grid_set_count(grid) > 1 ? points->direction_set : (uint_buffer){0};
}

hemisphere_tables shape_factor_rays(const hemisphere_grid *grid, const shape_factor_points *points)
{
    return (hemisphere_tables){.cell = hemisphere_grid_cells(grid),
                               .hit = points->hit,
                               .met = points->met,
                               .order = points->order,
                               .direction_set = sets_of(grid, points),
                               .near_rays = points->near_rays};
}

static status find_near(const hemisphere_grid *grid, const ray_scene *scene, const float *towards,
                        const shape_factor_points *points)
{
    device *dev = ray_scene_device(scene);

    return near_facets_run(dev, device_ray_shape(dev, points->count, 1),
                           &(near_facets_args){.count = points->count,
                                               .cell_count = hemisphere_grid_cell_count(grid),
                                               .sun_x = towards[0],
                                               .sun_y = towards[1],
                                               .sun_z = towards[2],
                                               .tree = ray_scene_tree(scene),
                                               .hemisphere = shape_factor_rays(grid, points),
                                               .out_met = points->met,
                                               .out_near = points->near_rays});
}

status shape_factor_trace(const hemisphere_grid *grid, const ray_scene *scene, const float *sun,
                          const shape_factor_points *points)
{
    status rc = STATUS_OK;
    static const float nowhere[3];
    const float *towards = sun ? sun : nowhere;
    device *dev = ray_scene_device(scene);
    const uint32_t at_once = device_describe(dev)->ray_lanes == 1 ? 1 : CELLS_AT_ONCE;
    const uint32_t cells = (hemisphere_grid_cell_count(grid) + at_once - 1) / at_once;

    TRY(hemisphere_run(dev, device_bundle_shape(dev, points->count, cells),
                       &(hemisphere_args){.count = points->count,
                                          .cell_count = hemisphere_grid_cell_count(grid),
                                          .sun_x = towards[0],
                                          .sun_y = towards[1],
                                          .sun_z = towards[2],
                                          .tree = ray_scene_tree(scene),
                                          .cell = hemisphere_grid_cells(grid),
                                          .hit = points->hit,
                                          .direction_set = sets_of(grid, points),
                                          .out_met = points->met}));
    if (points->near_rays.memory) TRY(find_near(grid, scene, towards, points));
out:
    return rc;
}

status shape_factor_run(const hemisphere_grid *grid, const ray_scene *scene,
                        const surface_tables *surfaces, const float *sun,
                        const shape_factor_points *points, background_record_buffer out_background)
{
    status rc = STATUS_OK;
    device *dev = ray_scene_device(scene);

    TRY(shape_factor_trace(grid, scene, sun, points));
    TRY(background_run(dev, device_ray_shape(dev, points->count, 1),
                       &(background_args){.count = points->count,
                                          .cell_count = hemisphere_grid_cell_count(grid),
                                          .tree = ray_scene_tree(scene),
                                          .surface = *surfaces,
                                          .hemisphere = shape_factor_rays(grid, points),
                                          .out = out_background}));
out:
    return rc;
}
