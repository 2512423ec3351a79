#include "ray_order.h"

#define LANES_WIDTH RAY_LANES
#include "hemisphere_lanes.h"
#include "hit_lanes.h"
#include "ray_queue.h"

/* Cells of a work-item. */
#define CELLS (RAY_LANES == 16 ? 72 : 1)
#define RAYS (CELLS * RAY_LANES)

/* The scene, the sun, and where the words go. */
typedef struct hemisphere_scene {
    world_record world;
    global const bvh_node *nodes;
    global const bvh_block *blocks;
    float sun[3];
    global uint *out_met; /* of the first point in the first cell */
    uint stride;          /* points of a cell */
} hemisphere_scene;

/* Rays of RAY_LANES points into the cells of a work-item: ray number `cell * RAY_LANES + lane`. */
typedef struct hemisphere_rays {
    lanes origin[3];
    lanes direction[CELLS][3];
    uint alive; /* a bit per point */
} hemisphere_rays;

/* Makes the rays of points first .. first + RAY_LANES - 1 into `cell_count` cells. Lanes without a
 * point have the directions of the last that has one. */
static void make_rays(hemisphere_rays *rays, const world_record *world, const uint first,
                      const uint count, global const hit_record *hit, global const float *cell,
                      const uint cell_count)
{
    lanes normal[3] = {(lanes)0.0f, (lanes)0.0f, (lanes)1.0f};

    rays->alive = 0;
    for (uint i = 0; i < RAY_LANES && first + i < count; i++) {
        const hit_record at = hit[first + i];
        if (at.facet == RECORD_NONE) continue;
        rays->alive |= 1u << i;
        for (int k = 0; k < 3; k++) {
            const lanes all = (lanes)at.normal[k];
            normal[k] = rays->alive == 1u << i ? all : normal[k];
            LANES_SET(normal[k], i, at.normal[k]);
            LANES_SET(rays->origin[k], i, at.point[k] + world->offset_m * at.normal[k]);
        }
    }
    const hemisphere_lanes frame = hemisphere_lanes_of(normal);
    for (uint c = 0; c < cell_count && rays->alive; c++) {
        hemisphere_lanes_direction(&frame, cell + 4 * c, rays->direction[c]);
    }
}

#if RAY_LANES == 16

/* Puts the rays in order by direction if those of most cells point to several octants.
 * Returns how many they are, 0 where they do not. */
static uint order_rays(const hemisphere_rays *rays, const uint cell_count, ushort order[RAYS])
{
    uchar key[RAYS];
    ushort living[RAYS];
    uint mixed = 0, count = 0;

    for (uint c = 0; c < cell_count; c++) {
        const uchar16 cells =
            ray_order_cells(rays->direction[c][0], rays->direction[c][1], rays->direction[c][2]);
        mixed += any(cells >> (uchar)4 != (uchar16)(cells.s0 >> 4));
        vstore16(cells, c, key);
    }
    if (mixed == 0) return 0;
    for (uint i = 0; i < cell_count * RAY_LANES; i++) {
        living[count] = (ushort)i;
        count += rays->alive >> i % RAY_LANES & 1;
    }
    ray_order_sort(key, living, count, order);
    return count;
}

#else

static uint order_rays(const hemisphere_rays *rays, const uint cell_count, ushort order[RAYS])
{
    (void)rays;
    (void)cell_count;
    (void)order;
    return 0;
}

#endif

/* Takes the rays of a cell. */
static ray_packet take_cell(const hemisphere_rays *rays, const world_record *world, const uint c)
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = rays->alive;
    UNROLL
    for (uint k = 0; k < 3; k++) {
        lanes_write(rays->origin[k], p.origin[k]);
        lanes_write(rays->direction[c][k], p.direction[k]);
    }
    return p;
}

/* Takes up to RAY_LANES rays of the order. */
static ray_packet take_some(const hemisphere_rays *rays, const world_record *world,
                            const ushort *order, const uint count)
{
    ray_packet p;

    ray_packet_clear(&p, world);
    p.alive = (1u << count) - 1;
    p.loose = 1;
    for (uint i = 0; i < RAY_LANES; i++) {
        const uint ray = order[i < count ? i : 0], lane = ray % RAY_LANES;
        UNROLL
        for (uint k = 0; k < 3; k++) {
            p.origin[k][i] = ((const float *)&rays->origin[k])[lane];
            p.direction[k][i] = ((const float *)&rays->direction[ray / RAY_LANES][k])[lane];
        }
    }
    return p;
}

/* Casts the rays towards the sun that wait; the words that mark those that reach it say so. */
static void cast_shadows(ray_queue *shadows, const hemisphere_scene *scene)
{
    const uint reached = ray_queue_cast(shadows, scene->nodes, scene->blocks);

    for (uint i = 0; i < RAY_LANES; i++)
        if (reached >> i & 1) scene->out_met[shadows->mark[i]] |= HEMISPHERE_LIT;
}

/* Sees to it that the words of points met tell whether the sun reaches them.
 *   have   a bit per lane that met a facet; word: of each lane in out_met */
