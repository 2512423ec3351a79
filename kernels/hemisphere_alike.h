/* Hemisphere alike: the rays of neighbouring points that face one way, each cell's as a beam. Device
 * only, where rays go in packets. */
#ifndef HEMISPHERE_ALIKE_H
#define HEMISPHERE_ALIKE_H

#include "hemisphere_met.h"
#include "ray_beam.h"

#if RAY_LANES == 16

/* Groups of points that face one way. */
typedef struct hemisphere_alike {
    const hemisphere_points *points;
    uint count;
    ray_beam_box box[HEMISPHERE_GROUPS], all; /* where their rays begin */
} hemisphere_alike;

/* The points of a group that face as one of them does: a bit each. */
static uint hemisphere_facing_as(const hemisphere_points *points, const uint lane)
{
    uint differ = 0;

    for (int k = 0; k < 3; k++)
        differ |= lanes_bits_of(points->normal[k] != ((const float *)&points->normal[k])[lane]);
    return points->alive & ~differ;
}

/* The groups, of which one or more have points. */
static hemisphere_alike hemisphere_bundle(const hemisphere_points *points, const uint count)
{
    hemisphere_alike out = {.points = points, .count = count};
    uint some = 0;

    for (uint g = 0; g < count; g++) {
        if (points[g].alive == 0) continue;
        out.box[g] = ray_beam_box_of(points[g].origin, points[g].alive);
        out.all = some++ ? ray_beam_join(&out.all, &out.box[g]) : out.box[g];
    }
    return out;
}

/* The packet of a group's rays into one direction. */
static ray_packet hemisphere_packet(const hemisphere_points *points, const world_record *world,
                                    const float direction[3])
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = points->alive;
    UNROLL
    for (uint k = 0; k < 3; k++) {
        lanes_write(points->origin[k], p.origin[k]);
        lanes_write((lanes)direction[k], p.direction[k]);
    }
    return p;
}

/* Casts the rays of a group into a cell.
 *   list   of the groups' beam, NULL: too many leaves; first_word: of the cell */
static void hemisphere_cast_group(ray_queue *shadows, const hemisphere_scene *scene,
                                  const hemisphere_alike *alike, const uint group,
                                  const ray_beam_list *list, const float direction[3],
                                  const uint first_word)
{
    const hemisphere_points *points = &alike->points[group];
    const ray_beam beam = ray_beam_of(&alike->box[group], direction);
    ulong leaf[RAY_BEAM_LEAVES];
    const uint count = list ? ray_beam_sort(&beam, list, leaf) : 0;
    const uint down = scene->world.ground_facet != RECORD_NONE && -direction[2] > RAY_LEVEL;
    uint word[RAY_LANES];
    ray_packet_hit met;

    if (list && count == 0 && !down) return;
    const ray_packet packet = hemisphere_packet(points, &scene->world, direction);
    if (list)
        ray_beam_closest(list, leaf, count, scene->nodes, scene->blocks, &packet, &met);
    else
        ray_packet_closest(scene->nodes, scene->blocks, &packet, &met);
    for (uint i = 0; i < RAY_LANES; i++) word[i] = first_word + points->place + i;
    hemisphere_write(shadows, scene, &packet, &met, word);
}

/* Casts the rays of groups of points that all face one way. */
static void hemisphere_cast_alike(ray_queue *shadows, const hemisphere_scene *scene,
                                  const hemisphere_points *points, const uint count,
                                  const float normal[3], global const float *cell, const uint cells)
{
    const hemisphere_alike alike = hemisphere_bundle(points, count);
    const hemisphere_frame frame = hemisphere_frame_of(normal);

    for (uint c = 0; c < cells; c++) {
        ray_beam_list list;
        float in_frame[4], direction[3];
        vstore4(vload4(c, cell), 0, in_frame);
        hemisphere_direction(&frame, in_frame, direction);
        const ray_beam beam = ray_beam_of(&alike.all, direction);
        const uint listed = ray_beam_collect(&beam, scene->nodes, &list);
        for (uint g = 0; g < count; g++)
            if (points[g].alive)
                hemisphere_cast_group(shadows, scene, &alike, g, listed ? &list : 0, direction,
                                      c * scene->stride);
    }
}

#endif

#endif
