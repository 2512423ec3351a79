/* Hemisphere beams: the rays of neighbouring points that face one way, each cell's as a beam. Device
 * only, where rays go in packets. */
#ifndef HEMISPHERE_BEAMS_H
#define HEMISPHERE_BEAMS_H

#include "kernels/hemisphere/hemisphere_result.h"
#include "kernels/rays/ray_beam.h"

#if RAY_LANES == 16

/* Groups of points that face one way. */
typedef struct hemisphere_alike {
    ray_beam_box box[RAY_GROUPS], all; /* where their rays begin */
} hemisphere_alike;

/* The points of a group that face as one of them does and take its set of directions: a bit each. */
static uint hemisphere_facing_as(const hemisphere_points *points, const uint lane)
{
    uint differ = lanes_bits_of(points->sets.first != ((const uint *)&points->sets.first)[lane]);

    for (int k = 0; k < 3; k++)
        differ |= lanes_bits_of(points->normal[k] != ((const float *)&points->normal[k])[lane]);
    return points->alive & ~differ;
}

/* The groups, of which one or more have points. */
static hemisphere_alike hemisphere_bundle(const hemisphere_points *points, const uint count)
{
    hemisphere_alike out;
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

/* The rays of groups into a cell. */
typedef struct hemisphere_beam {
    float direction[3];
    uint down; /* 1: what they miss is the ground */
    ray_beam beam;
    ray_beam_list list;
    uint listed; /* 0: too many leaves */
} hemisphere_beam;

static void hemisphere_set_beam(hemisphere_beam *out, const hemisphere_scene *scene,
                                const hemisphere_alike *alike, const hemisphere_frame *frame,
                                global const float *cell)
{
    float in_frame[4];

    vstore4(vload4(0, cell), 0, in_frame);
    hemisphere_direction(frame, in_frame, out->direction);
    out->down = scene->tree.world.ground_facet != RECORD_NONE && -out->direction[2] > RAY_LEVEL;
    out->beam = ray_beam_of(&alike->all, out->direction);
    out->listed = ray_beam_collect(&out->beam, scene->tree.nodes, &out->list);
}

/* Casts the rays of a group.
 *   first_word   of the cell */
static void hemisphere_cast_group(ray_queue *shadows, const hemisphere_scene *scene,
                                  const hemisphere_points *points, const ray_beam_box *box,
                                  const hemisphere_beam *wide, const uint first_word)
{
    const ray_beam beam = ray_beam_from(wide->beam, box);
    ulong leaf[RAY_BEAM_LEAVES];
    const uint count = wide->listed ? ray_beam_sort(&beam, &wide->list, leaf) : 0;
    uint word[RAY_LANES];
    ray_packet_hit met;

    if (wide->listed && count == 0 && !wide->down) return;
    const ray_packet packet = hemisphere_packet(points, &scene->tree.world, wide->direction);
    if (wide->listed)
        ray_beam_closest(&wide->list, leaf, count, scene->tree.nodes, scene->tree.blocks, &packet,
                         &met);
    else
        ray_packet_closest(scene->tree.nodes, scene->tree.blocks, &packet, &met);
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
    hemisphere_beam wide;

    for (uint c = 0; c < cells; c++) {
        hemisphere_set_beam(&wide, scene, &alike, &frame, cell + 4 * c);
        if (wide.listed && wide.list.count == 0 && !wide.down) continue;
        for (uint g = 0; g < count; g++)
            if (points[g].alive)
                hemisphere_cast_group(shadows, scene, &points[g], &alike.box[g], &wide,
                                      c * scene->stride);
    }
}

#endif

#endif
