#include "kernels/hemisphere/hemisphere.h"

#include "kernels/hemisphere/near_rest.h"

/* The shares of the sky with what is known of near facets: the counterpart of incident_near.h.
 *   used   a bit per lane that is a point */
static lanes open_beside(lanes open, const hemisphere_tables *rays, const uint cell_count,
                         const uint first, const uint count, const uint used)
{
    global const uint *met = rays->met + (size_t)cell_count * count;
    const near_rays near = near_rays_read(rays->near_rays, met, first, count, used);
    lanes normal[3], direction[3];

    if (near.rows == 0) return open;
    for (uint i = 0; i < LANES_WIDTH; i++)
        for (int k = 0; k < 3; k++)
            LANES_SET(normal[k], i, rays->hit[lanes_place(first, i, count)].normal[k]);
    const hemisphere_lanes axes = hemisphere_lanes_of(normal);
    const hemisphere_sets sets = hemisphere_sets_of(rays->direction_set, cell_count, first, count);
    near_rest rest = near_rest_of(&near);
    for (uint c = 0; c < cell_count; c++) {
        hemisphere_cell_directions(&axes, &sets, rays->cell + 4 * c, direction);
        near_rest_add(&rest, &near, lanes_load_bits(rays->met + (size_t)c * count, first, count),
                      direction[2], (lanes)rays->cell[4 * c + 3]);
    }
    for (uint side = 0; side < 2; side++) open -= near_rest_taken(&rest, side) * rest.sky[side];
    return clamp(open, 0.0f, 1.0f);
}

/* Counts what the rays of points first .. first + LANES_WIDTH - 1 met.
 *   used      a bit per lane that is a point
 * Returns the shares of the sky. */
static inline lanes count_rays(const surface_tables *surfaces, const hemisphere_tables *rays,
                               const uint cell_count, const uint first, const uint count,
                               const uint used, hemisphere_count all[LANES_WIDTH])
{
    lanes open[2] = {(lanes)0.0f, (lanes)0.0f}, blocked[2] = {(lanes)0.0f, (lanes)0.0f};

    for (uint i = 0; i < LANES_WIDTH; i++) hemisphere_count_clear(&all[i]);
    for (uint c = 0; c < cell_count; c++) {
        const lanes_bits word = lanes_load_bits(rays->met + (size_t)c * count, first, count);
        const lanes_mask is_open = word == RECORD_NONE, is_met = word != RECORD_NONE;
        hemisphere_lanes_add(open, is_open, rays->cell[4 * c + 3]);
        hemisphere_lanes_add(blocked, is_met, rays->cell[4 * c + 3]);
        for (uint left = lanes_bits_of(is_met) & used; left; left &= left - 1) {
            const uint i = 31 - clz(left & -left);
            const uint seen = ((const uint *)&word)[i] & ~HEMISPHERE_LIT;
            hemisphere_count_met(&all[i], c, surfaces->facets[seen].material,
                                 surfaces->facet_temperature_k[seen]);
        }
    }
    return open_beside(open[0] / (open[0] + blocked[0]), rays, cell_count, first, count, used);
}

/* The entry of the commonest material; of equally common ones that of the lowest number. */
static inline uint commonest(const hemisphere_count *c, global const material_record *material)
{
    uint best = 0;

    for (uint i = 1; i < c->material_count; i++) {
        const uint more = c->rays[i] > c->rays[best];
        const uint lower = material[c->material[i]].number < material[c->material[best]].number;
        if (more || (c->rays[i] == c->rays[best] && lower)) best = i;
    }
    return best;
}

/* Sums up what the rays of the hemisphere met: eq. 2.4.2-6 and the background of 2.4.2.
 * Launch: (count / RAY_LANES, rounded up). out: (count). */
SHARED_BODY kernel void background(const uint count, const uint cell_count, TABLES(TREE_TABLES),
                                   TABLES(SURFACE_TABLES), TABLES(HEMISPHERE_TABLES),
                                   global background_record *out)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= count) return;
    const uint lane_count = min((uint)LANES_WIDTH, count - first), used = (1u << lane_count) - 1u;
    const tree_tables tree = TABLES_GIVEN(TREE_TABLES);
    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const hemisphere_tables rays = TABLES_GIVEN(HEMISPHERE_TABLES);
    hemisphere_count all[LANES_WIDTH];
    ray_packet packet;
    ray_packet_hit closest;

    const lanes open = count_rays(&surfaces, &rays, cell_count, first, count, used, all);
    ray_packet_clear(&packet, &tree.world);
    for (uint i = 0; i < lane_count; i++) {
        background_record back = {.shape_factor = ((const float *)&open)[i],
                                  .material = RECORD_NONE,
                                  .facet = RECORD_NONE};
        if (all[i].met_count > 0) {
            const uint best = commonest(&all[i], surfaces.materials);
            const hit_record at = rays.hit[first + i];
            const uint set = rays.direction_set ? rays.direction_set[first + i] : 0u;
            const ray r = hemisphere_ray(&at, rays.cell + 4u * cell_count * set, all[i].first[best],
                                         &tree.world);
            back.mean_temperature_k = all[i].base_k + all[i].excess_k / (float)all[i].met_count;
            back.material = all[i].material[best];
            back.met_count = all[i].met_count;
            ray_packet_set(&packet, i, &r);
        }
        out[hemisphere_point(rays.order, first + i)] = back;
    }
    if (!packet.alive) return;
    ray_packet_closest(tree.nodes, tree.blocks, &packet, &closest);
    for (uint i = 0; i < lane_count; i++) {
        if (!(packet.alive >> i & 1)) continue;
        const ray r = ray_packet_get(&packet, i);
        const hit_record record = hemisphere_record(&r, ray_packet_hit_of(&closest, i), &tree);
        global background_record *back = &out[hemisphere_point(rays.order, first + i)];
        back->facet = record.facet;
        vstore3(vload3(0, record.point), 0, back->point);
        vstore3(vload3(0, record.normal), 0, back->normal);
    }
}
