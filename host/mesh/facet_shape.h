/* Facet shape: local origin, normal, area, slope and azimuth of the facets. Thesis 2.3.2. */
#ifndef FACET_SHAPE_H
#define FACET_SHAPE_H

#include "mesh/geometry.h"

/* Sets origin, positions, box, normals, areas, slopes and azimuths of a geometry whose corners are
 * set. The origin is the middle of the finite positions in whole metres.
 *   position   shape (vertex_count), ENU m, double: subtracted from the origin before it is rounded */
status facet_shape_set(geometry *g, const double (*position)[3]);

#endif
