#include "exchange.h"

#include "../kernels/conduction.h"
#include "conduction.h"
#include "facet_sample.h"
#include "thermal_model.h"

#include <stdlib.h>
#include <string.h>

enum { FACETS_AT_ONCE = 1 << 14, WORK_ROWS = 9 };

/* Shares of the sun, a byte for every slot, as lit.h reads them: behind the words of the bits. */
typedef struct shares {
    uint32_t bit_words, words, slots;
    uint32_t *row; /* shape (words, count) */
    size_t count;
} shares;

static uint32_t share_of(const uint32_t *words, const shares *s, uint32_t traced_words,
                         uint32_t slot)
{
    if (traced_words > s->bit_words) return words[s->bit_words + slot / 4] >> (slot % 4 * 8) & 255u;
    return (words[slot / 32] >> (slot % 32) & 1u) * 255u;
}

/* Puts the mean of a facet's points into its place. */
static void set_mean(shares *s, const uint32_t *traced, uint32_t traced_words, size_t place)
{
    for (uint32_t slot = 0; slot < s->slots; slot++) {
        uint32_t sum = 0;
        for (uint32_t k = 0; k < FACET_SAMPLES; k++)
            sum += share_of(traced + k * traced_words, s, traced_words, slot);
        s->row[(s->bit_words + slot / 4) * s->count + place] |=
            (sum + FACET_SAMPLES / 2) / FACET_SAMPLES << (slot % 4 * 8);
    }
}

/* Traces the points of the facets at places first .. first + count - 1. */
static status trace_some(device *dev, const geometry *g, const exchange_light *light,
                         const uint32_t *facet, size_t first, uint32_t count, shares *out)
{
    status rc = STATUS_OK;
    const uint32_t points = count * FACET_SAMPLES, words = sun_history_words(light->sun);
    const size_t bytes = (size_t)points * words * sizeof(uint32_t);
    device_memory hit = NULL, history = NULL;
    hit_record *at = malloc(points * sizeof *at);
    uint32_t *traced = malloc(bytes);

    NEED(at && traced, STATUS_MEMORY, "no memory for %u points", points);
    for (uint32_t i = 0; i < count; i++) facet_sample(at + i * FACET_SAMPLES, g, facet[first + i]);
    TRY(device_allocate(dev, &hit, points * sizeof *at, at));
    TRY(device_allocate(dev, &history, bytes, NULL));
    TRY(sun_history_trace(light->sun, light->rays, light->facets, points, hit, history));
    TRY(device_download(dev, history, 0, bytes, traced));
    for (uint32_t i = 0; i < count; i++)
        set_mean(out, traced + (size_t)i * FACET_SAMPLES * words, words, first + i);
out:
    device_release(history);
    device_release(hit);
    free(traced);
    free(at);
    return rc;
}

/* Means over the points of facets. */
static status trace_shares(device *dev, const geometry *g, const exchange_light *light,
                           const uint32_t *facet, shares *out)
{
    status rc = STATUS_OK;

    out->slots = sun_history_slots(light->sun);
    out->bit_words = (out->slots + 31) / 32;
    out->words = out->bit_words + (out->slots + 3) / 4;
    out->row = calloc(out->count * out->words + 1, sizeof *out->row);
    NEED(out->row, STATUS_MEMORY, "no memory for the sun on %zu facets", out->count);
    for (size_t first = 0; first < out->count; first += FACETS_AT_ONCE) {
        const size_t left = out->count - first;
        TRY(trace_some(dev, g, light, facet, first,
                       (uint32_t)(left < FACETS_AT_ONCE ? left : FACETS_AT_ONCE), out));
    }
out:
    return rc;
}

/* Launches the kernel over the patches; the heat along facets stays with the model. */
static status conduct(thermal *t, const conduction_map *map, const layered_record *facet,
                      const shares *sun)
{
    status rc = STATUS_OK;
    const size_t n = map->count, row = n * sizeof(float);
    const thermal_span span = {.facet_count = (uint)n,
                               .sunlit_words = sun->words,
                               .sunlit_period = sun->slots,
                               .step_s = (float)t->step_s,
                               .step_count = (uint)t->step_count};
    const device_shape shape = {{map->patch_count, 1}, 1};
    device_memory first = NULL, facets = NULL, links = NULL, lit = NULL, groups = NULL, rows = NULL;

    TRY(device_allocate(t->dev, &first, (map->patch_count + 1) * sizeof *map->patch_first,
                        map->patch_first));
    TRY(device_allocate(t->dev, &facets, n * sizeof *facet, facet));
    TRY(device_allocate(t->dev, &links, n * sizeof *map->link, map->link));
    if (sun->words > 0) TRY(device_allocate(t->dev, &lit, row * sun->words, sun->row));
    TRY(device_allocate(t->dev, &groups, n * sizeof(conduction_group), NULL));
    TRY(device_allocate(t->dev, &rows, row * WORK_ROWS, NULL));
    TRY(device_allocate(t->dev, &t->lateral_w_m2, row * 2 * t->step_count, NULL));
    TRY(device_run(t->dev, "conduction", shape, ARG(span), ARG(map->patch_count), ARG(first),
                   ARG(facets), ARG(links), ARG(t->forcing), ARG(lit), ARG(t->power_materials),
                   ARG(t->power), ARG(groups), ARG(rows), ARG(t->lateral_w_m2)));
    t->lateral_columns = (uint32_t)n;
out:
    device_release(rows);
    device_release(groups);
    device_release(lit);
    device_release(links);
    device_release(facets);
    device_release(first);
    return rc;
}

status exchange_run(device *dev, const scene *s, thermal *model, const exchange_light *light,
                    facet_record *facet)
{
    status rc = STATUS_OK;
    conduction_map *map = NULL;
    facet_record *at_place = NULL;
    layered_record *layered = NULL;
    shares sun = {0};

    TRY(conduction_find(&map, s->shape, facet, model->material));
    if (map->count == 0) goto out;
    at_place = malloc(map->count * sizeof *at_place);
    layered = malloc(map->count * sizeof *layered);
    NEED(at_place && layered, STATUS_MEMORY, "no memory for %zu facets of patches", map->count);
    for (size_t i = 0; i < map->count; i++) at_place[i] = facet[map->facet[i]];
    thermal_fill_layered(model, at_place, map->count, layered);
    sun.count = map->count;
    if (light) TRY(trace_shares(dev, s->shape, light, map->facet, &sun));
    TRY(conduct(model, map, layered, &sun));
    /* Backwards: a filler repeats the facet before it, without its neighbours. */
    for (size_t i = map->count; i-- > 0;) facet[map->facet[i]].lateral_column = (uint32_t)i + 1;
out:
    free(sun.row);
    free(layered);
    free(at_place);
    conduction_free(map);
    return rc;
}
