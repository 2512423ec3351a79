/* Point order: which points of a tile stand beside each other while their surroundings are looked at.
 * Those that face alike cast rays side by side, and what is the same for them is worked out once. */
#ifndef POINT_ORDER_H
#define POINT_ORDER_H

#include "launches.h"

/* Points of an image, row after row. */
typedef struct point_tile {
    uint32_t first, count;
    uint32_t columns; /* of the image */
} point_tile;

/* Puts points of one normal and one material together: first as many of each as fill whole groups of
 * PIXEL_GROUP, behind them the others. Of one kind those follow each other that stand in one square of
 * the image.
 *   hit     shape (tile->count); facet: per facet, the ground's too
 *   order   shape (tile->count): the point that stands at each place
 * Fails with STATUS_MEMORY. */
status point_order_fill(uint32_t *order, const hit_record *hit, const facet_record *facet,
                        const point_tile *tile);

/* The same on a device.
 *   hit         shape (tile->count)
 *   out_order   shape (tile->count); out_hit: the points in that order */
status point_order_run(device *dev, hit_record_buffer hit, const facet_record *facet,
                       const point_tile *tile, uint_buffer out_order, hit_record_buffer out_hit);

#endif
