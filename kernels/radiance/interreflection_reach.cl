#include "kernels/hemisphere/hemisphere.h"

/* How much of light that goes on from facet to facet can reach facets at one more depth: what they
 * reflect of what the facets they see had of it before.
 * Launch: (count). cell: (cell_count, 4), met: (cell_count, count): see hemisphere.cl; hit: (count)
 * reflectance, before, reach: per facet, the ground's too; reach is written where a hit is */
kernel void interreflection_reach(const uint count, const uint cell_count, global const float *cell,
                                  global const hit_record *hit, global const uint *met,
                                  global const float *reflectance, global const float *before,
                                  global float *reach)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const uint facet = hit[i].facet;
    float sum = 0.0f;
    if (facet == RECORD_NONE) return;

    for (uint c = 0; c < cell_count; c++) {
        const uint word = met[(size_t)c * count + i];
        if (word != RECORD_NONE) sum += cell[4u * c + 3u] * before[word & ~HEMISPHERE_LIT];
    }
    reach[facet] = reflectance[facet] * sum;
}
