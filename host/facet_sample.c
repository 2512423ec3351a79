#include "facet_sample.h"

#include "polygon.h"

#include <string.h>

/* Weights of the corners. */
static const float quarters[FACET_SAMPLES][3] = {{1.0f / 3.0f, 1.0f / 3.0f, 1.0f / 3.0f},
                                                 {2.0f / 3.0f, 1.0f / 6.0f, 1.0f / 6.0f},
                                                 {1.0f / 6.0f, 2.0f / 3.0f, 1.0f / 6.0f},
                                                 {1.0f / 6.0f, 1.0f / 6.0f, 2.0f / 3.0f}};
static const float halves[2][3] = {{1.0f / 6.0f, 2.0f / 3.0f, 1.0f / 6.0f},
                                   {1.0f / 2.0f, 1.0f / 6.0f, 1.0f / 3.0f}};

static void set_point(hit_record *out, const geometry *g, uint32_t facet, const uint32_t corner[3],
                      const float weight[3])
{
    *out = (hit_record){.facet = facet};
    memcpy(out->normal, g->normal[facet], sizeof out->normal);
    for (int k = 0; k < 3; k++)
        for (int v = 0; v < 3; v++) out->point[k] += weight[v] * g->position[corner[v]][k];
}

void facet_sample(hit_record out[FACET_SAMPLES], const geometry *g, uint32_t facet)
{
    const uint32_t *c = g->corner[facet];

    if (c[3] == UINT32_MAX) {
        for (int i = 0; i < FACET_SAMPLES; i++) set_point(&out[i], g, facet, c, quarters[i]);
        return;
    }
    const uint32_t d = polygon_diagonal(c, (const float(*)[3])g->position);
    const uint32_t first[3] = {c[d], c[d + 1], c[d + 2]};
    const uint32_t second[3] = {c[d], c[d + 2], c[(d + 3) % 4]};
    for (int i = 0; i < 2; i++) {
        set_point(&out[i], g, facet, first, halves[i]);
        set_point(&out[2 + i], g, facet, second, halves[i]);
    }
}
