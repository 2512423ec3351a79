#define CL_TARGET_OPENCL_VERSION 120
#include "device/kernel_program.h"

#include "device/device_error.h"
#include "device/kernel_source.h"

#include <CL/cl.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static void write_options(char *out, size_t size, const device_info *info)
{
    snprintf(out, size, "-cl-std=CL1.2 -DRAY_LANES=%u%s", info->ray_lanes,
             info->rounds_division ? " -cl-fp32-correctly-rounded-divide-sqrt" : "");
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
    char *text = NULL, options[128];

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
