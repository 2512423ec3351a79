#define CL_TARGET_OPENCL_VERSION 120
#include "device/kernel_program.h"

#include "device/device_error.h"
#include "device/kernel_source.h"

#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <xxhash.h>

static void write_options(char *out, size_t size, const device_info *info)
{
    snprintf(out, size, "-cl-std=CL1.2 -DRAY_LANES=%u", info->ray_lanes);
}

static status build_failure(cl_program program, cl_device_id id, const device_info *info,
                            const char *name, cl_int error)
{
    char *log = NULL;
    size_t size = 0;
    status rc;

    clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, 0, NULL, &size);
    log = calloc(1, size + 1);
    if (log) clGetProgramBuildInfo(program, id, CL_PROGRAM_BUILD_LOG, size, log, NULL);
    rc = status_set(STATUS_DEVICE, "kernel %s does not build on %s: %s\n%s", name, info->name,
                    device_error(error), log ? log : "");
    free(log);
    return rc;
}

status kernel_program_build(cl_program *out, cl_context context, cl_device_id id,
                            const device_info *info, const char *name)
{
    status rc = STATUS_OK;
    cl_int error;
    cl_program program = NULL;
    char *text = NULL, options[64];

    TRY(kernel_source_read(&text, name));
    program = clCreateProgramWithSource(context, 1, (const char **)&text, NULL, &error);
    NEED(program, STATUS_DEVICE, "kernel %s: %s", name, device_error(error));
    write_options(options, sizeof options, info);
    error = clBuildProgram(program, 1, &id, options, NULL, NULL);
    if (error != CL_SUCCESS) TRY(build_failure(program, id, info, name, error));
    *out = program;
    program = NULL;
out:
    if (program) clReleaseProgram(program);
    free(text);
    return rc;
}

uint64_t kernel_program_key(const device_info *info)
{
    char options[64];
    XXH3_state_t state;

    write_options(options, sizeof options, info);
    XXH3_INITSTATE(&state);
    XXH3_64bits_reset(&state);
    XXH3_64bits_update(&state, options, strlen(options) + 1);
    XXH3_64bits_update(&state, info->name, strlen(info->name) + 1);
    XXH3_64bits_update(&state, info->version, strlen(info->version) + 1);
    for (const kernel_file *f = kernel_files; f->name; f++)
        XXH3_64bits_update(&state, f->text, strlen(f->text) + 1);
    return XXH3_64bits_digest(&state);
}
