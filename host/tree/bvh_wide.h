/* Bvh wide: which forks of a binary tree become the children of nodes of eight, so that rays open as
 * few nodes as can be: the sum of the nodes' areas is the least possible. */
#ifndef BVH_WIDE_H
#define BVH_WIDE_H

#include "tree/bvh_binary.h"

enum { BVH_CHILDREN = 8 };

/* Finds the best choice for every fork.
 *   out_plan   shape (place_count), a word per place of the forks; the caller frees it */
status bvh_wide_plan(uint32_t **out_plan, const bvh_fork *fork, size_t place_count);

/* Lists the children of the node over fork `top`; returns how many they are. */
uint32_t bvh_wide_children(const uint32_t *plan, const bvh_fork *fork, uint32_t top,
                           uint32_t out_child[BVH_CHILDREN]);

#endif
