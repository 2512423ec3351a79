/* Kernel program: a kernel's text, built for a device. */
#ifndef KERNEL_PROGRAM_H
#define KERNEL_PROGRAM_H

#include "device/device_list.h"

struct _cl_context;
struct _cl_program;

/* Builds kernel `name`; the caller releases the program. Fails with STATUS_DEVICE, with the build log in
 * the message. */
status kernel_program_build(struct _cl_program **out, struct _cl_context *context,
                            struct _cl_device_id *id, const device_info *info, const char *name);

#endif
