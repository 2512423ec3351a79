/* Hemisphere: the frame of a facet, and the count of what its rays met. Thesis 2.4.2. */
#ifndef HEMISPHERE_H
#define HEMISPHERE_H

#include "kernels/rays/ray_packet.h"
#include "kernels/tables.h"

/* Materials that are counted at one point. */
#define HEMISPHERE_MATERIALS 256

/* Set in the word of a ray that met a facet where the sun reaches it. */
#define HEMISPHERE_LIT 0x80000000u

/* Below this horizontal part of its normal a facet counts as level. */
#define HEMISPHERE_LEVEL 1e-4f

/* Directions in a facet's plane: upslope (north where it is level), and a quarter turn clockwise
 * from there as seen from above the facet (east where it is level and faces up). */
typedef struct hemisphere_frame {
    float upslope[3], across[3], normal[3];
} hemisphere_frame;

static inline hemisphere_frame hemisphere_frame_of(const float normal[3])
{
    const float level = sqrt(normal[0] * normal[0] + normal[1] * normal[1]);
    hemisphere_frame f;

    for (int k = 0; k < 3; k++) f.normal[k] = normal[k];
    f.upslope[0] = level < HEMISPHERE_LEVEL ? 0.0f : -normal[2] * normal[0] / level;
    f.upslope[1] = level < HEMISPHERE_LEVEL ? 1.0f : -normal[2] * normal[1] / level;
    f.upslope[2] = level < HEMISPHERE_LEVEL ? 0.0f : level;
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        f.across[k] = f.upslope[a] * normal[b] - f.upslope[b] * normal[a];
    }
    return f;
}

/* Turns a direction of the grid (upslope, across, normal) into the world's. */
static inline void hemisphere_direction(const hemisphere_frame *f, const float in_frame[3],
                                        float out[3])
{
    for (int k = 0; k < 3; k++)
        out[k] =
            (in_frame[0] * f->upslope[k] + in_frame[1] * f->across[k]) + in_frame[2] * f->normal[k];
}

/* Ray `c` of the hemisphere above a point.
 *   cell   (cell_count, 4): direction along upslope, across and normal, weight */
static inline ray hemisphere_ray(const hit_record *at, global const float *cell, const uint c,
                                 const world_record *world)
{
    const hemisphere_frame frame = hemisphere_frame_of(at->normal);
    float in_frame[4], direction[3];

    vstore4(vload4(c, cell), 0, in_frame);
    hemisphere_direction(&frame, in_frame, direction);
    return ray_leaving(world, at->point, at->normal, direction);
}

/* What such a ray met; what leaves the geometry going down meets the ground plane if there is one. */
static inline hit_record hemisphere_record(const ray *r, const ray_hit met, const tree_tables *tree)
{
    hit_record record = ray_record(tree->blocks, r, met);

    if (record.facet == RECORD_NONE) ray_meet_ground(&tree->world, r, &record);
    return record;
}

/* What was met above one point: each material once, with its rays and the first of them. */
typedef struct hemisphere_count {
    uint material[HEMISPHERE_MATERIALS], rays[HEMISPHERE_MATERIALS], first[HEMISPHERE_MATERIALS];
    uint material_count, met_count;
    float base_k, excess_k; /* first temperature met, and the sum of what the others exceed it by */
} hemisphere_count;

static inline void hemisphere_count_clear(hemisphere_count *c)
{
    c->material_count = c->met_count = 0;
    c->base_k = c->excess_k = 0;
}

/* Counts ray number `cell`, which met a facet. */
static inline void hemisphere_count_met(hemisphere_count *c, const uint cell, const uint material,
                                        const float temperature_k)
{
    uint i = 0;

    if (c->met_count++ == 0) c->base_k = temperature_k;
    c->excess_k += temperature_k - c->base_k;
    while (i < c->material_count && c->material[i] != material) i++;
    if (i == HEMISPHERE_MATERIALS) return;
    if (i == c->material_count) {
        c->material[i] = material;
        c->rays[i] = 0;
        c->first[i] = cell;
        c->material_count++;
    }
    c->rays[i]++;
}

#endif
