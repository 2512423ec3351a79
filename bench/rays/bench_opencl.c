#define CL_TARGET_OPENCL_VERSION 120
#include "bench_opencl.h"

#include "base/clock.h"
#include "bench_embree.h"
#include "device/device_error.h"
#include "device/kernel_source.h"
#include "device/pocl_affinity.h"

#include <CL/cl.h>
#include <stdlib.h>
#include <string.h>

const char *const bench_opencl_modes[OPENCL_MODES] = {"packets", "one ray, 8 wide"};

static const char *const build_options[OPENCL_MODES] = {"-cl-std=CL1.2 -DRAY_LANES=16",
                                                        "-cl-std=CL1.2 -DRAY_LANES=1"};
static const size_t batch[OPENCL_MODES] = {1024, 1},
                    local_size[OPENCL_MODES] = {1, 64}; /* ray_order.h */

struct bench_opencl {
    cl_device_id all, one;
    cl_context context;
    cl_command_queue queue[2]; /* one core, all cores */
    cl_program program[OPENCL_MODES][2];
    cl_kernel kernel[OPENCL_MODES][2]; /* closest hit, any hit */
    cl_mem nodes, blocks;
};

static status find_cpu(bench_opencl *c)
{
    static const cl_device_partition_property one_core[] = {
        CL_DEVICE_PARTITION_BY_COUNTS, 1, CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    status rc = STATUS_OK;
    cl_platform_id platform[8];
    cl_uint count = 0;
    cl_int error = CL_SUCCESS;

    pocl_affinity_set();
    clGetPlatformIDs(8, platform, &count);
    for (cl_uint i = 0; i < count && !c->all; i++)
        clGetDeviceIDs(platform[i], CL_DEVICE_TYPE_CPU, 1, &c->all, NULL);
    NEED(c->all, STATUS_DEVICE, "no OpenCL CPU");
    error = clCreateSubDevices(c->all, one_core, 1, &c->one, NULL);
    NEED(error == CL_SUCCESS, STATUS_DEVICE, "no device of one core: %s", device_error(error));
    const cl_device_id both[2] = {c->one, c->all};
    c->context = clCreateContext(NULL, 2, both, NULL, NULL, &error);
    NEED(c->context, STATUS_DEVICE, "no context: %s", device_error(error));
    for (int i = 0; i < 2; i++) {
        c->queue[i] = clCreateCommandQueue(c->context, both[i], 0, &error);
        NEED(c->queue[i], STATUS_DEVICE, "no queue: %s", device_error(error));
    }
out:
    return rc;
}

static status build(bench_opencl *c, int mode, int any_hit)
{
    status rc = STATUS_OK;
    const char *name = any_hit ? "occluded" : "trace";
    char *text = NULL, log[4096] = "";
    cl_int error;
    cl_program *program = &c->program[mode][any_hit];

    TRY(kernel_source_read(&text, name));
    *program = clCreateProgramWithSource(c->context, 1, (const char **)&text, NULL, &error);
    NEED(*program, STATUS_DEVICE, "kernel %s: %s", name, device_error(error));
    error = clBuildProgram(*program, 0, NULL, build_options[mode], NULL, NULL);
    clGetProgramBuildInfo(*program, c->all, CL_PROGRAM_BUILD_LOG, sizeof log, log, NULL);
    NEED(error == CL_SUCCESS, STATUS_DEVICE, "kernel %s: %s\n%s", name, device_error(error), log);
    c->kernel[mode][any_hit] = clCreateKernel(*program, name, &error);
    NEED(c->kernel[mode][any_hit], STATUS_DEVICE, "kernel %s: %s", name, device_error(error));
out:
    free(text);
    return rc;
}

static status share(const bench_opencl *c, cl_mem *out, const void *memory, size_t bytes)
{
    status rc = STATUS_OK;
    cl_int error;

    *out = clCreateBuffer(c->context, CL_MEM_READ_WRITE | CL_MEM_USE_HOST_PTR, bytes,
                          (void *)memory, &error);
    NEED(*out, STATUS_DEVICE, "no buffer of %zu bytes: %s", bytes, device_error(error));
out:
    return rc;
}

status bench_opencl_open(bench_opencl **out, const bvh *tree)
{
    status rc = STATUS_OK;
    const bvh_tables *t = bvh_look(tree);
    bench_opencl *c = calloc(1, sizeof *c);

    NEED(c, STATUS_MEMORY, "no memory for OpenCL");
    TRY(find_cpu(c));
    for (int mode = 0; mode < OPENCL_MODES; mode++)
        for (int any_hit = 0; any_hit < 2; any_hit++) TRY(build(c, mode, any_hit));
    TRY(share(c, &c->nodes, t->node, t->node_count * sizeof *t->node));
    TRY(share(c, &c->blocks, t->block, t->block_count * sizeof *t->block));
    *out = c;
    c = NULL;
out:
    bench_opencl_free(c);
    return rc;
}

void bench_opencl_free(bench_opencl *c)
{
    if (!c) return;
    if (c->blocks) clReleaseMemObject(c->blocks);
    if (c->nodes) clReleaseMemObject(c->nodes);
    for (int i = 0; i < 2 * OPENCL_MODES; i++) {
        if (c->kernel[i / 2][i % 2]) clReleaseKernel(c->kernel[i / 2][i % 2]);
        if (c->program[i / 2][i % 2]) clReleaseProgram(c->program[i / 2][i % 2]);
    }
    for (int i = 0; i < 2; i++)
        if (c->queue[i]) clReleaseCommandQueue(c->queue[i]);
    if (c->context) clReleaseContext(c->context);
    if (c->one) clReleaseDevice(c->one);
    free(c);
}

typedef struct argument {
    size_t size;
    const void *value;
} argument;

static status launch(const bench_opencl *c, cl_kernel kernel, const bench_rays *rays, int mode,
                     int cores, double *out_wall_s, double *out_cpu_s)
{
    status rc = STATUS_OK;
    const size_t local = local_size[mode], items = (rays->count + batch[mode] - 1) / batch[mode];
    const size_t global = (items + local - 1) / local * local;
    const cl_command_queue queue = c->queue[cores - 1];
    cl_int error;

    *out_cpu_s = bench_cpu_s();
    *out_wall_s = clock_now_s();
    error = clEnqueueNDRangeKernel(queue, kernel, 1, NULL, &global, &local, 0, NULL, NULL);
    if (error == CL_SUCCESS) error = clFinish(queue);
    *out_wall_s = clock_now_s() - *out_wall_s;
    *out_cpu_s = bench_cpu_s() - *out_cpu_s;
    NEED(error == CL_SUCCESS, STATUS_DEVICE, "%s: %s", rays->name, device_error(error));
out:
    return rc;
}

status bench_opencl_trace(bench_opencl *c, const bench_rays *rays, int mode, int cores,
                          const bench_met *out, double *out_wall_s, double *out_cpu_s)
{
    status rc = STATUS_OK;
    const world_record world = {.ground_facet = RECORD_NONE};
    const cl_kernel kernel = c->kernel[mode][rays->any_hit];
    cl_mem ray = NULL, range = NULL, met = NULL;
    cl_uint last = 6;

    TRY(share(c, &ray, rays->of[0], rays->count * sizeof(float[6])));
    TRY(share(c, &range, out->range, rays->count * sizeof(float)));
    TRY(share(c, &met, out->triangle, rays->count * sizeof(uint32_t)));
    clSetKernelArg(kernel, 0, sizeof rays->count, &rays->count);
    clSetKernelArg(kernel, 1, sizeof rays->count, &rays->count);
    clSetKernelArg(kernel, 2, sizeof world, &world);
    clSetKernelArg(kernel, 3, sizeof c->nodes, &c->nodes);
    clSetKernelArg(kernel, 4, sizeof c->blocks, &c->blocks);
    clSetKernelArg(kernel, 5, sizeof ray, &ray);
    if (!rays->any_hit) clSetKernelArg(kernel, last++, sizeof range, &range);
    clSetKernelArg(kernel, last, sizeof met, &met);
    TRY(launch(c, kernel, rays, mode, cores, out_wall_s, out_cpu_s));
    /* Any-hit answers are bytes, in the same place. */
    const uint8_t *bits = (const uint8_t *)out->triangle;
    for (uint32_t i = rays->count; rays->any_hit && i-- > 0;) out->triangle[i] = bits[i];
out:
    if (met) clReleaseMemObject(met);
    if (range) clReleaseMemObject(range);
    if (ray) clReleaseMemObject(ray);
    return rc;
}