static void look_for_sun(ray_queue *shadows, const hemisphere_scene *scene,
                         const ray_packet *packet, const ray_packet_hit *met, const uint have,
                         const uint *word)
{
    const float *sun = scene->sun;
    lanes origin[3], direction[3];

    for (int k = 0; k < 3; k++) {
        origin[k] = lanes_read(packet->origin[k]);
        direction[k] = lanes_read(packet->direction[k]);
    }
    const hit_lanes at = hit_lanes_of(scene->blocks, origin, direction, met);
    const lanes facing = (at.normal[0] * sun[0] + at.normal[1] * sun[1]) + at.normal[2] * sun[2];
    for (uint lit = lanes_bits_of(facing > 0.0f) & have; lit; lit &= lit - 1) {
        const uint i = 31 - clz(lit & -lit);
        float point[3], normal[3];
        for (int k = 0; k < 3; k++) {
            point[k] = ((const float *)&at.point[k])[i];
            normal[k] = ((const float *)&at.normal[k])[i];
        }
        const ray r = ray_leaving(&scene->world, point, normal, sun);
        if (ray_queue_add(shadows, &r, word[i])) cast_shadows(shadows, scene);
    }
}

/* Casts a packet and writes the words of rays that met something.
 *   ray   the number of each lane's ray */
static void cast_packet(ray_queue *shadows, const hemisphere_scene *scene, const ray_packet *packet,
                        const ushort *ray)
{
    const world_record *world = &scene->world;
    const uint day = scene->sun[2] > 0;
    ray_packet_hit met;
    uint word[RAY_LANES], have = 0;

    ray_packet_closest(scene->nodes, scene->blocks, packet, &met);
    for (uint i = 0; i < RAY_LANES; i++) {
        if (!(packet->alive >> i & 1)) continue;
        const uint is_ground = met.facet[i] == RECORD_NONE && world->ground_facet != RECORD_NONE &&
                               -packet->direction[2][i] > RAY_LEVEL;
        if (met.facet[i] == RECORD_NONE && !is_ground) continue;
        word[i] = ray[i] / RAY_LANES * scene->stride + ray[i] % RAY_LANES;
        scene->out_met[word[i]] =
            is_ground ? world->ground_facet | (day ? HEMISPHERE_LIT : 0) : met.facet[i];
        have |= (uint)!is_ground << i;
    }
    if (day && have) look_for_sun(shadows, scene, packet, &met, have, word);
}

/* Casts the rays of the hemisphere above points. Where neighbouring points have directions of their
 * own, rays are sorted by direction; a word does not depend on it.
 * Launch: (count / RAY_LANES, cell_count / 72 where RAY_LANES is 16, else cell_count), rounded up.
 * sun_x, sun_y, sun_z: unit vector towards the sun; at or below the horizon, and (0, 0, 0), nothing
 * is lit. cell: (cell_count, 4) direction along upslope, across and normal, weight; hit: (count);
 * out_met: (cell_count, count) the facet met, with HEMISPHERE_LIT where the sun reaches the point
 * met; RECORD_NONE for the sky and for points without a facet. */
kernel void hemisphere(const uint count, const uint cell_count, const float sun_x,
                       const float sun_y, const float sun_z, const world_record world,
                       global const bvh_node *nodes, global const bvh_block *blocks,
                       global const float *cell, global const hit_record *hit, global uint *out_met)
{
    const uint first = get_global_id(0) * RAY_LANES, first_cell = get_global_id(1) * CELLS;
    if (first >= count || first_cell >= cell_count) return;
    const uint cells = min((uint)CELLS, cell_count - first_cell);
    const hemisphere_scene scene = {.world = world,
                                    .nodes = nodes,
                                    .blocks = blocks,
                                    .sun = {sun_x, sun_y, sun_z},
                                    .out_met = out_met + (size_t)first_cell * count + first,
                                    .stride = count};
    ray_queue shadows = ray_queue_of(&world);
    hemisphere_rays rays;
    ushort order[RAYS];

    for (uint c = 0; c < cells; c++)
        for (uint i = 0; i < RAY_LANES && first + i < count; i++)
            scene.out_met[c * (size_t)count + i] = RECORD_NONE;
    make_rays(&rays, &world, first, count, hit, cell + 4 * first_cell, cells);
    if (rays.alive == 0) return;
    const uint sorted = order_rays(&rays, cells, order);
    for (uint at = 0; at < sorted; at += RAY_LANES) {
        const ray_packet packet =
            take_some(&rays, &world, order + at, min(sorted - at, (uint)RAY_LANES));
        cast_packet(&shadows, &scene, &packet, order + at);
    }
    for (uint c = 0; c < cells && sorted == 0; c++) {
        const ray_packet packet = take_cell(&rays, &world, c);
        for (uint i = 0; i < RAY_LANES; i++) order[i] = (ushort)(c * RAY_LANES + i);
        cast_packet(&shadows, &scene, &packet, order);
    }
    if (shadows.count > 0) cast_shadows(&shadows, &scene);
}
