/* Device: an OpenCL device of any platform, its memory and its kernels (kernels/NAME.cl, whose text
 * is part of the program). Kernels are built at their first launch. */
#ifndef DEVICE_H
#define DEVICE_H

#include "status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct device device;
typedef struct _cl_mem *device_memory;

/* What OpenCL says of a device; texts are cut to fit. */
typedef struct device_info {
    char platform[256], name[256], version[256], type[16];
    uint32_t index; /* as device_open counts */
    uint32_t compute_units;
    uint64_t memory_bytes, allocation_bytes;
    uint32_t
        ray_lanes; /* rays of a work-item: 16 on CPUs, else 1; RADSIG_RAY_LANES says otherwise */
    bool is_default;
} device_info;

/* Lists the devices of all platforms, in the order that `device_open` counts them.
 *   out_info   the caller frees it
 * Fails with STATUS_DEVICE where there is no platform, naming the package to install. */
status device_list(device_info **out_info, size_t *out_count);

/* Opens device `index`, or with -1 the default: the first CPU, else the first device. */
status device_open(device **out, int index);
void device_free(device *dev);
const device_info *device_describe(const device *dev);

/* Allocates device memory, filled from `initial` unless that is NULL. Fails with STATUS_MEMORY
 * where the device has no room. */
status device_allocate(device *dev, device_memory *out, size_t bytes, const void *initial);

/* Gives the device host memory that is only read: a CPU uses it where it is, others get a copy. It must
 * outlive `out`. Fails as device_allocate. */
status device_share(device *dev, device_memory *out, size_t bytes, const void *memory);
void device_release(device_memory memory);

status device_upload(device *dev, device_memory memory, size_t offset, size_t bytes,
                     const void *source);

/* Waits for all launches before it. Failures of those launches show here. */
status device_download(device *dev, device_memory memory, size_t offset, size_t bytes,
                       void *destination);

/* Lets the host read memory from its start, without a copy where device and host share theirs, until
 * it is unmapped. Waits as device_download does. */
status device_map(device *dev, device_memory memory, size_t bytes, const void **out);
void device_unmap(device *dev, device_memory memory, const void *mapped); /* NULL is allowed */

typedef struct device_shape {
    size_t size[2];
    size_t local; /* work-items of a group, along x */
    double
        item_s; /* about what a work-item, with all of its y, takes on one core; 0: a launch is short */
} device_shape;

static inline device_shape shape1(size_t x)
{
    return (device_shape){{x, 1}, 64, 0.0};
}

static inline device_shape shape2(size_t x, size_t y)
{
    return (device_shape){{x, y}, 64, 0.0};
}

/* Launches whose work-items have ray_lanes rays each: `rays` of them along x. */
device_shape device_ray_shape(const device *dev, size_t rays, size_t y);

/* Launches whose work-items look at RAY_BUNDLE points where rays go in packets, else at one: `points`
 * of them along x. */
device_shape device_bundle_shape(const device *dev, size_t points, size_t y);

typedef struct device_argument {
    size_t size;
    const void *value;
} device_argument;

/* A kernel argument: device_memory or a scalar or record; `value` must be a variable. */
#define ARG(value) ((device_argument){sizeof(value), &(value)})

/* Builds kernel `name` before its first launch, so that it need not be waited for there. */
status device_prepare(device *dev, const char *name);

/* Launches kernel `name` over a shape; x is padded to the local size, so the kernel returns where
 * its index is past the end. A CPU takes long launches in portions along x. Waits where others would be
 * much work, so that an interrupt, with which launches and waits fail, ends within a fraction of a second.
 * A failure names kernel, shape and error; the build log is in the message.
 *   device_run(dev, "planck", shape1(n), ARG(n), ARG(temperature_k), ARG(radiance)) */
#define device_run(dev, name, shape, ...)                                                          \
    device_launch(dev, name, shape, (device_argument[]){__VA_ARGS__},                              \
                  sizeof((device_argument[]){__VA_ARGS__}) / sizeof(device_argument))
status device_launch(device *dev, const char *name, device_shape shape,
                     const device_argument *arguments, size_t argument_count);

/* Time on the device per kernel since it was opened; one that was only prepared has no launches. */
typedef struct device_time {
    const char *kernel;
    double seconds;
    unsigned launches;
} device_time;

/* Waits for the launches; returns the list, valid until the device is freed. */
status device_times(device *dev, const device_time **out, size_t *out_count);

#endif
