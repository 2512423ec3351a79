/* Kernels ahead: programs that are built in threads beside, each with a context of its own, because PoCL
 * builds one program at a time in a context. It keeps them on disk, so that building them again takes
 * next to no time. */
#ifndef KERNEL_AHEAD_H
#define KERNEL_AHEAD_H

#include "device/device_list.h"

typedef struct kernel_ahead kernel_ahead;

/* Starts half as many threads as there are processors, 1 to 4; `info` must outlive them. Fails with
 * STATUS_MEMORY where none can be started. */
status kernel_ahead_open(kernel_ahead **out, struct _cl_device_id *id, const device_info *info);

/* Has kernels (KERNEL_... of launches.h) built behind those that it was told before, each once. What
 * does not build is told where it is built again. */
void kernel_ahead_add(kernel_ahead *ahead, const size_t *kernels, size_t count);

/* To be called before a kernel is built elsewhere: waits if it is being built, else leaves it to the caller. */
void kernel_ahead_take(kernel_ahead *ahead, size_t kernel);

/* Waits for what is being built, and ends. True if nothing was left to be built. NULL is allowed. */
bool kernel_ahead_free(kernel_ahead *ahead);

#endif
