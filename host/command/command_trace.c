#include "command/command.h"
#include "command/command_value.h"
#include "mesh/facet_range.h"
#include "rays/ray_model.h"
#include "rays/ray_stream.h"

#include <limits.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

static const char command[] = "radsig trace";

static const char purpose[] =
    "Reads rays from stdin, a line `ox oy oz dx dy dz` each, and prints t_m,facet for each: the\n"
    "distance in metres and the face number in the file, counted from 0 and on over all meshes\n"
    "in the order given; inf,-1 for a miss. Directions need not be unit.\n";

typedef struct trace_request {
    bool any_hit, cull_back, binary;
    int64_t device_index;
    char *const *path;
    size_t path_count;
} trace_request;

/* The answers of a batch, here and on the device. */
typedef struct trace_answer {
    float_buffer ray, range;
    uint_buffer facet;
    uchar_buffer met;
    float range_host[RAY_BATCH_SIZE];
    uint32_t facet_host[RAY_BATCH_SIZE];
    uint8_t met_host[RAY_BATCH_SIZE];
} trace_answer;

static int read_arguments(int argc, char **argv, trace_request *out)
{
    option list[] = {
        {"any-hit", 0, NULL, "only tell whether anything is met: 1 or 0", .flag = &out->any_hit},
        command_cull_option(&out->cull_back),
        {"binary", 0, NULL,
         "rays are 6 float32 each, answers float32 t and int32 facet, or one byte",
         .flag = &out->binary},
        command_device_option(&out->device_index)};
    const option_table table = {
        command, "MESH...", 1, INT_MAX, purpose, list, sizeof list / sizeof *list};
    int count = 0;
    const int code = option_table_read(&table, argc, argv, &count);

    out->path = argv + 1;
    out->path_count = (size_t)count;
    return code;
}

static status open_answer(trace_answer **out, device *dev)
{
    status rc = STATUS_OK;
    trace_answer *a = calloc(1, sizeof *a);

    NEED(a, STATUS_MEMORY, "no memory for a batch of rays");
    *out = a;
    TRY(device_allocate(dev, &a->ray, 6 * RAY_BATCH_SIZE, NULL));
    TRY(device_allocate(dev, &a->range, RAY_BATCH_SIZE, NULL));
    TRY(device_allocate(dev, &a->facet, RAY_BATCH_SIZE, NULL));
    TRY(device_allocate(dev, &a->met, RAY_BATCH_SIZE, NULL));
out:
    return rc;
}

static void free_answer(trace_answer *a)
{
    if (!a) return;
    device_release(a->met);
    device_release(a->facet);
    device_release(a->range);
    device_release(a->ray);
    free(a);
}

static status cast(const ray_scene *scene, const ray_batch *batch, bool any_hit, trace_answer *a)
{
    status rc = STATUS_OK;
    device *dev = ray_scene_device(scene);
    const uint32_t n = batch->count;

    TRY(device_upload(dev, a->ray, 6 * RAY_BATCH_SIZE, batch->ray[0]));
    if (any_hit) {
        TRY(ray_scene_occluded(scene, n, RAY_BATCH_SIZE, a->ray, a->met));
        TRY(device_download(dev, a->met, n, a->met_host));
    } else {
        TRY(ray_scene_trace(scene, n, RAY_BATCH_SIZE, a->ray, a->range, a->facet));
        TRY(device_download(dev, a->range, n, a->range_host));
        TRY(device_download(dev, a->facet, n, a->facet_host));
    }
out:
    return rc;
}

/* Metres; INFINITY for a miss. */
static float range_of(const ray_batch *batch, const trace_answer *a, const geometry *shape,
                      uint32_t i)
{
    const double rounded_m = (double)a->range_host[i] * batch->length[i];

    if (a->facet_host[i] == RECORD_NONE) return INFINITY;
    return (float)facet_range(shape->corner[a->facet_host[i]], (const float(*)[3])shape->position,
                              batch->exact[i], rounded_m);
}

static void print_answer(const trace_request *request, const ray_batch *batch,
                         const trace_answer *a, const geometry *shape)
{
    for (uint32_t i = 0; i < batch->count; i++) {
        const uint32_t facet = a->facet_host[i];
        const float range = request->any_hit ? 0 : range_of(batch, a, shape, i);
        const int32_t id =
            request->any_hit || facet == RECORD_NONE ? -1 : (int32_t)shape->facet_id[facet];
        if (request->any_hit && request->binary) {
            putchar(a->met_host[i]);
        } else if (request->any_hit) {
            puts(a->met_host[i] ? "1" : "0");
        } else if (request->binary) {
            fwrite(&range, sizeof range, 1, stdout);
            fwrite(&id, sizeof id, 1, stdout);
        } else {
            printf("%.9g,%d\n", (double)range, id);
        }
    }
}

static status run(const trace_request *request)
{
    status rc = STATUS_OK;
    ray_model *model = NULL;
    trace_answer *answer = NULL;
    ray_batch *batch = malloc(sizeof *batch);
    ray_stream stream = {.file = stdin, .binary = request->binary};

    NEED(batch, STATUS_MEMORY, "no memory for a batch of rays");
    TRY(ray_model_open(&model, (int)request->device_index, request->path, request->path_count));
    ray_scene_set_cull(ray_model_scene(model), false, request->cull_back);
    TRY(open_answer(&answer, ray_scene_device(ray_model_scene(model))));
    stream.origin_m = ray_model_geometry(model)->origin_m;
    while (!ferror(stdout)) { /* then the program ends, and says why */
        TRY(ray_stream_read(&stream, batch));
        if (batch->count == 0) break;
        TRY(cast(ray_model_scene(model), batch, request->any_hit, answer));
        print_answer(request, batch, answer, ray_model_geometry(model));
    }
out:
    free_answer(answer);
    ray_model_free(model);
    free(batch);
    return rc;
}

int command_trace(int argc, char **argv)
{
    trace_request request = {.device_index = -1};
    const int code = read_arguments(argc, argv, &request);

    return code == OPTION_TABLE_DONE ? program_end(command, run(&request)) : code;
}
