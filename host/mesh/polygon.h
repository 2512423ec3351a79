/* Polygon: faces cut into triangles, concave ones too. */
#ifndef POLYGON_H
#define POLYGON_H

#include "base/status.h"

#include <stdint.h>

/* Cuts a face of `count` >= 3 corners into count - 2 triangles that turn as it does, by clipping
 * ears in the plane where its area is largest. Every corner is used; what crosses itself or has no
 * area gives triangles all the same, but which ones means nothing.
 *   corner         shape (count), indices into position
 *   out_triangle   shape (count - 2), indices into position; the caller allocates
 * Fails with STATUS_MEMORY. */
status polygon_split(uint32_t count, const uint32_t *corner, const double (*position)[3],
                     uint32_t (*out_triangle)[3]);

/* The corner, 0 or 1, where the diagonal begins that cuts a quad into the triangles
 * (d, d + 1, d + 2) and (d, d + 2, d + 3): 1 where the quad is concave at corner 1 or 3, else 0. */
uint32_t polygon_diagonal(const uint32_t corner[4], const float (*position)[3]);

#endif
