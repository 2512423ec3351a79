/* Corner tree: finds whether one of many points in a plane lies in a triangle; points leave it one
 * by one. Boxes over runs of the points in z-order (Morton 1966). */
#ifndef CORNER_TREE_H
#define CORNER_TREE_H

#include "base/status.h"

#include <stdint.h>

typedef struct corner_tree corner_tree;

/* Builds the tree over all points, which outlive it.
 *   at   shape (count); not-a-number and infinity are allowed
 * Fails with STATUS_MEMORY. */
status corner_tree_build(corner_tree **out, const double (*at)[2], uint32_t count);
void corner_tree_free(corner_tree *tree);

/* Takes a point out. */
void corner_tree_remove(corner_tree *tree, uint32_t point);

/* Finds a point in a triangle that turns to the left, its edges included; points at the place of one
 * of its corners do not count. Exactly those with a corner_tree_turn of 0 or more at each edge are
 * in it, whatever is rounded. Returns UINT32_MAX if there is none. */
uint32_t corner_tree_find(const corner_tree *tree, const uint32_t triangle[3]);

/* Twice the signed area of a triangle; positive to the left of a-b. */
static inline double corner_tree_turn(const double a[2], const double b[2], const double c[2])
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

#endif
