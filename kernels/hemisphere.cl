#include "hemisphere.h"
#include "ray.h"

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

/* Samples the hemisphere above points: eq. 2.4.2-6 and the background of 2.4.2.
 * Launch: (count). cell: (cell_count, 4) direction along upslope, across and normal, weight;
 * facet, temperature_k: per facet, the ground's too; material: per material; hit, out: (count). */
kernel void hemisphere(const uint count, const uint cell_count, const world_record world,
                       global const bvh_node *nodes, global const bvh_block *blocks,
                       global const float *cell, global const facet_record *facet,
                       global const float *temperature_k, global const material_record *material,
                       global const hit_record *hit, global background_record *out)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const hit_record at = hit[i];
    background_record back = {.shape_factor = 1.0f, .material = RECORD_NONE, .facet = RECORD_NONE};
    const hemisphere_frame frame = hemisphere_frame_of(at.normal);
    hemisphere_count met;
    float in_frame[4], direction[3];
    hit_record record;

    hemisphere_count_clear(&met);
    for (uint c = 0; at.facet != RECORD_NONE && c < cell_count; c++) {
        vstore4(vload4(c, cell), 0, in_frame);
        hemisphere_direction(&frame, in_frame, direction);
        const ray r = ray_leaving(&world, at.point, at.normal, direction);
        record.facet = ray_closest(nodes, blocks, &r).facet;
        if (record.facet == RECORD_NONE && !ray_meet_ground(&world, &r, &record))
            hemisphere_add(met.open, in_frame[3]);
        else
            hemisphere_count_met(&met, c, in_frame[3], facet[record.facet].material,
                                 temperature_k[record.facet]);
    }
    if (met.met_count > 0) {
        const uint best = commonest(&met, material);
        vstore4(vload4(met.first[best], cell), 0, in_frame);
        hemisphere_direction(&frame, in_frame, direction);
        const ray r = ray_leaving(&world, at.point, at.normal, direction);
        record = ray_record(blocks, &r, ray_closest(nodes, blocks, &r));
        if (record.facet == RECORD_NONE) ray_meet_ground(&world, &r, &record);
        back.shape_factor = met.open[0] / (met.open[0] + met.blocked[0]);
        back.mean_temperature_k = met.base_k + met.excess_k / (float)met.met_count;
        back.material = met.material[best];
        back.facet = record.facet;
        back.met_count = met.met_count;
        vstore3(vload3(0, record.point), 0, back.point);
        vstore3(vload3(0, record.normal), 0, back.normal);
    }
    out[i] = back;
}
