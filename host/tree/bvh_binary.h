/* Binary tree over boxes by the binned surface area heuristic: what bvh.c flattens. */
#ifndef BVH_BINARY_H
#define BVH_BINARY_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

enum { BVH_BLOCK_SIZE = 8 };

/* The box of a triangle. */
typedef struct bvh_item {
    float low[3];
    uint32_t triangle;
    float high[3];
    uint32_t unused; /* 32 bytes: two to a cache line */
} bvh_item;

/* A node; its left child is the next of the array. */
typedef struct bvh_fork {
    float low[3], high[3];
    uint32_t right;        /* index of the right child; 0: a leaf */
    uint32_t first, count; /* items */
} bvh_fork;

/* Builds the tree over `count` >= 1 items, which are reordered so that every node's are adjacent. All
 * processors work on it; the tree does not depend on their number.
 *   even       halves the items at every node instead of asking the heuristic: no path is then
 *              longer than 28 nodes
 *   out_fork   node 0 the root; out_count nodes, (out_count + 1) / 2 of them leaves, with unused
 *              places between them; the caller frees it
 * A leaf has at most BVH_BLOCK_SIZE items. Fails with STATUS_MEMORY. */
status bvh_binary_build(bvh_fork **out_fork, uint32_t *out_count, bvh_item *item, uint32_t count,
                        bool even);

/* Half the surface of a box; 0 for an empty one. */
float bvh_half_area(const float low[3], const float high[3]);

#endif
