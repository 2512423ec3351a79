#define CL_TARGET_OPENCL_VERSION 120
#include "device/device.h"

#include "base/interrupt.h"
#include "device/device_error.h"
#include "device/kernel_program.h"
#include "device/pocl_cache.h"
#include "device/pocl_manifest.h"
#include "launches.h"

#include <CL/cl.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* Times are kept as events until someone waits; then they are added up. */
enum { PENDING_LIMIT = 1024 };

/* An interrupt waits for about so much work on its way, in portions of long launches. */
static const double pending_limit_s = 0.1, portion_s = 0.15;

typedef struct built_kernel {
    cl_program program;
    cl_kernel kernel; /* NULL: not built yet */
} built_kernel;

typedef struct device_launch_event {
    cl_event event;
    size_t kernel;
} device_launch_event;

struct device {
    cl_device_id id;
    cl_context context;
    cl_command_queue queue;
    device_info info;
    built_kernel kernels[KERNEL_COUNT];
    device_time times[KERNEL_COUNT];
    device_launch_event pending[PENDING_LIMIT];
    size_t pending_count;
    double pending_s; /* what they are expected to take */
    bool is_pocl;
};

status device_open(device **out, int index)
{
    status rc = STATUS_OK;
    cl_int error;
    device *dev = calloc(1, sizeof *dev);

    NEED(dev, STATUS_MEMORY, "no memory for a device");
    TRY(device_list_choose(&dev->id, &dev->info, index));
    dev->context = clCreateContext(NULL, 1, &dev->id, NULL, NULL, &error);
    NEED(dev->context, STATUS_DEVICE, "device %s: no context: %s", dev->info.name,
         device_error(error));
    dev->queue = clCreateCommandQueue(dev->context, dev->id, CL_QUEUE_PROFILING_ENABLE, &error);
    NEED(dev->queue, STATUS_DEVICE, "device %s: no queue: %s", dev->info.name, device_error(error));
    dev->is_pocl = strstr(dev->info.platform, "Portable Computing Language") != NULL;
    if (dev->is_pocl) pocl_manifest_check(pocl_cache_folder());
    for (size_t i = 0; i < KERNEL_COUNT; i++) dev->times[i].kernel = device_kernels[i].name;
    *out = dev;
    dev = NULL;
out:
    device_free(dev);
    return rc;
}

/* Waits for all launches, and adds up their times. */
static status collect_times(device *dev)
{
    const cl_int error = clFinish(dev->queue);
    status rc = STATUS_OK;

    for (size_t i = 0; i < dev->pending_count; i++) {
        const device_launch_event *launch = &dev->pending[i];
        cl_ulong start = 0, end = 0;
        cl_int state = CL_COMPLETE;
        clGetEventInfo(launch->event, CL_EVENT_COMMAND_EXECUTION_STATUS, sizeof state, &state,
                       NULL);
        clGetEventProfilingInfo(launch->event, CL_PROFILING_COMMAND_START, sizeof start, &start,
                                NULL);
        clGetEventProfilingInfo(launch->event, CL_PROFILING_COMMAND_END, sizeof end, &end, NULL);
        clReleaseEvent(launch->event);
        dev->times[launch->kernel].seconds += 1e-9 * (double)(end - start);
        dev->times[launch->kernel].launches++;
        if (state < 0 && rc == STATUS_OK)
            rc = status_set(STATUS_DEVICE, "kernel %s failed on %s: %s",
                            device_kernels[launch->kernel].name, dev->info.name,
                            device_error(state));
    }
    dev->pending_count = 0;
    dev->pending_s = 0.0;
    if (rc == STATUS_OK && error != CL_SUCCESS)
        rc = status_set(STATUS_DEVICE, "device %s: %s", dev->info.name, device_error(error));
    return rc;
}

static status wait_for_launches(device *dev)
{
    status rc = STATUS_OK;

    TRY(collect_times(dev));
    TRY(interrupt_check());
out:
    return rc;
}

void device_free(device *dev)
{
    if (!dev) return;
    if (dev->queue) collect_times(dev);
    if (dev->is_pocl) pocl_manifest_update(pocl_cache_folder());
    for (size_t i = 0; i < KERNEL_COUNT; i++) {
        if (!dev->kernels[i].kernel) continue;
        clReleaseKernel(dev->kernels[i].kernel);
        clReleaseProgram(dev->kernels[i].program);
    }
    if (dev->queue) clReleaseCommandQueue(dev->queue);
    if (dev->context) clReleaseContext(dev->context);
    free(dev);
}

