/* Bvh memory: the tables of a tree on a device. */
#ifndef BVH_MEMORY_H
#define BVH_MEMORY_H

#include "bvh.h"
#include "device.h"

/* Starts zeroed; bvh_memory_free is then safe at any time. */
typedef struct bvh_memory {
    device_memory node, block; /* bvh_node, bvh_block */
} bvh_memory;

/* Copies the tables to the device. */
status bvh_memory_take(bvh_memory *out, device *dev, const bvh *tree);

/* Releases what the record holds, not the record. */
void bvh_memory_free(bvh_memory *m);

#endif
