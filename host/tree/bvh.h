/* Tree over the triangles of a scene, for rays: binned surface area heuristic, flattened to eight
 * children a node (kernels/records.h). */
#ifndef BVH_H
#define BVH_H

#include "base/status.h"
#include "kernels/records.h"

typedef struct bvh bvh;

/* What the device needs of a tree; belongs to it. Node 0 is the root; both arrays start on 64 bytes
 * and are never empty. */
typedef struct bvh_tables {
    const bvh_node *node;
    const bvh_block *block;
    uint32_t node_count, block_count;
    uint32_t triangle_count; /* kept; those without area or with a nan or inf are left out */
    float low[3], high[3];   /* box of what was kept; all 0 where that is nothing */
} bvh_tables;

/* What a tree is built over. */
typedef struct bvh_source {
    uint32_t facet_count, vertex_count;
    const uint32_t (*corner)[4]; /* shape (facet_count), indices into position, front
                                    counter-clockwise; the fourth is UINT32_MAX for a triangle. A
                                    quad becomes two triangles of one facet (polygon_diagonal) */
    const float (*position)[3];  /* shape (vertex_count), m, from an origin near the geometry */
    const uint8_t *two_sided;    /* shape (facet_count); where it is not 0 the facet is in the tree
                                    from behind too, so that rays that cull meet both its sides;
                                    NULL: nowhere */
} bvh_source;

/* Builds the tree; the same input gives the same bytes. No facets make a tree that every ray misses.
 * Boxes are wider than the triangles by 2^-21 of the largest coordinate: what the rounding of an
 * edge test can be off by. Fails with STATUS_ARGUMENT beyond 2^27 blocks and with STATUS_MEMORY. */
status bvh_build(bvh **out, const bvh_source *source);

/* Makes a tree again of what bvh_look told of it; room for the arrays is left to the caller, who
 * fills them. */
status bvh_restore(bvh **out, const bvh_tables *tables, bvh_node **out_node, bvh_block **out_block);
void bvh_free(bvh *tree);

const bvh_tables *bvh_look(const bvh *tree);

#endif
