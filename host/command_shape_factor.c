#include "command.h"
#include "command_value.h"
#include "ray_model.h"
#include "shape_factor.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: radsig shape-factor MESH... --point X,Y,Z --normal X,Y,Z [--reading READING]\n"
    "                           [--zenith-step D --azimuth-step D] [--cull back] [--device N]\n"
    "\n"
    "Prints the share of the hemisphere above a point that sees the sky, 0 to 1. There is no\n"
    "ground beyond the meshes: rays that leave them see the sky in every direction.\n"
    "\n"
    "  --reading READING  what a direction counts, e its elevation above the plane:\n"
    "                     cosine (the default): sin(e) cos(e), as irradiance does\n"
    "                     solid-angle: cos(e); thesis: sin(e)\n"
    "  --zenith-step D    degrees between directions, divides 90; 5 unless told\n"
    "  --azimuth-step D   divides 360; 10 unless told\n"
    "  --cull back        facets are met from the front alone\n"
    "  --device N         OpenCL device, see radsig devices\n";

typedef struct factor_request {
    double point_m[3], normal[3];
    bool has_point, has_normal, cull_back;
    double zenith_step_deg, azimuth_step_deg;
    shape_factor_reading reading;
    int device_index;
    char *const *path;
    size_t path_count;
} factor_request;

static bool read_vector(const char *text, double out[3])
{
    char *end = NULL;

    for (int k = 0; k < 3; k++, text = end + 1) {
        out[k] = strtod(text, &end);
        if (end == text || !isfinite(out[k]) || *end != (k < 2 ? ',' : 0)) return false;
    }
    return true;
}

static bool read_whole(const char *text, int *out)
{
    double number;

    if (!command_number(text, 0, 1e6, &number) || floor(number) != number) return false;
    *out = (int)number;
    return true;
}

/* Returns whether the option's value was understood. */
static bool take_option(int option, const char *value, factor_request *out)
{
    switch (option) {
    case 'p':
        return out->has_point = read_vector(value, out->point_m);
    case 'n':
        out->has_normal = read_vector(value, out->normal);
        return out->has_normal &&
               (out->normal[0] != 0 || out->normal[1] != 0 || out->normal[2] != 0);
    case 'r':
        return shape_factor_read_name(&out->reading, value) == STATUS_OK;
    case 'z':
        return command_number(value, 1e-3, 90, &out->zenith_step_deg);
    case 'a':
        return command_number(value, 1e-3, 360, &out->azimuth_step_deg);
    case 'c':
        return out->cull_back = !strcmp(value, "back");
    default:
        return read_whole(value, &out->device_index);
    }
}

/* Returns 0, -1 for help, or the exit code of a misuse. */
static int read_arguments(int argc, char **argv, factor_request *out)
{
    static const struct option options[] = {{"point", required_argument, NULL, 'p'},
                                            {"normal", required_argument, NULL, 'n'},
                                            {"reading", required_argument, NULL, 'r'},
                                            {"zenith-step", required_argument, NULL, 'z'},
                                            {"azimuth-step", required_argument, NULL, 'a'},
                                            {"cull", required_argument, NULL, 'c'},
                                            {"device", required_argument, NULL, 'd'},
                                            {"help", no_argument, NULL, 'h'},
                                            {0}};
    int option, index = 0;

    opterr = 0;
    while ((option = getopt_long(argc, argv, ":", options, &index)) != -1) {
        if (option == 'h') return -1;
        if (option == '?' || option == ':')
            return command_misuse("shape-factor", "'%s' %s", argv[optind - 1],
                                  option == ':' ? "needs a value" : "is no option");
        if (!take_option(option, optarg, out))
            return command_misuse("shape-factor", "--%s: '%s' is not what it takes",
                                  options[index].name, optarg);
    }
    if (optind == argc) return command_misuse("shape-factor", "needs a mesh");
    if (!out->has_point || !out->has_normal)
        return command_misuse("shape-factor", "needs --point and --normal");
    if (shape_factor_check_steps(out->zenith_step_deg, out->azimuth_step_deg) != STATUS_OK)
        return command_misuse("shape-factor", "%s", status_message());
    out->path = argv + optind;
    out->path_count = (size_t)(argc - optind);
    return 0;
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
    shape_factor_grid *grid = NULL;
    surface_tables surfaces = {0};
    shape_factor_points points = {.count = 1};
    background_record_buffer out_memory = {0};
    background_record background;
    hit_record hit;

    TRY(ray_model_open(&model, request->device_index, request->path, request->path_count));
    ray_scene *scene = ray_model_scene(model);
    device *dev = ray_scene_device(scene);
    ray_scene_set_cull(scene, false, request->cull_back);
    TRY(shape_factor_open(&grid, dev, request->reading, request->zenith_step_deg,
                          request->azimuth_step_deg));
    TRY(open_surfaces(dev, ray_model_geometry(model)->facet_count, &surfaces));
    hit = make_hit(request, ray_model_geometry(model)->origin_m);
    TRY(device_allocate(dev, &points.hit, 1, &hit));
    TRY(device_allocate(dev, &points.met, shape_factor_cell_count(grid), NULL));
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
    shape_factor_free(grid);
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

    if (code > 0) return code;
    if (code < 0) {
        fputs(help, stdout);
        return 0;
    }
    return command_end("shape-factor", run(&request));
}
