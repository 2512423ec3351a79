/* Point order: which points of a tile stand beside each other while their surroundings are looked at.
 * Those that face alike cast rays side by side, and what is the same for them is worked out once. */
#ifndef POINT_ORDER_H
#define POINT_ORDER_H

#include "../kernels/records.h"

#include "device.h"

/* Puts points of one normal and one material together, as many as fill whole groups of PIXEL_GROUP,
 * in the order in which a first one appears; behind them the others. Among equals the order stays.
 *   hit     shape (count); facet: per facet, the ground's too
 *   order   shape (count): the point that stands at each place
 * Fails with STATUS_MEMORY. */
status point_order_fill(uint32_t *order, const hit_record *hit, const facet_record *facet,
                        uint32_t count);

/* The same on a device.
 *   hit         hit_record, shape (count)
 *   out_order   uint32, shape (count); out_hit: hit_record, shape (count): the points in that order */
status point_order_run(device *dev, device_memory hit, const facet_record *facet, uint32_t count,
                       device_memory out_order, device_memory out_hit);

#endif
