/* Hemisphere packets: the rays of neighbouring points that face different ways, sorted by direction; a
 * ray's word does not depend on it. Device only. */
#ifndef HEMISPHERE_PACKETS_H
#define HEMISPHERE_PACKETS_H

#include "kernels/hemisphere/hemisphere_lanes.h"
#include "kernels/hemisphere/hemisphere_result.h"
#include "kernels/rays/ray_order.h"

/* Rows of rays that are sorted together. */
#define HEMISPHERE_RAYS (HEMISPHERE_CELLS * RAY_LANES)

/* Rays of groups of points, a group's into one cell in a row: ray number `row * RAY_LANES + lane`. */
typedef struct hemisphere_rays {
    lanes direction[HEMISPHERE_CELLS][3];
    const hemisphere_points *points[HEMISPHERE_CELLS];
    uint word[HEMISPHERE_CELLS]; /* of a row's first ray in out_met */
    uint row_count;
} hemisphere_rays;

/* Adds a group's rays; there must be room for a row per cell. */
static void hemisphere_add_rays(hemisphere_rays *rays, const hemisphere_scene *scene,
                                const hemisphere_points *points, const uint cells)
{
    const hemisphere_lanes frame = hemisphere_lanes_of(points->normal);

    for (uint c = 0; c < cells; c++) {
        const uint row = rays->row_count++;
        hemisphere_cell_directions(&frame, &points->sets, scene->cell + 4 * c,
                                   rays->direction[row]);
        rays->points[row] = points;
        rays->word[row] = c * scene->stride + points->place;
    }
}

#if RAY_LANES == 16

/* Puts the rays in order by direction if those of most rows point to several octants.
 * Returns how many they are, 0 where they do not. */
static uint hemisphere_order(const hemisphere_rays *rays, ushort order[HEMISPHERE_RAYS])
{
    uchar key[HEMISPHERE_RAYS];
    ushort living[HEMISPHERE_RAYS];
    uint mixed = 0, count = 0;

    for (uint row = 0; row < rays->row_count; row++) {
        const lanes *direction = rays->direction[row];
        const uchar16 cells = ray_order_cells(direction[0], direction[1], direction[2]);
        mixed += any(cells >> (uchar)4 != (uchar16)(cells.s0 >> 4));
        vstore16(cells, row, key);
    }
    if (mixed == 0) return 0;
    for (uint i = 0; i < rays->row_count * RAY_LANES; i++) {
        living[count] = (ushort)i;
        count += rays->points[i / RAY_LANES]->alive >> i % RAY_LANES & 1;
    }
    ray_order_sort(key, living, count, order);
    return count;
}

#else

static uint hemisphere_order(const hemisphere_rays *rays, ushort order[HEMISPHERE_RAYS])
{
    (void)rays;
    (void)order;
    return 0;
}

#endif

/* Takes the rays of a row. */
static ray_packet hemisphere_take_row(const hemisphere_rays *rays, const world_record *world,
                                      const uint row, uint word[RAY_LANES])
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = rays->points[row]->alive;
    UNROLL
    for (uint k = 0; k < 3; k++) {
        lanes_write(rays->points[row]->origin[k], p.origin[k]);
        lanes_write(rays->direction[row][k], p.direction[k]);
    }
    for (uint i = 0; i < RAY_LANES; i++) word[i] = rays->word[row] + i;
    return p;
}

/* Takes up to RAY_LANES rays of the order. */
static ray_packet hemisphere_take_some(const hemisphere_rays *rays, const world_record *world,
                                       const ushort *order, const uint count, uint word[RAY_LANES])
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = (1u << count) - 1;
    p.loose = 1;
    for (uint i = 0; i < RAY_LANES; i++) {
        const uint ray = order[i < count ? i : 0], row = ray / RAY_LANES, lane = ray % RAY_LANES;
        UNROLL
        for (uint k = 0; k < 3; k++) {
            p.origin[k][i] = ((const float *)&rays->points[row]->origin[k])[lane];
            p.direction[k][i] = ((const float *)&rays->direction[row][k])[lane];
        }
        word[i] = rays->word[row] + lane;
    }
    return p;
}

/* Casts the rays, and forgets them. */
static void hemisphere_cast_apart(ray_queue *shadows, const hemisphere_scene *scene,
                                  hemisphere_rays *rays)
{
    ushort order[HEMISPHERE_RAYS];
    const uint sorted = hemisphere_order(rays, order);
    const uint count = sorted ? sorted : rays->row_count * RAY_LANES;

    for (uint at = 0; at < count; at += RAY_LANES) {
        uint word[RAY_LANES];
        ray_packet_hit met;
        const ray_packet packet =
            sorted ? hemisphere_take_some(rays, &scene->tree.world, order + at,
                                          min(count - at, (uint)RAY_LANES), word)
                   : hemisphere_take_row(rays, &scene->tree.world, at / RAY_LANES, word);
        ray_packet_closest(scene->tree.nodes, scene->tree.blocks, &packet, &met);
        hemisphere_write(shadows, scene, &packet, &met, word);
    }
    rays->row_count = 0;
}

#endif
