#include "hemisphere.h"

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
 * Launch: (count). cell: (cell_count, 4); facet, temperature_k: per facet, the ground's too;
 * material: per material; hit: (count); met: (cell_count, count) as hemisphere.cl writes it;
 * out: (count). */
kernel void background(const uint count, const uint cell_count, const world_record world,
                       global const bvh_node *nodes, global const bvh_block *blocks,
                       global const float *cell, global const facet_record *facet,
                       global const float *temperature_k, global const material_record *material,
                       global const hit_record *hit, global const uint *met,
                       global background_record *out)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const hit_record at = hit[i];
    background_record back = {.shape_factor = 1.0f, .material = RECORD_NONE, .facet = RECORD_NONE};
    hemisphere_count all;

    hemisphere_count_clear(&all);
    for (uint c = 0; at.facet != RECORD_NONE && c < cell_count; c++) {
        const uint word = met[(size_t)c * count + i], seen = word & ~HEMISPHERE_LIT;
        if (word == RECORD_NONE)
            hemisphere_add(all.open, cell[4 * c + 3]);
        else
            hemisphere_count_met(&all, c, cell[4 * c + 3], facet[seen].material,
                                 temperature_k[seen]);
    }
    if (all.met_count > 0) {
        const uint best = commonest(&all, material);
        const ray r = hemisphere_ray(&at, cell, all.first[best], &world);
        const hit_record record =
            hemisphere_record(&r, ray_closest(nodes, blocks, &r), &world, blocks);
        back.shape_factor = all.open[0] / (all.open[0] + all.blocked[0]);
        back.mean_temperature_k = all.base_k + all.excess_k / (float)all.met_count;
        back.material = all.material[best];
        back.facet = record.facet;
        back.met_count = all.met_count;
        vstore3(vload3(0, record.point), 0, back.point);
        vstore3(vload3(0, record.normal), 0, back.normal);
    }
    out[i] = back;
}
