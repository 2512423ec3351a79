/* Ray order: sorts the rays of a batch by direction where neighbours point to different sides, so that
 * packets hold rays that meet the same nodes. The answer to a ray does not depend on it. */
#ifndef RAY_ORDER_H
#define RAY_ORDER_H

#include "kernels/rays/ray_packet.h"

/* Rays of a work-item. */
#define RAY_BATCH (RAY_LANES == 16 ? 1024 : 1)

/* Directions fall into 8 octants of 16 cells each. */
#define RAY_ORDER_CELLS 128

#if RAY_LANES == 16

/* The cells of 16 directions; those that are no directions have one too. */
static inline uchar16 ray_order_cells(const float16 x, const float16 y, const float16 z)
{
    const float16 sum = fabs(x) + fabs(y) + fabs(z);
    const int16 u = min(convert_int16_sat(4.0f * fabs(x) / sum), 3);
    const int16 v = min(convert_int16_sat(4.0f * fabs(y) / sum), 3);
    const int16 octant = ((x < 0.0f) & 64) | ((y < 0.0f) & 32) | ((z < 0.0f) & 16);

    return convert_uchar16(octant | (u << 2) | v);
}

/* Tells whether most packets of a full batch point to several octants. */
static inline uint ray_order_is_mixed(global const float *direction, const uint stride)
{
    uint mixed = 0;

    for (uint i = 0; i < RAY_BATCH; i += 16) {
        int16 differs = 0;
        UNROLL
        for (uint k = 0; k < 3; k++) {
            const int16 bits = as_int16(vload16(0, direction + k * (size_t)stride + i));
            differs |= bits ^ bits.s0;
        }
        mixed += mask_of_16(differs) != 0;
    }
    return mixed > RAY_BATCH / 16 / 2;
}

/* Sorts ray numbers by the cells of the rays; those of one cell stay in order. */
static inline void ray_order_sort(const uchar *cell, const ushort *ray, const uint count,
                                  ushort *out_order)
{
    ushort first[RAY_ORDER_CELLS + 1];

    for (uint i = 0; i <= RAY_ORDER_CELLS; i++) first[i] = 0;
    for (uint i = 0; i < count; i++) first[cell[ray[i]] + 1]++;
    for (uint i = 0; i < RAY_ORDER_CELLS; i++) first[i + 1] += first[i];
    for (uint i = 0; i < count; i++) out_order[first[cell[ray[i]]]++] = ray[i];
}

/* Puts the rays of a batch in order: as they stand, or by cell; returns 1 for the latter.
 *   direction   (3, stride), moved to the batch; count: up to RAY_BATCH */
static inline uint ray_order_of(global const float *direction, const uint stride, const uint count,
                                ushort order[RAY_BATCH])
{
    uchar cell[RAY_BATCH];
    ushort standing[RAY_BATCH];

    if (count < RAY_BATCH || !ray_order_is_mixed(direction, stride)) return 0;
    for (uint i = 0; i < RAY_BATCH; i += 16)
        vstore16(ray_order_cells(vload16(0, direction + i), vload16(0, direction + stride + i),
                                 vload16(0, direction + 2 * (size_t)stride + i)),
                 0, cell + i);
    for (uint i = 0; i < count; i++) standing[i] = (ushort)i;
    ray_order_sort(cell, standing, count, order);
    return 1;
}

#else

static inline uint ray_order_of(global const float *direction, const uint stride, const uint count,
                                ushort order[RAY_BATCH])
{
    (void)direction;
    (void)stride;
    (void)count;
    (void)order;
    return 0;
}

#endif

#if RAY_LANES == 16

/* Takes 16 numbers by their order. */
static inline float16 ray_order_gather(global const float *from, const ushort16 order)
{
    return (float16)(from[order.s0], from[order.s1], from[order.s2], from[order.s3], from[order.s4],
                     from[order.s5], from[order.s6], from[order.s7], from[order.s8], from[order.s9],
                     from[order.sa], from[order.sb], from[order.sc], from[order.sd], from[order.se],
                     from[order.sf]);
}

/* Takes 16 rays of a sorted batch. */
static inline ray_packet ray_order_load_sorted(const world_record *world, global const float *rays,
                                               const uint stride, const ushort16 order)
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = 0xffff;
    p.loose = 1;
    UNROLL
    for (uint k = 0; k < 3; k++) {
        *(float16 *)p.origin[k] = ray_order_gather(rays + (size_t)k * stride, order);
        *(float16 *)p.direction[k] = ray_order_gather(rays + (size_t)(k + 3) * stride, order);
    }
    return p;
}

#endif

/* Takes up to RAY_LANES rays of a batch, the first of them being number `at` of the order.
 *   rays   (6, stride), moved to the batch: origins, directions */
static inline ray_packet ray_order_load(const world_record *world, global const float *rays,
                                        const uint stride, const uint sorted, const ushort *order,
                                        const uint at, const uint count)
{
    ray_packet p;

#if RAY_LANES == 16
    if (sorted) return ray_order_load_sorted(world, rays, stride, vload16(0, order + at));
#else
    (void)sorted;
    (void)order;
#endif
    if (count == RAY_LANES) return ray_packet_load(world, rays + at, stride);
    ray_packet_clear(&p, world);
    p.alive = (1u << count) - 1;
    for (uint i = 0; i < RAY_LANES && count > 0; i++) {
        const size_t from = at + (i < count ? i : 0);
        UNROLL
        for (uint k = 0; k < 3; k++) {
            p.origin[k][i] = rays[(size_t)k * stride + from];
            p.direction[k][i] = rays[(size_t)(k + 3) * stride + from];
        }
    }
    return p;
}

#endif
