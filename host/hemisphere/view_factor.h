/* View factors: which facets a facet sees, and how much of its view they take, by the rays of the
 * hemisphere. */
#ifndef VIEW_FACTOR_H
#define VIEW_FACTOR_H

#include "hemisphere/shape_factor.h"
#include "mesh/geometry.h"

/* Row by row; sky, below and the shares of the facets seen sum to 1. */
typedef struct view_factors {
    size_t facet_count, share_count;
    view_record *view; /* shape (facet_count) */
    uint32_t *seen;    /* shape (share_count): the facets, the ground plane's too */
    float *fraction;   /* shape (share_count) */
} view_factors;

/* Casts the rays of `grid`, in turn from the points of each facet (facet_sample.h). What goes up and
 * meets nothing sees sky, what goes down `below`. Facets without area see sky alone.
 *   facet_count   facets from that of the geometry on, the ground plane's, see sky alone */
status view_factor_trace(view_factors **out, const ray_scene *rays, const hemisphere_grid *grid,
                         const geometry *g, size_t facet_count);
void view_factor_free(view_factors *factors);

#endif
