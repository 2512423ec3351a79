#include "kernels/rays/ray_packet.h"

#include "kernels/hemisphere/hemisphere_beams.h"
#include "kernels/hemisphere/hemisphere_packets.h"

/* Points of a group that face one way go as a beam from so many on. */
#define FEW_ALIKE 3

#if RAY_LANES == 16

/* Whether all points of all groups face one way and take one set of directions; tells which. */
static uint face_one_way(const hemisphere_points *points, const uint groups, float out_normal[3],
                         uint *out_set)
{
    uint some = 0;

    for (uint g = 0; g < groups; g++) {
        const uint alive = points[g].alive, lane = 31 - clz(alive & -alive);
        if (alive == 0) continue;
        const uint set = ((const uint *)&points[g].sets.first)[lane];
        if (hemisphere_facing_as(&points[g], lane) != alive) return 0;
        if (some && set != *out_set) return 0;
        *out_set = set;
        for (int k = 0; k < 3; k++) {
            const float normal = ((const float *)&points[g].normal[k])[lane];
            if (some && normal != out_normal[k]) return 0;
            out_normal[k] = normal;
        }
        some = 1;
    }
    return some;
}

/* Casts the rays of those points of a group that face as others do, with one set; leaves it the rest. */
static void cast_those_alike(ray_queue *shadows, const hemisphere_scene *scene,
                             hemisphere_points *points, const uint cells)
{
    uint apart = 0;

    while (points->alive) {
        const uint alive = points->alive, lane = 31 - clz(alive & -alive);
        const uint same = hemisphere_facing_as(points, lane);
        float normal[3];
        for (int k = 0; k < 3; k++) normal[k] = ((const float *)&points->normal[k])[lane];
        points->alive = same;
        if (popcount(same) < FEW_ALIKE)
            apart |= same;
        else
            hemisphere_cast_alike(shadows, scene, points, 1, normal,
                                  scene->cell + ((const uint *)&points->sets.first)[lane], cells);
        points->alive = alive & ~same;
    }
    points->alive = apart;
}

#endif

/* Casts the rays of the hemisphere above points.
 * Launch: (count / RAY_BUNDLE, cell_count / 72 where RAY_LANES is 16, else count, cell_count), rounded
 * up. sun_x, sun_y, sun_z: unit vector towards the sun; at or below the horizon, and (0, 0, 0),
 * nothing is lit. cell: (sets, cell_count, 4) direction along upslope, across and normal, weight; hit:
 * (count); direction_set: (count), NULL: the first for all; out_met: (cell_count, count) the facet met, with HEMISPHERE_LIT where the sun reaches the
 * point met; RECORD_NONE for the sky and for points without a facet. */
SHARED_BODY kernel void hemisphere(const uint count, const uint cell_count, const float sun_x,
                                   const float sun_y, const float sun_z, TABLES(TREE_TABLES),
                                   global const float *cell, global const hit_record *hit,
                                   OPTIONAL global const uint *direction_set, global uint *out_met)
{
    const uint first = get_global_id(0) * RAY_GROUPS * RAY_LANES;
    const uint first_cell = get_global_id(1) * HEMISPHERE_CELLS;
    if (first >= count || first_cell >= cell_count) return;
    const uint cells = min((uint)HEMISPHERE_CELLS, cell_count - first_cell);
    const uint left = min((uint)(RAY_GROUPS * RAY_LANES), count - first);
    const hemisphere_scene scene = {.tree = TABLES_GIVEN(TREE_TABLES),
                                    .sun = {sun_x, sun_y, sun_z},
                                    .cell = cell + 4 * first_cell,
                                    .out_met = out_met + (size_t)first_cell * count + first,
                                    .stride = count};
    ray_queue shadows = ray_queue_of(&scene.tree.world);
    hemisphere_points points[RAY_GROUPS];
    hemisphere_rays rays = {.row_count = 0};
    uint groups = 0;

    for (; groups * RAY_LANES < left; groups++)
        points[groups] = hemisphere_take_points(
            &scene.tree.world, hit + first,
            hemisphere_sets_of(direction_set, cell_count, first + groups * RAY_LANES, count),
            groups * RAY_LANES, left);
    for (uint c = 0; c < cells; c++)
        for (uint i = 0; i < left; i++) scene.out_met[c * (size_t)count + i] = RECORD_NONE;
#if RAY_LANES == 16
    float normal[3];
    uint set;
    if (face_one_way(points, groups, normal, &set)) {
        hemisphere_cast_alike(&shadows, &scene, points, groups, normal, scene.cell + set, cells);
        groups = 0;
    }
    for (uint g = 0; g < groups; g++) cast_those_alike(&shadows, &scene, &points[g], cells);
#endif
    for (uint g = 0; g < groups; g++) {
        if (points[g].alive == 0) continue;
        if (rays.row_count + cells > HEMISPHERE_CELLS)
            hemisphere_cast_apart(&shadows, &scene, &rays);
        hemisphere_add_rays(&rays, &scene, &points[g], cells);
    }
    hemisphere_cast_apart(&shadows, &scene, &rays);
    if (shadows.count > 0) hemisphere_cast_shadows(&shadows, &scene);
}
