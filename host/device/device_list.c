#define CL_TARGET_OPENCL_VERSION 120
#include "device/device_list.h"

#include "device/pocl_affinity.h"
#include "device/pocl_cache.h"

#include <CL/cl.h>
#include <stdlib.h>
#include <string.h>

enum { PACKET = 16 };

/* A packet a work-item where there are vectors. */
static uint32_t choose_ray_lanes(const device_info *info)
{
    const char *wanted = getenv("RADSIG_RAY_LANES");

    if (wanted && !strcmp(wanted, "1")) return 1;
    if (wanted && !strcmp(wanted, "16")) return PACKET;
    return strcmp(info->type, "cpu") ? 1 : PACKET;
}

static void describe(device_info *info, cl_platform_id platform, cl_device_id id)
{
    cl_device_type type = 0;
    cl_ulong memory = 0, allocation = 0;
    cl_device_fp_config single = 0;
    cl_uint units = 0;

    memset(info, 0, sizeof *info);
    clGetPlatformInfo(platform, CL_PLATFORM_NAME, sizeof info->platform, info->platform, NULL);
    clGetDeviceInfo(id, CL_DEVICE_NAME, sizeof info->name, info->name, NULL);
    clGetDeviceInfo(id, CL_DEVICE_VERSION, sizeof info->version, info->version, NULL);
    clGetDeviceInfo(id, CL_DEVICE_TYPE, sizeof type, &type, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_COMPUTE_UNITS, sizeof units, &units, NULL);
    clGetDeviceInfo(id, CL_DEVICE_GLOBAL_MEM_SIZE, sizeof memory, &memory, NULL);
    clGetDeviceInfo(id, CL_DEVICE_MAX_MEM_ALLOC_SIZE, sizeof allocation, &allocation, NULL);
    clGetDeviceInfo(id, CL_DEVICE_SINGLE_FP_CONFIG, sizeof single, &single, NULL);
    /* The CPU bit is looked at first: some CPU devices claim every type. */
    strcpy(info->type, type & CL_DEVICE_TYPE_CPU   ? "cpu"
                       : type & CL_DEVICE_TYPE_GPU ? "gpu"
                                                   : "accelerator");
    info->ray_lanes = choose_ray_lanes(info);
    info->rounds_division = single & CL_FP_CORRECTLY_ROUNDED_DIVIDE_SQRT;
    info->compute_units = units;
    info->memory_bytes = memory;
    info->allocation_bytes = allocation;
}

typedef struct device_choice {
    cl_platform_id platform;
    cl_device_id id;
} device_choice;

enum { PLATFORM_LIMIT = 16, DEVICE_LIMIT = 64 };

static status find_devices(device_choice choices[DEVICE_LIMIT], size_t *out_count)
{
    status rc = STATUS_OK;
    cl_platform_id platforms[PLATFORM_LIMIT];
    cl_device_id ids[DEVICE_LIMIT];
    cl_uint platform_count = 0, id_count;
    size_t count = 0;

    pocl_affinity_set();
    pocl_cache_choose();
    if (clGetPlatformIDs(PLATFORM_LIMIT, platforms, &platform_count) != CL_SUCCESS)
        platform_count = 0;
    if (platform_count > PLATFORM_LIMIT) platform_count = PLATFORM_LIMIT;
    NEED(platform_count > 0, STATUS_DEVICE,
         "no OpenCL platform was found: install one, for the CPU the package pocl-opencl-icd");
    for (cl_uint p = 0; p < platform_count; p++) {
        if (clGetDeviceIDs(platforms[p], CL_DEVICE_TYPE_ALL, DEVICE_LIMIT, ids, &id_count))
            continue;
        for (cl_uint d = 0; d < id_count && d < DEVICE_LIMIT && count < DEVICE_LIMIT; d++)
            choices[count++] = (device_choice){platforms[p], ids[d]};
    }
    NEED(count > 0 || pocl_cache_is_usable(), STATUS_DEVICE,
         "no OpenCL device: PoCL needs a folder for its kernels, and %s cannot be written or is "
         "full: "
         "POCL_CACHE_DIR names another",
         pocl_cache_folder());
    NEED(
        count > 0, STATUS_DEVICE,
        "no OpenCL platform has a device: for the CPU install the package pocl-opencl-icd, or find "
        "out by POCL_DEBUG=err why it has none (memory may be short)");
    *out_count = count;
out:
    return rc;
}

/* Describes the devices that were found; the caller frees the list. */
static status describe_all(device_info **out, const device_choice *choices, size_t count)
{
    status rc = STATUS_OK;
    size_t preferred = 0;
    device_info *info = calloc(count, sizeof *info);

    NEED(info, STATUS_MEMORY, "no memory for the list of devices");
    for (size_t i = 0; i < count; i++) {
        describe(&info[i], choices[i].platform, choices[i].id);
        info[i].index = (uint32_t)i;
    }
    for (size_t i = count; i-- > 0;)
        if (!strcmp(info[i].type, "cpu")) preferred = i;
    info[preferred].is_default = true;
    *out = info;
out:
    return rc;
}

status device_list(device_info **out_info, size_t *out_count)
{
    status rc = STATUS_OK;
    device_choice choices[DEVICE_LIMIT];

    TRY(find_devices(choices, out_count));
    TRY(describe_all(out_info, choices, *out_count));
out:
    return rc;
}

status device_list_choose(cl_device_id *out_id, device_info *out_info, int index)
{
    status rc = STATUS_OK;
    device_choice choices[DEVICE_LIMIT];
    device_info *info = NULL;
    size_t count;

    TRY(find_devices(choices, &count));
    TRY(describe_all(&info, choices, count));
    NEED(index < (int)count, STATUS_ARGUMENT,
         "device %d: unknown, expected 0 to %zu (radsig devices)", index, count - 1);
    for (size_t i = 0; index < 0; i++)
        if (info[i].is_default) index = (int)i;
    *out_id = choices[index].id;
    *out_info = info[index];
out:
    free(info);
    return rc;
}
