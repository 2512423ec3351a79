#include "kernels/hemisphere/hemisphere.h"

/* How much of light that goes on from facet to facet can reach facets at one more depth: what they
 * reflect of what the facets they see had of it before.
 * Launch: (count). reflectance, before, reach: per facet, the ground's too; reach is written where a hit is */
kernel void interreflection_reach(const uint count, const uint cell_count,
                                  TABLES(HEMISPHERE_TABLES), global const float *reflectance,
                                  global const float *before, global float *reach)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    const hemisphere_tables rays = TABLES_GIVEN(HEMISPHERE_TABLES);
    const uint facet = rays.hit[i].facet;
    float sum = 0.0f;
    if (facet == RECORD_NONE) return;

    for (uint c = 0; c < cell_count; c++) {
        const uint word = rays.met[(size_t)c * count + i];
        if (word != RECORD_NONE) sum += rays.cell[4u * c + 3u] * before[word & ~HEMISPHERE_LIT];
    }
    reach[facet] = reflectance[facet] * sum;
}
