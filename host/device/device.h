/* Device: an OpenCL device of any platform, its memory and its kernels (kernels/NAME.cl, whose text
 * is part of the program). Kernels are built at their first launch. */
#ifndef DEVICE_H
#define DEVICE_H

#include "base/status.h"
#include "device/device_list.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

typedef struct device device;
typedef struct _cl_mem *device_memory;

/* Opens device `index`, or with -1 the default: the first CPU, else the first device. */
status device_open(device **out, int index);
void device_free(device *dev);
const device_info *device_describe(const device *dev);

/* Memory of elements of one type, NULL until it is allocated: a type of its own, so that no other
 * elements get there. launches.h declares one for every type that kernels read or write. */
#define DEVICE_BUFFER(type)                                                                        \
    typedef union type##_buffer {                                                                  \
        device_memory memory;                                                                      \
        type *element; /* never read: tells the type */                                            \
    } type##_buffer

/* Allocates a buffer of `count` elements, filled from `initial` unless that is NULL. Fails with
 * STATUS_MEMORY where the device has no room. */
#define device_allocate(dev, out, count, initial)                                                  \
    device_memory_allocate(dev, &(out)->memory, DEVICE_BYTES(*(out), count),                       \
                           DEVICE_SOURCE(*(out), initial))

/* Gives the device host memory that is only read: a CPU uses it where it is, others get a copy. It must
 * outlive the buffer. Fails as device_allocate. */
#define device_share(dev, out, count, elements)                                                    \
    device_memory_share(dev, &(out)->memory, DEVICE_BYTES(*(out), count),                          \
                        DEVICE_SOURCE(*(out), elements))
#define device_release(buffer) device_memory_release((buffer).memory)

/* Writes the first `count` elements. */
#define device_upload(dev, buffer, count, source)                                                  \
    device_memory_upload(dev, (buffer).memory, DEVICE_BYTES(buffer, count),                        \
                         DEVICE_SOURCE(buffer, source))

/* Reads the first `count` elements. Waits for all launches before it. Failures of those launches show
 * here. */
#define device_download(dev, buffer, count, destination)                                           \
    device_memory_download(dev, (buffer).memory, DEVICE_BYTES(buffer, count),                      \
                           DEVICE_TARGET(buffer, destination))

/* Lets the host read the first `count` elements, without a copy where device and host share their
 * memory, until they are unmapped. Waits as device_download does.
 *   out   a pointer to constant elements */
#define device_map(dev, buffer, count, out)                                                        \
    device_memory_map(dev, (buffer).memory, DEVICE_BYTES(buffer, count),                           \
                      (const void **)DEVICE_VIEW(buffer, out))
#define device_unmap(dev, buffer, mapped) device_memory_unmap(dev, (buffer).memory, mapped)

#define DEVICE_BYTES(buffer, count) ((count) * sizeof *(buffer).element)

/* The pointer itself; does not compile where it points to other elements. */
#define DEVICE_TARGET(buffer, pointer)                                                             \
    _Generic((pointer), __typeof__(*(buffer).element) * : (pointer))
#define DEVICE_SOURCE(buffer, pointer)                                                             \
    _Generic((pointer),                                                                            \
        __typeof__(*(buffer).element) *: (pointer),                                                   \
        const __typeof__(*(buffer).element) *: (pointer),                                          \
        void *: (pointer)) /* NULL */
#define DEVICE_VIEW(buffer, pointer)                                                               \
    _Generic((pointer), const __typeof__(*(buffer).element) ** : (pointer))

/* What stands behind these; sizes in bytes. */
status device_memory_allocate(device *dev, device_memory *out, size_t bytes, const void *initial);
status device_memory_share(device *dev, device_memory *out, size_t bytes, const void *memory);
void device_memory_release(device_memory memory);
status device_memory_upload(device *dev, device_memory memory, size_t bytes, const void *source);
status device_memory_download(device *dev, device_memory memory, size_t bytes, void *destination);
status device_memory_map(device *dev, device_memory memory, size_t bytes, const void **out);
void device_memory_unmap(device *dev, device_memory memory, const void *mapped);

typedef struct device_shape {
    size_t size[2];
    size_t local; /* work-items of a group, along x */
    double
        item_s; /* about what a work-item, with all of its y, takes on one core; 0: a launch is short
                    */
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

typedef enum device_argument_kind {
    DEVICE_VALUE,
    DEVICE_BUFFER_NEEDED,
    DEVICE_BUFFER_OPTIONAL /* NULL is allowed */
} device_argument_kind;

/* An argument of a kernel, and where it stands in the record of its arguments. */
typedef struct device_argument {
    const char *name;
    size_t offset, size;
    device_argument_kind kind;
} device_argument;

typedef struct device_kernel {
    const char *name;
    const device_argument *arguments;
    size_t argument_count;
} device_kernel;

/* All kernels by their numbers KERNEL_...; kernels/launches.py makes the list, and launches.h. */
extern const device_kernel device_kernels[];

/* Builds a kernel before its first launch, so that it need not be waited for there. */
status device_prepare(device *dev, size_t kernel);

/* Launches a kernel over a shape; x is padded to the local size, so the kernel returns where its index
 * is past the end. A CPU takes long launches in portions along x. Waits where others would be much work,
 * so that an interrupt, with which launches and waits fail, ends within a fraction of a second. A failure
 * names kernel, shape and error; the build log is in the message. Only launches.h calls it, by functions whose arguments have names and types:
 *   planck_run(dev, shape1(n), &(planck_args){.count = n, .temperature_k = t, .radiance = out})
 *   arguments   a record of the kernel's arguments. A buffer that is left out is an error unless the
 *               kernel's signature says OPTIONAL */
status device_launch(device *dev, size_t kernel, device_shape shape, const void *arguments);

/* Time on the device since it was opened. */
typedef struct device_time {
    const char *kernel;
    double seconds;
    unsigned launches;
} device_time;

/* Waits for the launches; returns the list of all kernels, valid until the device is freed. */
status device_times(device *dev, const device_time **out, size_t *out_count);

#endif
