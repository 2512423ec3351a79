/* Device list: the devices of all OpenCL platforms. */
#ifndef DEVICE_LIST_H
#define DEVICE_LIST_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

struct _cl_device_id;

/* What OpenCL says of a device; texts are cut to fit. */
typedef struct device_info {
    char platform[256], name[256], version[256], type[16];
    uint32_t index; /* as device_open counts */
    uint32_t compute_units;
    uint64_t memory_bytes, allocation_bytes;
    uint32_t
        ray_lanes; /* rays of a work-item: 16 on CPUs, else 1; RADSIG_RAY_LANES says otherwise */
    bool is_default, rounds_division; /* divisions and square roots can be rounded correctly */
} device_info;

/* Lists the devices of all platforms, in the order that `device_open` counts them.
 *   out_info   the caller frees it
 * Fails with STATUS_DEVICE where there is no platform or no device, and says what to do. */
status device_list(device_info **out_info, size_t *out_count);

/* The device `index`, or with -1 the default: the first CPU, else the first device. */
status device_list_choose(struct _cl_device_id **out_id, device_info *out_info, int index);

#endif
