#include "kernels/hemisphere/near_search.h"

/* What the directions of a set bring too little of each near facet: its form factor less the weights of those that
 * meet it. */
typedef struct near_lack {
    form_factor_cone cone[NEAR_FACETS];
    lanes weight[NEAR_FACETS];
} near_lack;

/* Points that stand so close, in distances from the camera, are looked at together. */
#define NEAR_TOGETHER 0.001f

static float range_of(global const hit_record *hit, const uint alive)
{
    return hit[31 - clz(alive & -alive)].range_m;
}

static uint rows_of(const near_list *near)
{
    uint most = 0;

    for (uint i = 0; i < LANES_WIDTH; i++) most = max(most, near->count[i]);
    return most;
}

/* The triangle of each lane in a row; those of lanes that have none are points. */
static form_factor_triangle triangle_of(const near_list *near, const uint row,
                                        global const bvh_block *blocks)
{
    form_factor_triangle t;

    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) {
            t.corner[v][k] = near->points->origin[k];
            for (uint i = 0; i < LANES_WIDTH; i++) {
                if (row >= near->count[i]) continue;
                const uint at = near->triangle[row][i];
                LANES_SET(t.corner[v][k], i, blocks[at / 8].vertex[v][k][at % 8]);
            }
            t.corner[v][k] -= near->points->origin[k];
        }
    return t;
}

static void find_lack(near_lack *out, const near_list *near, const uint rows,
                      const tree_tables *tree, global const float *cell, const uint cell_count)
{
    const hemisphere_points *points = near->points;
    const hemisphere_lanes axes = hemisphere_lanes_of(points->normal);
    const hemisphere_shares shares = hemisphere_shares_of(&axes, &points->sets, cell, cell_count);

    for (uint row = 0; row < rows; row++) {
        const form_factor_triangle t = triangle_of(near, row, tree->blocks);
        out->cone[row] = form_factor_cone_of(&t);
        out->weight[row] = near->fraction[row];
    }
    for (uint c = 0; c < cell_count; c++) {
        lanes direction[3];
        hemisphere_cell_directions(&axes, &points->sets, cell + 4 * c, direction);
        const lanes weight = cell[4 * c + 3] * (direction[2] > 0.0f ? shares.above : shares.below);
        for (uint row = 0; row < rows; row++)
            out->weight[row] -=
                form_factor_meets(&out->cone[row], direction) ? weight : (lanes)0.0f;
    }
}

/* Looks from each point at the near facet of a row: whether it is seen, and lit. */
static ray_packet_hit look(ray_queue *shadows, const hemisphere_scene *scene, const near_list *near,
                           const uint row, lanes direction[3])
{
    const hemisphere_points *points = near->points;
    uint word[RAY_LANES];
    ray_packet packet;
    ray_packet_hit met;

    ray_packet_clear(&packet, &scene->tree.world);
    for (uint i = 0; i < LANES_WIDTH; i++) {
        packet.alive |= (uint)(row < near->count[i]) << i;
        word[i] = row * scene->stride + points->place + i;
    }
    const lanes length = sqrt(form_factor_dot(near->towards[row], near->towards[row]));
    for (uint k = 0; k < 3; k++) {
        direction[k] = near->towards[row][k] / length;
        lanes_write(points->origin[k], packet.origin[k]);
        lanes_write(direction[k], packet.direction[k]);
    }
    ray_packet_closest(scene->tree.nodes, scene->tree.blocks, &packet, &met);
    hemisphere_write(shadows, scene, &packet, &met, word);
    return met;
}

/* Writes a row: weights, 0 for what is hidden, and directions. */
static void write_row(const near_list *near, const uint row, const near_lack *lack,
                      const ray_packet_hit *met, const lanes direction[3], const tree_tables *tree,
                      const uint count, global float *out)
{
    for (uint i = 0; i < LANES_WIDTH; i++) {
        if (row >= near->count[i]) continue;
        const uint at = near->triangle[row][i];
        global float *to = out + (size_t)row * 4 * count + i;
        if (met->facet[i] != tree->blocks[at / 8].facet[at % 8]) continue;
        to[0] = ((const float *)&lack->weight[row])[i];
        for (uint k = 0; k < 3; k++) to[(k + 1) * count] = ((const float *)&direction[k])[i];
    }
}

/* Finds the facets near each point, by geometry alone, and what its set of directions brings too little of those that
 * it sees the middle of: the form factor, less the weights of the directions that meet them.
 * Launch: (count / RAY_LANES, rounded up). sun_x, sun_y, sun_z: as hemisphere.cl. rays: cell, hit and direction_set
 * are read; out_met: (cell_count + NEAR_FACETS, count), the last rows: the facets, as hemisphere.cl has them;
 * out_near: (NEAR_FACETS, 4, count) what is lacking, 0 for none, and the direction of the facet's middle. */
SHARED_BODY kernel void near_facets(const uint count, const uint cell_count, const float sun_x,
                                    const float sun_y, const float sun_z, TABLES(TREE_TABLES),
                                    TABLES(HEMISPHERE_TABLES), global uint *out_met,
                                    global float *out_near)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= count) return;
    const uint left = min((uint)LANES_WIDTH, count - first);
    const hemisphere_tables rays = TABLES_GIVEN(HEMISPHERE_TABLES);
    const hemisphere_scene scene = {.tree = TABLES_GIVEN(TREE_TABLES),
                                    .sun = {sun_x, sun_y, sun_z},
                                    .out_met = out_met + (size_t)cell_count * count + first,
                                    .stride = count};
    const hemisphere_points points = hemisphere_take_points(
        &scene.tree.world, rays.hit + first,
        hemisphere_sets_of(rays.direction_set, cell_count, first, count), 0, left);
    ray_queue shadows = ray_queue_of(&scene.tree.world);
    near_list list = {.points = &points};
    near_lack lack;

    for (uint row = 0; row < NEAR_FACETS; row++)
        for (uint i = 0; i < left; i++) {
            out_near[(size_t)row * 4 * count + first + i] = 0.0f;
            scene.out_met[(size_t)row * count + i] = RECORD_NONE;
        }
    if (!points.alive) return;
    near_find(&list, &scene.tree, NEAR_TOGETHER * range_of(rays.hit + first, points.alive));
    const uint rows = rows_of(&list);
    if (rows == 0) return;
    find_lack(&lack, &list, rows, &scene.tree, rays.cell, cell_count);
    for (uint row = 0; row < rows; row++) {
        lanes direction[3];
        const ray_packet_hit seen = look(&shadows, &scene, &list, row, direction);
        write_row(&list, row, &lack, &seen, direction, &scene.tree, count, out_near + first);
    }
    if (shadows.count > 0) hemisphere_cast_shadows(&shadows, &scene);
}
