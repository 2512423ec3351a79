#include "sunlight/facet_light.h"

#include "mesh/facet_sample.h"

#include <stdlib.h>

enum { FACETS_AT_ONCE = 1 << 14 };

static uint32_t share_of(const uint32_t *words, const facet_light *light, uint32_t traced_words,
                         uint32_t slot)
{
    if (traced_words > light->bit_words)
        return words[light->bit_words + slot / 4] >> (slot % 4 * 8) & 255u;
    return (words[slot / 32] >> (slot % 32) & 1u) * 255u;
}

static void set_fraction(facet_light *light, size_t facet, uint32_t slot, uint32_t fraction)
{
    light->word[facet * light->words + light->bit_words + slot / 4] |= fraction << (slot % 4 * 8);
}

/* Sets the mean of a facet's points. */
static void set_mean(facet_light *light, const uint32_t *traced, uint32_t traced_words,
                     size_t facet)
{
    for (uint32_t slot = 0; slot < light->slots; slot++) {
        uint32_t sum = 0;
        for (uint32_t k = 0; k < FACET_SAMPLES; k++)
            sum += share_of(traced + k * traced_words, light, traced_words, slot);
        set_fraction(light, facet, slot, (sum + FACET_SAMPLES / 2) / FACET_SAMPLES);
    }
}

/* Traces the points of facets first .. first + count - 1. */
static status trace_some(facet_light *out, const facet_light_world *w, uint32_t first,
                         uint32_t count)
{
    status rc = STATUS_OK;
    const uint32_t points = count * FACET_SAMPLES, words = sun_history_words(w->sun);
    const size_t all = (size_t)points * words;
    hit_record_buffer hit = {0};
    uint_buffer history = {0};
    hit_record *at = malloc(points * sizeof *at);
    uint32_t *traced = malloc(all * sizeof *traced);

    NEED(at && traced, STATUS_MEMORY, "no memory for %u points", points);
    for (uint32_t i = 0; i < count; i++)
        facet_sample(at + i * FACET_SAMPLES, w->shape, first + i, 1);
    TRY(device_allocate(w->dev, &hit, points, at));
    TRY(device_allocate(w->dev, &history, all, NULL));
    TRY(sun_history_trace(
        w->sun, w->rays, &(sun_points){.count = points, .facets = w->facets, .hit = hit}, history));
    TRY(device_download(w->dev, history, all, traced));
    for (uint32_t i = 0; i < count; i++)
        set_mean(out, traced + (size_t)i * FACET_SAMPLES * words, words, first + i);
out:
    device_release(history);
    device_release(hit);
    free(traced);
    free(at);
    return rc;
}

status facet_light_trace(facet_light *out, const facet_light_world *world, size_t facet_count)
{
    status rc = STATUS_OK;
    const uint32_t real = world->shape->facet_count, slots = sun_history_slots(world->sun);
    facet_light light = {.bit_words = (slots + 31) / 32, .slots = slots, .count = facet_count};

    light.words = light.bit_words + (slots + 3) / 4;
    light.word = calloc(facet_count * light.words + 1, sizeof *light.word);
    NEED(light.word, STATUS_MEMORY, "no memory for the sun on %zu facets", facet_count);
    for (uint32_t first = 0; first < real; first += FACETS_AT_ONCE) {
        const uint32_t left = real - first;
        TRY(trace_some(&light, world, first, left < FACETS_AT_ONCE ? left : FACETS_AT_ONCE));
    }
    for (size_t i = real; i < facet_count; i++)
        for (uint32_t slot = 0; slot < slots; slot++) set_fraction(&light, i, slot, 255);
    *out = light;
    light.word = NULL;
out:
    facet_light_free(&light);
    return rc;
}

void facet_light_free(facet_light *light)
{
    free(light->word);
    *light = (facet_light){0};
}
