#include "base/number.h"
#include "command/command.h"
#include "command/command_value.h"
#include "hemisphere/shape_factor.h"
#include "rays/ray_model.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>

static const char command[] = "radsig shape-factor";

static const char purpose[] =
    "Prints the share of the hemisphere above a point that sees the sky, 0 to 1. There is no\n"
    "ground beyond the meshes: rays that leave them see the sky in every direction.\n";

typedef struct factor_request {
    double point_m[3], normal[3];
    bool cull_back;
    double zenith_step_deg, azimuth_step_deg;
    int reading; /* a shape_factor_reading */
    int64_t device_index;
    char *const *path;
    size_t path_count;
} factor_request;

static status read_point(const option *o, const char *text)
{
    status rc = STATUS_OK;

    NEED(number_read_list(text, 3, o->out), STATUS_ARGUMENT, "found '%s', expected X,Y,Z", text);
out:
    return rc;
}

static status read_normal(const option *o, const char *text)
{
    status rc = STATUS_OK;
    const double *normal = o->out;

    TRY(read_point(o, text));
    NEED(normal[0] != 0.0 || normal[1] != 0.0 || normal[2] != 0.0, STATUS_ARGUMENT,
         "found '%s', expected a direction", text);
out:
    return rc;
}

static int read_arguments(int argc, char **argv, factor_request *out)
{
    option list[] = {
        {"point", 0, "X,Y,Z", "in metres", .out = out->point_m, .read = read_point,
         .is_required = true},
        {"normal", 0, "X,Y,Z", "out of the surface; need not be unit", .out = out->normal,
         .read = read_normal, .is_required = true},
        {"reading", 0, "READING",
         "weight of a direction at elevation e above the plane: cosine (the default): sin(e) "
         "cos(e), as irradiance has it; solid-angle: cos(e); thesis: sin(e)",
         .index = &out->reading, .word = shape_factor_reading_names,
         .word_count = SHAPE_FACTOR_READINGS},
        {"zenith-step", 0, "D", "degrees between directions, divides 90 (default 5)",
         .number = &out->zenith_step_deg, .low = 1e-3, .high = 90.0},
        {"azimuth-step", 0, "D", "divides 360 (default 10)", .number = &out->azimuth_step_deg,
         .low = 1e-3, .high = 360.0},
        command_cull_option(&out->cull_back),
        command_device_option(&out->device_index)};
    const option_table table = {
        command, "MESH...", 1, INT_MAX, purpose, list, sizeof list / sizeof *list};
    int count = 0;
    const int code = option_table_read(&table, argc, argv, &count);

    if (code != OPTION_TABLE_DONE) return code;
    if (hemisphere_grid_check_steps(out->zenith_step_deg, out->azimuth_step_deg) != STATUS_OK)
        return program_misuse(command, "%s", status_message());
    out->path = argv + 1;
    out->path_count = (size_t)count;
    return OPTION_TABLE_DONE;
}

/* The point as something that a ray has met. */
static hit_record make_hit(const factor_request *request, const double origin_m[3])
{
    const double *n = request->normal;
    const double length = hypot(hypot(n[0], n[1]), n[2]);
    hit_record hit = {.facet = 0};

    for (int k = 0; k < 3; k++) {
        hit.point[k] = (float)(request->point_m[k] - origin_m[k]);
        hit.normal[k] = (float)(n[k] / length);
    }
    return hit;
}

/* Surfaces that are all alike: only what is open counts here. */
static status open_surfaces(device *dev, uint32_t facet_count, surface_tables *out)
{
    status rc = STATUS_OK;
    facet_record *facet = calloc(facet_count, sizeof *facet);
    float *temperature_k = calloc(facet_count, sizeof *temperature_k);
    const material_record material = {.number = 0};

    NEED(facet && temperature_k, STATUS_MEMORY, "no memory for %u facets", facet_count);
    TRY(device_allocate(dev, &out->facets, facet_count, facet));
    TRY(device_allocate(dev, &out->facet_temperature_k, facet_count, temperature_k));
    TRY(device_allocate(dev, &out->materials, 1, &material));
out:
    free(temperature_k);
    free(facet);
    return rc;
}

static status run(const factor_request *request)
{
    status rc = STATUS_OK;
    ray_model *model = NULL;
    hemisphere_grid *grid = NULL;
    surface_tables surfaces = {0};
    shape_factor_points points = {.count = 1};
    background_record_buffer out_memory = {0};
    background_record background;
    hit_record hit;

    TRY(ray_model_open(&model, (int)request->device_index, request->path, request->path_count));
    ray_scene *scene = ray_model_scene(model);
    device *dev = ray_scene_device(scene);
    ray_scene_set_cull(scene, false, request->cull_back);
    TRY(hemisphere_grid_open(&grid, dev, (shape_factor_reading)request->reading,
                             request->zenith_step_deg, request->azimuth_step_deg));
    TRY(open_surfaces(dev, ray_model_geometry(model)->facet_count, &surfaces));
    hit = make_hit(request, ray_model_geometry(model)->origin_m);
    TRY(device_allocate(dev, &points.hit, 1, &hit));
    TRY(device_allocate(dev, &points.met, hemisphere_grid_cell_count(grid), NULL));
    TRY(device_allocate(dev, &out_memory, 1, NULL));
    TRY(shape_factor_run(grid, scene, &surfaces, NULL, &points, out_memory));
    TRY(device_download(dev, out_memory, 1, &background));
    printf("%.6f\n", (double)background.shape_factor);
out:
    device_release(out_memory);
    device_release(points.met);
    device_release(points.hit);
    device_release(surfaces.materials);
    device_release(surfaces.facet_temperature_k);
    device_release(surfaces.facets);
    hemisphere_grid_free(grid);
    ray_model_free(model);
    return rc;
}

int command_shape_factor(int argc, char **argv)
{
    factor_request request = {.zenith_step_deg = 5,
                              .azimuth_step_deg = 10,
                              .reading = SHAPE_FACTOR_COSINE,
                              .device_index = -1};
    const int code = read_arguments(argc, argv, &request);

    return code == OPTION_TABLE_DONE ? program_end(command, run(&request)) : code;
}