const device_info *device_describe(const device *dev)
{
    return &dev->info;
}

static status allocation_status(cl_int error)
{
    return error == CL_MEM_OBJECT_ALLOCATION_FAILURE || error == CL_OUT_OF_RESOURCES ||
                   error == CL_OUT_OF_HOST_MEMORY || error == CL_INVALID_BUFFER_SIZE
               ? STATUS_MEMORY
               : STATUS_DEVICE;
}

static status create(device *dev, device_memory *out, cl_mem_flags flags, size_t bytes,
                     const void *host)
{
    status rc = STATUS_OK;
    cl_int error;

    /* A buffer of no bytes is not allowed; empty arrays get one that nobody reads. */
    if (bytes == 0) host = NULL;
    *out = clCreateBuffer(dev->context, CL_MEM_READ_WRITE | (host ? flags : 0), bytes ? bytes : 64,
                          (void *)host, &error);
    NEED(*out, allocation_status(error), "device %s: no room for %zu bytes: %s", dev->info.name,
         bytes, device_error(error));
out:
    return rc;
}

status device_memory_allocate(device *dev, device_memory *out, size_t bytes, const void *initial)
{
    return create(dev, out, CL_MEM_COPY_HOST_PTR, bytes, initial);
}

status device_memory_share(device *dev, device_memory *out, size_t bytes, const void *memory)
{
    const bool in_place = !strcmp(dev->info.type, "cpu");

    return create(dev, out, in_place ? CL_MEM_USE_HOST_PTR : CL_MEM_COPY_HOST_PTR, bytes, memory);
}

void device_memory_release(device_memory memory)
{
    if (memory) clReleaseMemObject(memory);
}

status device_memory_upload(device *dev, device_memory memory, size_t bytes, const void *source)
{
    status rc = STATUS_OK;
    const cl_int error =
        bytes ? clEnqueueWriteBuffer(dev->queue, memory, CL_TRUE, 0, bytes, source, 0, NULL, NULL)
              : CL_SUCCESS;

    NEED(error == CL_SUCCESS, allocation_status(error), "device %s: writing %zu bytes: %s",
         dev->info.name, bytes, device_error(error));
out:
    return rc;
}

status device_memory_download(device *dev, device_memory memory, size_t bytes, void *destination)
{
    status rc = STATUS_OK;
    cl_int error;

    TRY(wait_for_launches(dev));
    if (bytes == 0) goto out;
    error = clEnqueueReadBuffer(dev->queue, memory, CL_TRUE, 0, bytes, destination, 0, NULL, NULL);
    NEED(error == CL_SUCCESS, allocation_status(error), "device %s: reading %zu bytes: %s",
         dev->info.name, bytes, device_error(error));
out:
    return rc;
}

status device_memory_map(device *dev, device_memory memory, size_t bytes, const void **out)
{
    status rc = STATUS_OK;
    cl_int error;
    void *mapped;

    TRY(wait_for_launches(dev));
    mapped = clEnqueueMapBuffer(dev->queue, memory, CL_TRUE, CL_MAP_READ, 0, bytes, 0, NULL, NULL,
                                &error);
    NEED(mapped, allocation_status(error), "device %s: mapping %zu bytes: %s", dev->info.name,
         bytes, device_error(error));
    *out = mapped;
out:
    return rc;
}

void device_memory_unmap(device *dev, device_memory memory, const void *mapped)
{
    if (!mapped) return;
    clEnqueueUnmapMemObject(dev->queue, memory, (void *)mapped, 0, NULL, NULL);
    clFinish(dev->queue);
}

status device_prepare(device *dev, size_t kernel)
{
    status rc = STATUS_OK;
    cl_program program = NULL;
    cl_int error;

    if (dev->kernels[kernel].kernel) return STATUS_OK;
    TRY(interrupt_check());
    TRY(kernel_program_build(&program, dev->context, dev->id, &dev->info,
                             device_kernels[kernel].name));
    dev->kernels[kernel].kernel = clCreateKernel(program, device_kernels[kernel].name, &error);
    NEED(dev->kernels[kernel].kernel, STATUS_DEVICE, "kernel %s on %s: %s",
         device_kernels[kernel].name, dev->info.name, device_error(error));
    dev->kernels[kernel].program = program;
    program = NULL;
out:
    if (program) clReleaseProgram(program);
    return rc;
}

