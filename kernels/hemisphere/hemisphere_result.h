/* Hemisphere result: the words of what rays of the hemisphere met, and whether the sun reaches it. Device
 * only. */
#ifndef HEMISPHERE_RESULT_H
#define HEMISPHERE_RESULT_H

#include "kernels/hemisphere/hemisphere_lanes.h"
#include "kernels/rays/hit_lanes.h"
#include "kernels/rays/ray_queue.h"

/* Cells of a work-item. */
#define HEMISPHERE_CELLS (RAY_LANES == 16 ? 72 : 1)

/* The scene, the sun, and where the words go. */
typedef struct hemisphere_scene {
    tree_tables tree;
    float sun[3];
    global const float *cell; /* of the first set */
    global uint *out_met;     /* of the first point in the first cell */
    uint stride;              /* points of a cell */
} hemisphere_scene;

/* Points that stand side by side. */
typedef struct hemisphere_points {
    lanes origin[3]; /* where their rays begin */
    lanes normal[3];
    hemisphere_sets sets;
    uint alive; /* a bit per point on a facet */
    uint place; /* of the first in a cell */
} hemisphere_points;

/* Takes a group. Lanes without a point have the normal of one that has one.
 *   place   of the first among `count` */
static hemisphere_points hemisphere_take_points(const world_record *world,
                                                global const hit_record *hit,
                                                const hemisphere_sets sets, const uint place,
                                                const uint count)
{
    hemisphere_points out = {.sets = sets, .alive = 0, .place = place};

    for (uint i = 0; i < RAY_LANES && place + i < count; i++) {
        const hit_record at = hit[place + i];
        if (at.facet == RECORD_NONE) continue;
        const float offset_m = ray_offset(world, at.point, at.normal);
        out.alive |= 1u << i;
        for (int k = 0; k < 3; k++) {
            if (out.alive == 1u << i) out.normal[k] = (lanes)at.normal[k];
            LANES_SET(out.normal[k], i, at.normal[k]);
            LANES_SET(out.origin[k], i, at.point[k] + offset_m * at.normal[k]);
        }
    }
    return out;
}

/* Casts the rays towards the sun that wait; the words that mark those that reach it say so. */
static void hemisphere_cast_shadows(ray_queue *shadows, const hemisphere_scene *scene)
{
    const uint reached = ray_queue_cast(shadows, scene->tree.nodes, scene->tree.blocks);

    for (uint i = 0; i < RAY_LANES; i++)
        if (reached >> i & 1) scene->out_met[shadows->mark[i]] |= HEMISPHERE_LIT;
}

/* Sees to it that the words of points met tell whether the sun reaches them.
 *   have   a bit per lane that met a facet; word: of each lane in out_met */
static void hemisphere_look_for_sun(ray_queue *shadows, const hemisphere_scene *scene,
                                    const ray_packet *packet, const ray_packet_hit *met,
                                    const uint have, const uint *word)
{
    const float *sun = scene->sun;
    lanes origin[3], direction[3];

    for (int k = 0; k < 3; k++) {
        origin[k] = lanes_read(packet->origin[k]);
        direction[k] = lanes_read(packet->direction[k]);
    }
    const hit_lanes at = hit_lanes_of(scene->tree.blocks, origin, direction, met);
    const lanes facing = (at.normal[0] * sun[0] + at.normal[1] * sun[1]) + at.normal[2] * sun[2];
    const lanes offset_m = hit_lanes_offset(&scene->tree.world, &at);
    for (int k = 0; k < 3; k++) origin[k] = at.point[k] + offset_m * at.normal[k];
    for (uint lit = lanes_bits_of(facing > 0.0f) & have; lit; lit &= lit - 1) {
        const uint i = 31 - clz(lit & -lit);
        ray r = {.direction = {sun[0], sun[1], sun[2]}};
        for (int k = 0; k < 3; k++) r.origin[k] = ((const float *)&origin[k])[i];
        if (ray_queue_add(shadows, &r, word[i])) hemisphere_cast_shadows(shadows, scene);
    }
}

/* Writes the words of rays of a packet that met something: a facet, or the ground where it goes down.
 *   word   of each lane in out_met */
static void hemisphere_write(ray_queue *shadows, const hemisphere_scene *scene,
                             const ray_packet *packet, const ray_packet_hit *met, const uint *word)
{
    const uint ground = scene->tree.world.ground_facet, day = scene->sun[2] > 0;
    const lanes_mask is_missed = *(const lanes_bits *)met->facet == RECORD_NONE;
    const uint have = packet->alive & ~lanes_bits_of(is_missed);
    uint down =
        packet->alive & lanes_bits_of(is_missed & (lanes_read(packet->direction[2]) < -RAY_LEVEL));

    for (uint left = have; left; left &= left - 1) {
        const uint i = 31 - clz(left & -left);
        scene->out_met[word[i]] = met->facet[i];
    }
    for (; down && ground != RECORD_NONE; down &= down - 1)
        scene->out_met[word[31 - clz(down & -down)]] = ground | (day ? HEMISPHERE_LIT : 0);
    if (day && have) hemisphere_look_for_sun(shadows, scene, packet, met, have, word);
}

#endif
