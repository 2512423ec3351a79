#include "temperature.h"

#include "sun_history.h"
#include "thermal.h"

#include <stdlib.h>
#include <string.h>

struct temperature {
    device *dev;
    const facet_record *facet;
    size_t facet_count;
    device_memory facets, facet_temperature_k;
    thermal *model; /* NULL: temperatures are stated */
    sun_history *sun;
};

/* Without weather the sun's history has the steps of 15 minutes that the thesis allows. */
static status open_sun_history(temperature *t, const scene *s)
{
    const weather *w = s->history;
    const double day_before_s = 86400.0, quarter_hour_s = 900.0;

    if (!w)
        return sun_history_open(&t->sun, t->dev, &s->place,
                                site_midnight_s(&s->place) - day_before_s, quarter_hour_s);
    return sun_history_open(&t->sun, t->dev, &s->place,
                            weather_origin_s(w, &s->place) + 3600.0 * w->record[0].time_h,
                            w->interval_s);
}

static status open_model(temperature *t, const scene *s)
{
    status rc = STATUS_OK;
    material_record *material = malloc((s->material_count + 1) * sizeof *material);
    layered_matter *layered = malloc((s->material_count + 1) * sizeof *layered);
    const thermal_matter matter = {material, s->thermal == SCENE_THERMAL_LAYERED ? layered : NULL,
                                   s->material_count};

    NEED(material && layered, STATUS_MEMORY, "no memory for %u materials", s->material_count);
    for (uint32_t i = 0; i < s->material_count; i++) {
        material[i] = s->materials[i].record;
        layered[i] = s->materials[i].layered;
    }
    TRY(thermal_open(&t->model, t->dev, &matter, s->history, &s->place));
out:
    free(layered);
    free(material);
    return rc;
}

static status warm_facets(temperature *t, const scene *s)
{
    status rc = STATUS_OK;
    const thermal_subject all = {.facet = t->facet, .count = t->facet_count};
    float *facet_k = malloc((t->facet_count + 1) * sizeof *facet_k);

    NEED(facet_k, STATUS_MEMORY, "no memory for %zu facets", t->facet_count);
    if (s->thermal != SCENE_THERMAL_FIXED && s->history) {
        TRY(open_model(t, s));
        TRY(thermal_at_time(t->model, &all, facet_k));
    } else {
        for (size_t i = 0; i < t->facet_count; i++) facet_k[i] = t->facet[i].stated_temperature_k;
    }
    TRY(device_allocate(t->dev, &t->facet_temperature_k, t->facet_count * sizeof *facet_k,
                        facet_k));
out:
    free(facet_k);
    return rc;
}

status temperature_open(temperature **out, device *dev, const scene *s, device_memory facets,
                        const facet_record *facet, size_t facet_count)
{
    status rc = STATUS_OK;
    temperature *t = calloc(1, sizeof *t);

    NEED(t, STATUS_MEMORY, "no memory for temperatures");
    *t = (temperature){.dev = dev, .facet = facet, .facet_count = facet_count, .facets = facets};
    TRY(open_sun_history(t, s));
    TRY(warm_facets(t, s));
    *out = t;
    t = NULL;
out:
    temperature_free(t);
    return rc;
}

void temperature_free(temperature *t)
{
    if (!t) return;
    device_release(t->facet_temperature_k);
    thermal_free(t->model);
    sun_history_free(t->sun);
    free(t);
}

device_memory temperature_of_facets(const temperature *t)
{
    return t->facet_temperature_k;
}

uint32_t temperature_history_words(const temperature *t)
{
    return sun_history_words(t->sun);
}

/* What the temperatures of a tile follow from, without the pixels that meet nothing. */
typedef struct gathering {
    size_t count;
    uint32_t *pixel;
    facet_record *facet;
    uint32_t *lit;
    float *temperature_k, *pixel_k;
} gathering;

static void gathering_free(gathering *g)
{
    free(g->pixel_k);
    free(g->temperature_k);
    free(g->lit);
    free(g->facet);
    free(g->pixel);
}

static status gathering_make(gathering *g, const temperature *t, const hit_record *hit,
                             const uint32_t *lit, size_t count)
{
    status rc = STATUS_OK;
    const uint32_t words = sun_history_words(t->sun);

    g->pixel = malloc(count * sizeof *g->pixel);
    g->facet = malloc(count * sizeof *g->facet);
    g->lit = malloc(count * words * sizeof *g->lit);
    g->temperature_k = malloc(count * sizeof *g->temperature_k);
    g->pixel_k = calloc(count, sizeof *g->pixel_k);
    NEED(g->pixel && g->facet && g->lit && g->temperature_k && g->pixel_k, STATUS_MEMORY,
         "no memory for %zu pixels", count);
    for (size_t i = 0; i < count; i++) {
        if (hit[i].facet == RECORD_NONE) continue;
        memcpy(g->lit + g->count * words, lit + i * words, words * sizeof *lit);
        g->facet[g->count] = t->facet[hit[i].facet];
        g->pixel[g->count++] = (uint32_t)i;
    }
out:
    return rc;
}

/* Figure 3-8. */
static status warm_pixels(const temperature *t, size_t count, device_memory hit,
                          device_memory history, device_memory out_k)
{
    status rc = STATUS_OK;
    const uint32_t words = sun_history_words(t->sun);
    const size_t bytes = count * words * sizeof(uint32_t);
    hit_record *met = malloc(count * sizeof *met);
    uint32_t *lit = malloc(bytes);
    gathering g = {0};

    NEED(met && lit, STATUS_MEMORY, "no memory for %zu pixels", count);
    TRY(device_download(t->dev, hit, 0, count * sizeof *met, met));
    TRY(device_download(t->dev, history, 0, bytes, lit));
    TRY(gathering_make(&g, t, met, lit, count));
    const thermal_subject subject = {.facet = g.facet,
                                     .count = g.count,
                                     .lit = g.lit,
                                     .word_count = words,
                                     .slot_count = sun_history_slots(t->sun)};
    if (t->model) TRY(thermal_at_time(t->model, &subject, g.temperature_k));
    for (size_t i = 0; i < g.count; i++)
        g.pixel_k[g.pixel[i]] = t->model ? g.temperature_k[i] : g.facet[i].stated_temperature_k;
    TRY(device_upload(t->dev, out_k, 0, count * sizeof *g.pixel_k, g.pixel_k));
out:
    gathering_free(&g);
    free(lit);
    free(met);
    return rc;
}

status temperature_of_pixels(const temperature *t, const ray_scene *rays, uint32_t count,
                             device_memory hit, uint32_t first_plane, device_memory out_history,
                             device_memory out_k, device_memory out_planes)
{
    status rc = STATUS_OK;

    TRY(sun_history_trace(t->sun, rays, t->facets, count, hit, out_history));
    TRY(warm_pixels(t, count, hit, out_history, out_k));
    TRY(sun_history_times(t->sun, count, first_plane, hit, out_history, out_planes));
out:
    return rc;
}

status temperature_of_hits(const temperature *t, uint32_t count, device_memory hit,
                           uint32_t first_plane, device_memory out_k, device_memory out_planes)
{
    return device_run(t->dev, "facet_temperature", shape1(count), ARG(count), ARG(first_plane),
                      ARG(hit), ARG(t->facet_temperature_k), ARG(out_k), ARG(out_planes));
}
