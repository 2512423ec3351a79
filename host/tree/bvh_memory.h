/* Bvh memory: the tables of a tree on a device. */
#ifndef BVH_MEMORY_H
#define BVH_MEMORY_H

#include "launches.h"
#include "tree/bvh.h"

/* Starts zeroed; bvh_memory_free is then safe at any time. */
typedef struct bvh_memory {
    bvh_node_buffer node;
    bvh_block_buffer block;
    bvh *tree;
} bvh_memory;

/* Puts the tables on the device, and takes the tree over: *tree is NULL where that succeeds. */
status bvh_memory_take(bvh_memory *out, device *dev, bvh **tree);

/* Releases what the record holds, not the record. */
void bvh_memory_free(bvh_memory *m);

#endif
