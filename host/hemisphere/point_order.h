/* Point order: which points of a tile stand beside each other while their surroundings are looked at.
 * Those that face alike cast rays side by side, and what is the same for them is worked out once. */
#ifndef POINT_ORDER_H
#define POINT_ORDER_H

#include "launches.h"

#include <stdbool.h>

/* Samples of an image's pixels, row after row, those of a pixel together. */
typedef struct point_tile {
    uint32_t first, count;
    uint32_t columns, samples;        /* pixels of a row, samples of a pixel */
    uint32_t first_column, first_row; /* of the whole frame, that the image begins at */
    uint32_t seed;
    bool has_sets; /* points take sets of directions, hemisphere_strata.h */
} point_tile;

/* Puts points of one normal, one material and one set of directions together: first as many of each as fill whole groups of
 * PIXEL_GROUP, behind them the others. Of one kind those follow each other that stand in one square of
 * the image.
 *   hit     shape (tile->count); facet: per facet, the ground's too
 *   order   shape (tile->count): the point that stands at each place; set: that it takes
 * Fails with STATUS_MEMORY. */
status point_order_fill(uint32_t *order, uint32_t *set, const hit_record *hit,
                        const facet_record *facet, const point_tile *tile);

/* The same on a device.
 *   hit         shape (tile->count)
 *   out_order   shape (tile->count); out_set: the same; out_hit: the points in that order */
status point_order_run(device *dev, hit_record_buffer hit, const facet_record *facet,
                       const point_tile *tile, uint_buffer out_order, uint_buffer out_set,
                       hit_record_buffer out_hit);

#endif
