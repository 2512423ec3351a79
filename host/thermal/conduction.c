#include "thermal/conduction.h"
#include "base/vector.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { FILL = 16 }; /* places of a work-item's lanes */

#define LEAST_W_M2_K 0.02
#define LEAST_REACH 0.005 /* of an edge's length: what two flat facets are apart at least */

/* What the search works with. */
typedef struct search {
    const geometry *g;
    const facet_record *facet;
    const material_record *material;
    float (*link_w_k)[4]; /* shape (facets); 0: not coupled */
    uint32_t *root;       /* shape (facets): of the tree of coupled facets, RECORD_NONE: in none */
    uint32_t *place;      /* shape (facets) */
} search;

static void subtract(const float a[3], const float b[3], double out[3])
{
    for (int i = 0; i < 3; i++) out[i] = (double)a[i] - (double)b[i];
}

/* Length of edge k, and how far the facet's centre is from it. */
static double edge_of(const geometry *g, uint32_t facet, int k, double *out_reach_m)
{
    const uint32_t *c = g->corner[facet];
    const int corners = c[3] == UINT32_MAX ? 3 : 4;
    const float *from = g->position[c[k]], *to = g->position[c[(k + 1) % corners]];
    double along[3], away[3], length_m, across, height_m = 0.0;

    subtract(to, from, along);
    length_m = vector_length(along);
    for (int i = 2; i < corners; i++) {
        subtract(g->position[c[(k + i) % corners]], from, away);
        across = vector_dot(away, along) / length_m;
        height_m += sqrt(fmax(0.0, vector_dot(away, away) - across * across));
    }
    /* The circumcentre lies (w / 2) cot(angle before the edge) away: negative beyond a blunt one. */
    *out_reach_m = corners == 3 ? across * (across - length_m) / (2.0 * height_m) + 0.5 * height_m
                                : height_m / corners;
    return length_m;
}

static bool is_stated(const search *s, uint32_t facet)
{
    return s->facet[facet].stated_temperature_k > 0.0f;
}

static double sheet_w_k(const search *s, uint32_t facet)
{
    return (double)s->material[s->facet[facet].material].conductivity_w_m_k *
           (double)s->facet[facet].thickness_m;
}

/* Conductance over edge k; 0 where there is none worth it. */
static double link_of(const search *s, uint32_t facet, int k)
{
    const geometry *g = s->g;
    const int32_t beyond = g->neighbour[facet][k];
    double here_m, there_m;
    int back = 0;

    if (beyond < 0 || s->facet[beyond].material != s->facet[facet].material) return 0.0;
    if (is_stated(s, facet) && is_stated(s, (uint32_t)beyond)) return 0.0;
    while (back < 3 && g->neighbour[beyond][back] != (int32_t)facet) back++;
    const double here_w_k = sheet_w_k(s, facet), there_w_k = sheet_w_k(s, (uint32_t)beyond);
    const double area_m2 = fmin((double)g->area_m2[facet], (double)g->area_m2[beyond]);
    if (!(here_w_k > 0.0 && there_w_k > 0.0 && area_m2 > 0.0)) return 0.0;
    const double edge_m = edge_of(g, facet, k, &here_m);
    edge_of(g, (uint32_t)beyond, back, &there_m);
    const double least = LEAST_REACH * edge_m / fmax(here_w_k, there_w_k);
    const double link_w_k = edge_m / fmax(least, here_m / here_w_k + there_m / there_w_k);
    return link_w_k >= LEAST_W_M2_K * area_m2 ? link_w_k : 0.0;
}

static uint32_t root_of(const search *s, uint32_t facet)
{
    while (s->root[facet] != facet) {
        s->root[facet] = s->root[s->root[facet]];
        facet = s->root[facet];
    }
    return facet;
}

/* Joins coupled facets to trees whose root is their lowest facet. */
static void join(search *s)
{
    for (uint32_t i = 0; i < s->g->facet_count; i++) s->root[i] = i;
    for (uint32_t i = 0; i < s->g->facet_count; i++) {
        bool coupled = false;
        for (int k = 0; k < 4; k++) {
            s->link_w_k[i][k] = (float)link_of(s, i, k);
            if (!(s->link_w_k[i][k] > 0.0f)) continue;
            coupled = true;
            const uint32_t beyond = (uint32_t)s->g->neighbour[i][k];
            if (is_stated(s, i) || is_stated(s, beyond)) continue;
            const uint32_t a = root_of(s, i), b = root_of(s, beyond);
            s->root[a > b ? a : b] = a > b ? b : a;
        }
        if (!coupled || is_stated(s, i)) s->place[i] = RECORD_NONE;
    }
    for (uint32_t i = 0; i < s->g->facet_count; i++)
        s->root[i] = s->place[i] == RECORD_NONE ? RECORD_NONE : root_of(s, i);
}