static status set_arguments(device *dev, size_t kernel, const char *arguments)
{
    status rc = STATUS_OK;
    const device_kernel *own = &device_kernels[kernel];

    for (cl_uint i = 0; i < own->argument_count; i++) {
        const device_argument *a = &own->arguments[i];
        const void *value = arguments + a->offset;
        NEED(a->kind != DEVICE_BUFFER_NEEDED || *(const device_memory *)value, STATUS_DEVICE,
             "kernel %s: argument %s is missing", own->name, a->name);
        const cl_int error = clSetKernelArg(dev->kernels[kernel].kernel, i, a->size, value);
        NEED(error == CL_SUCCESS, STATUS_DEVICE, "kernel %s on %s, argument %s: %s", own->name,
             dev->info.name, a->name, device_error(error));
    }
out:
    return rc;
}

/* What a launch is expected to take, going by the others of its kernel; the first one is waited for. */
static double expected_s(const device_time *so_far)
{
    return so_far->launches ? so_far->seconds / so_far->launches : pending_limit_s;
}

static status enqueue(device *dev, size_t kernel, size_t first, size_t size,
                      const device_shape *shape)
{
    status rc = STATUS_OK;
    const double wait_s = expected_s(&dev->times[kernel]);
    const size_t offset[2] = {first, 0}, global[2] = {size, shape->size[1]};
    const size_t local[2] = {shape->local, 1};
    const bool is_full = dev->pending_count == PENDING_LIMIT;
    cl_event event;
    cl_int error;

    if (is_full || dev->pending_s + wait_s > pending_limit_s) TRY(collect_times(dev));
    TRY(interrupt_check());
    error = clEnqueueNDRangeKernel(dev->queue, dev->kernels[kernel].kernel, 2,
                                   first ? offset : NULL, global, local, 0, NULL, &event);
    NEED(error == CL_SUCCESS, allocation_status(error), "kernel %s over %zu x %zu on %s: %s",
         device_kernels[kernel].name, shape->size[0], shape->size[1], dev->info.name,
         device_error(error));
    dev->pending[dev->pending_count++] = (device_launch_event){event, kernel};
    dev->pending_s += wait_s;
out:
    return rc;
}

/* Work-items along x of one portion of a launch over `padded` of them. */
static size_t portion_of(const device *dev, const device_shape *shape, size_t padded)
{
    const double items = portion_s * dev->info.compute_units / shape->item_s;
    const size_t groups = (size_t)fmin(items / (double)shape->local, (double)padded);

    if (shape->item_s == 0.0 || strcmp(dev->info.type, "cpu")) return padded;
    return (groups ? groups : 1) * shape->local;
}

status device_launch(device *dev, size_t kernel, device_shape shape, const void *arguments)
{
    status rc = STATUS_OK;
    const size_t padded = (shape.size[0] + shape.local - 1) / shape.local * shape.local;
    const size_t portion = portion_of(dev, &shape, padded);

    if (shape.size[0] == 0 || shape.size[1] == 0) return STATUS_OK;
    TRY(device_prepare(dev, kernel));
    TRY(set_arguments(dev, kernel, arguments));
    for (size_t first = 0; first < padded; first += portion)
        TRY(enqueue(dev, kernel, first, padded - first < portion ? padded - first : portion,
                    &shape));
out:
    return rc;
}

device_shape device_ray_shape(const device *dev, size_t rays, size_t y)
{
    const size_t lanes = dev->info.ray_lanes;

    /* A packet's stack is large: a group of few stays in the cache. */
    return (device_shape){{(rays + lanes - 1) / lanes, y}, lanes == 1 ? 64 : 4, 0.0};
}

device_shape device_bundle_shape(const device *dev, size_t points, size_t y)
{
    if (dev->info.ray_lanes == 1) return device_ray_shape(dev, points, y);
    return (device_shape){{(points + RAY_BUNDLE - 1) / RAY_BUNDLE, y}, 1, 0.0};
}

status device_times(device *dev, const device_time **out, size_t *out_count)
{
    status rc = STATUS_OK;

    TRY(collect_times(dev));
    *out = dev->times;
    *out_count = KERNEL_COUNT;
out:
    return rc;
}