/* Counts the facets of each tree in `place` of its root, then lays the patches out. */
static void lay_out(search *s, conduction_map *map, uint32_t *size)
{
    const uint32_t n = s->g->facet_count;

    for (uint32_t i = 0; i < n; i++)
        if (s->root[i] != RECORD_NONE) size[s->root[i]]++;
    for (uint32_t i = 0; i < n; i++) {
        if (s->root[i] != i) continue;
        map->patch_first[map->patch_count++] = (uint32_t)map->count;
        s->place[i] = (uint32_t)map->count;
        map->count += (size[i] + FILL - 1) / FILL * FILL;
    }
    map->patch_first[map->patch_count] = (uint32_t)map->count;
    for (uint32_t i = 0; i < n; i++) {
        const uint32_t root = s->root[i];
        if (root != RECORD_NONE && root != i) s->place[i] = s->place[root] + --size[root];
    }
}

static void set_link(const search *s, uint32_t facet, conduction_record *out)
{
    double stated_w = 0.0;

    *out = (conduction_record){.area_m2 = s->g->area_m2[facet]};
    for (int k = 0; k < 4; k++) {
        const float link_w_k = s->link_w_k[facet][k];
        const int32_t beyond = s->g->neighbour[facet][k];
        out->neighbour[k] = RECORD_NONE;
        if (!(link_w_k > 0.0f)) continue;
        if (is_stated(s, (uint32_t)beyond)) {
            out->stated_w_k += link_w_k;
            stated_w += (double)link_w_k * (double)s->facet[beyond].stated_temperature_k;
            continue;
        }
        out->neighbour[k] = s->place[beyond];
        out->link_w_k[k] = link_w_k;
    }
    if (out->stated_w_k > 0.0f) out->stated_k = (float)(stated_w / (double)out->stated_w_k);
}

static void fill(const search *s, conduction_map *map)
{
    for (size_t i = 0; i < map->count; i++) map->facet[i] = RECORD_NONE;
    for (uint32_t i = 0; i < s->g->facet_count; i++) {
        if (s->root[i] == RECORD_NONE) continue;
        map->facet[s->place[i]] = i;
        set_link(s, i, &map->link[s->place[i]]);
    }
    for (size_t i = 0; i < map->count; i++) {
        if (map->facet[i] != RECORD_NONE) continue;
        map->facet[i] = map->facet[i - 1];
        map->link[i] = (conduction_record){.area_m2 = map->link[i - 1].area_m2};
        for (int k = 0; k < 4; k++) map->link[i].neighbour[k] = RECORD_NONE;
    }
}

status conduction_find(conduction_map **out, const geometry *g, const facet_record *facet,
                       const material_record *material)
{
    status rc = STATUS_OK;
    const size_t n = (size_t)g->facet_count + 1;
    search s = {.g = g, .facet = facet, .material = material};
    uint32_t *size = calloc(n, sizeof *size);
    conduction_map *map = calloc(1, sizeof *map);

    s.link_w_k = calloc(n, sizeof *s.link_w_k);
    s.root = malloc(n * sizeof *s.root);
    s.place = calloc(n, sizeof *s.place);
    NEED(size && map && s.link_w_k && s.root && s.place, STATUS_MEMORY,
         "no memory for the neighbours of %u facets", g->facet_count);
    map->patch_first = malloc((n + 1) * sizeof *map->patch_first);
    NEED(map->patch_first, STATUS_MEMORY, "no memory for patches");
    join(&s);
    lay_out(&s, map, size);
    map->facet = malloc((map->count + 1) * sizeof *map->facet);
    map->link = malloc((map->count + 1) * sizeof *map->link);
    NEED(map->facet && map->link, STATUS_MEMORY, "no memory for %zu facets of patches", map->count);
    fill(&s, map);
    *out = map;
    map = NULL;
out:
    conduction_free(map);
    free(s.place);
    free(s.root);
    free(s.link_w_k);
    free(size);
    return rc;
}

void conduction_free(conduction_map *map)
{
    if (!map) return;
    free(map->link);
    free(map->facet);
    free(map->patch_first);
    free(map);
}
