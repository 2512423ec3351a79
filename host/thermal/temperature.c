#include "thermal/temperature.h"

#include "mesh/facet_sample.h"
#include "sunlight/sun_history.h"
#include "thermal/exchange.h"
#include "thermal/facet_check.h"
#include "thermal/thermal.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Points of facets that are traced at once, but for those of the last: they bound the memory on the
 * device. */
enum { POINTS_AT_ONCE = 1 << 16 };

struct temperature_solver {
    device *dev;
    facet_record *facet; /* shape (facet_count) */
    size_t facet_count;
    facet_record_buffer facets;
    float_buffer facet_temperature_k;
    thermal *model; /* NULL: temperatures are stated */
    sun_history *sun;
};

/* Without weather the sun's history has the steps of 15 minutes that the thesis allows. */
static status open_sun_history(temperature_solver *t, const scene *s, const media *dimming,
                               sun_memory *memory)
{
    const weather *w = s->history;
    const double day_before_s = 86400.0, quarter_hour_s = 900.0;

    if (!w)
        return sun_history_open(&t->sun, t->dev, &s->place,
                                site_midnight_s(&s->place) - day_before_s, quarter_hour_s, dimming,
                                memory);
    return sun_history_open(&t->sun, t->dev, &s->place,
                            weather_origin_s(w, &s->place) + 3600.0 * w->record[0].time_h,
                            w->interval_s, dimming, memory);
}

static status open_model(temperature_solver *t, const scene *s)
{
    status rc = STATUS_OK;
    material_record *material = malloc((s->material_count + 1) * sizeof *material);
    layered_matter *layered = malloc((s->material_count + 1) * sizeof *layered);
    heat_schedule *power = malloc((s->material_count + 1) * sizeof *power);
    const bool is_layered = s->thermal == SCENE_THERMAL_LAYERED;
    const thermal_matter matter = {material, is_layered ? layered : NULL, power, s->material_count,
                                   s->laws};

    NEED(material && layered && power, STATUS_MEMORY, "no memory for %u materials",
         s->material_count);
    for (uint32_t i = 0; i < s->material_count; i++) {
        material[i] = s->materials[i].record;
        layered[i] = s->materials[i].layered;
        power[i] = s->materials[i].power;
    }
    TRY(thermal_open(&t->model, t->dev, &matter, s->history, &s->place));
out:
    free(power);
    free(layered);
    free(material);
    return rc;
}

/* What the temperatures of points follow from, without those that meet nothing. */
typedef struct gathering {
    size_t count;
    uint32_t *point;
    facet_record *facet;
    uint32_t *lit;
    float *temperature_k;
} gathering;

static void gathering_free(gathering *g)
{
    free(g->temperature_k);
    free(g->lit);
    free(g->facet);
    free(g->point);
}

static status gathering_make(gathering *g, const temperature_solver *t, const hit_record *hit,
                             const uint32_t *lit, size_t count)
{
    status rc = STATUS_OK;
    const uint32_t words = sun_history_words(t->sun);

    g->point = malloc(count * sizeof *g->point);
    g->facet = malloc(count * sizeof *g->facet);
    g->lit = malloc(count * words * sizeof *g->lit);
    g->temperature_k = malloc(count * sizeof *g->temperature_k);
    NEED(g->point && g->facet && g->lit && g->temperature_k, STATUS_MEMORY,
         "no memory for %zu points", count);
    for (size_t i = 0; i < count; i++) {
        if (hit[i].facet == RECORD_NONE) continue;
        memcpy(g->lit + g->count * words, lit + i * words, words * sizeof *lit);
        g->facet[g->count] = t->facet[hit[i].facet];
        g->point[g->count++] = (uint32_t)i;
    }
out:
    return rc;
}

/* Temperatures of points with their histories; 0 where there is no facet. Figure 3-8.
 *   met   what stands in `hit` */
static status warm_points(const temperature_solver *t, size_t count, const hit_record *met,
                          uint_buffer history, float *out_k)
{
    status rc = STATUS_OK;
    const uint32_t words = sun_history_words(t->sun);
    uint32_t *lit = malloc(count * words * sizeof *lit);
    gathering g = {0};

    NEED(lit, STATUS_MEMORY, "no memory for %zu points", count);
    TRY(device_download(t->dev, history, count * words, lit));
    TRY(gathering_make(&g, t, met, lit, count));
    const thermal_subject subject = {.facet = g.facet,
                                     .count = g.count,
                                     .lit = g.lit,
                                     .word_count = words,
                                     .slot_count = sun_history_slots(t->sun)};
    if (t->model) TRY(thermal_at_time(t->model, &subject, g.temperature_k));
    memset(out_k, 0, count * sizeof *out_k);
    for (size_t i = 0; i < g.count; i++)
        out_k[g.point[i]] = t->model ? g.temperature_k[i] : g.facet[i].stated_temperature_k;
out:
    gathering_free(&g);
    free(lit);
    return rc;
}

/* Facets in a row, and how their points are spread. */
typedef struct facet_run {
    const geometry *shape;
    const uint8_t *level; /* per facet of the shape */
    uint32_t first, count, points;
} facet_run;

/* Takes facets from `first` on, as many as are traced at once. */
static facet_run take_run(const geometry *g, const uint8_t *level, uint32_t first)
{
    facet_run run = {.shape = g, .level = level, .first = first};

    while (first + run.count < g->facet_count && run.points < POINTS_AT_ONCE)
        run.points += facet_sample_count(level[first + run.count++]);
    return run;
}

/* Means over the points of each facet.
 *   point_k   shape (run->points); out_k: per facet of the shape */
static void average(const facet_run *run, const float *point_k, float *out_k)
{
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        const uint32_t points = facet_sample_count(run->level[i]);
        float sum = 0.0f;
        for (uint32_t k = 0; k < points; k++) sum += *point_k++;
        out_k[i] = sum / (float)points;
    }
}

/* Temperatures of the facets of a run, in the sun and shadow of their points. */
static status warm_run(const temperature_solver *t, const ray_scene *rays, const facet_run *run,
                       float *out_k)
{
    status rc = STATUS_OK;
    hit_record_buffer hit = {0};
    uint_buffer history = {0};
    hit_record *at = malloc(run->points * sizeof *at), *next = at;
    float *point_k = malloc(run->points * sizeof *point_k);

    NEED(at && point_k, STATUS_MEMORY, "no memory for %u points", run->points);
    for (uint32_t i = run->first; i < run->first + run->count; i++) {
        facet_sample(next, run->shape, i, run->level[i]);
        next += facet_sample_count(run->level[i]);
    }
    TRY(device_allocate(t->dev, &hit, run->points, at));
    TRY(device_allocate(t->dev, &history, (size_t)run->points * sun_history_words(t->sun), NULL));
    TRY(sun_history_trace(t->sun, rays,
                          &(sun_points){.count = run->points, .facets = t->facets, .hit = hit},
                          history));
    TRY(warm_points(t, run->points, at, history, point_k));
    average(run, point_k, out_k);
out:
    device_release(history);
    device_release(hit);
    free(point_k);
    free(at);
    return rc;
}

/* The facets' temperatures with the sun and shadow on their area; the ground's is always lit. */
static status warm_area(const temperature_solver *t, const geometry *g, const ray_scene *rays,
                        float *facet_k)
{
    status rc = STATUS_OK;
    uint8_t *level = malloc((size_t)g->facet_count + 1);

    NEED(level, STATUS_MEMORY, "no memory for %u facets", g->facet_count);
    facet_sample_levels(level, g->area_m2, g->facet_count);
    for (uint32_t first = 0; first < g->facet_count;) {
        const facet_run run = take_run(g, level, first);
        TRY(warm_run(t, rays, &run, facet_k));
        first += run.count;
    }
out:
    free(level);
    return rc;
}

/* Facets that exchange heat: in thesis mode in the sun whenever it shines, in exact mode in the mean
 * share of it over their points. */
static status warm_together(const temperature_solver *t, const scene *s, const ray_scene *rays,
                            float *facet_k)
{
    status rc = STATUS_OK;
    const facet_light_world world = {t->dev, s->shape, rays, t->sun, t->facets};
    facet_light sun = {0};

    if (!s->thesis) TRY(facet_light_trace(&sun, &world, t->facet_count));
    TRY(exchange_run(s, t->model, rays, &sun, t->facet, t->facet_count));
    const thermal_subject all = {.facet = t->facet,
                                 .count = t->facet_count,
                                 .lit = sun.word,
                                 .word_count = sun.words,
                                 .slot_count = sun.slots};
    TRY(thermal_at_time(t->model, &all, facet_k));
out:
    facet_light_free(&sun);
    return rc;
}

/* Facets that know nothing of each other: in exact mode the mean temperature of their points, but for
 * the ground's. */
static status warm_alone(const temperature_solver *t, const scene *s, const ray_scene *rays,
                         float *facet_k)
{
    status rc = STATUS_OK;
    const size_t shaded = s->thesis ? 0 : s->shape->facet_count;
    const thermal_subject lit = {.facet = t->facet + shaded, .count = t->facet_count - shaded};

    TRY(thermal_at_time(t->model, &lit, facet_k + shaded));
    if (!s->thesis) TRY(warm_area(t, s->shape, rays, facet_k));
out:
    return rc;
}

static status warm_facets(temperature_solver *t, const scene *s, const ray_scene *rays)
{
    status rc = STATUS_OK;
    const bool exchanges =
        s->thermal == SCENE_THERMAL_LAYERED && (s->lateral_conduction || s->facet_longwave);
    float *facet_k = malloc((t->facet_count + 1) * sizeof *facet_k);

    NEED(facet_k, STATUS_MEMORY, "no memory for %zu facets", t->facet_count);
    if (s->thermal != SCENE_THERMAL_FIXED && s->history) {
        TRY(open_model(t, s));
        TRY(exchanges ? warm_together(t, s, rays, facet_k) : warm_alone(t, s, rays, facet_k));
    } else {
        for (size_t i = 0; i < t->facet_count; i++) facet_k[i] = t->facet[i].stated_temperature_k;
    }
    TRY(facet_check(s, t->facet, t->facet_count, facet_k));
    TRY(device_allocate(t->dev, &t->facet_temperature_k, t->facet_count, facet_k));
out:
    free(facet_k);
    return rc;
}

status temperature_open(temperature_solver **out, device *dev, const temperature_scene *from)
{
    status rc = STATUS_OK;
    const size_t count = from->facet_count;
    temperature_solver *t = calloc(1, sizeof *t);

    NEED(t, STATUS_MEMORY, "no memory for temperatures");
    *t = (temperature_solver){.dev = dev, .facet_count = count, .facets = from->facets};
    t->facet = malloc((count + 1) * sizeof *t->facet);
    NEED(t->facet, STATUS_MEMORY, "no memory for %zu facets", count);
    memcpy(t->facet, from->facet, count * sizeof *t->facet);
    TRY(open_sun_history(t, from->s, from->dimming, from->memory));
    TRY(warm_facets(t, from->s, from->rays));
    *out = t;
    t = NULL;
out:
    temperature_free(t);
    return rc;
}

void temperature_free(temperature_solver *t)
{
    if (!t) return;
    device_release(t->facet_temperature_k);
    thermal_free(t->model);
    sun_history_free(t->sun);
    free(t->facet);
    free(t);
}

float_buffer temperature_of_facets(const temperature_solver *t)
{
    return t->facet_temperature_k;
}

uint32_t temperature_history_words(const temperature_solver *t)
{
    return sun_history_words(t->sun);
}

static status warm_pixels(const temperature_solver *t, const temperature_pixels *p)
{
    status rc = STATUS_OK;
    const size_t count = p->count;
    hit_record *met = malloc(count * sizeof *met);
    float *pixel_k = malloc(count * sizeof *pixel_k);

    NEED(met && pixel_k, STATUS_MEMORY, "no memory for %zu pixels", count);
    TRY(device_download(t->dev, p->hit, count, met));
    TRY(warm_points(t, count, met, p->history, pixel_k));
    TRY(device_upload(t->dev, p->temperature_k, count, pixel_k));
out:
    free(pixel_k);
    free(met);
    return rc;
}

status temperature_of_pixels(const temperature_solver *t, const ray_scene *rays,
                             const temperature_pixels *p)
{
    status rc = STATUS_OK;
    const sun_points points = {
        .count = p->count, .facets = t->facets, .hit = p->hit, .order = p->order};

    TRY(sun_history_trace(t->sun, rays, &points, p->history));
    TRY(warm_pixels(t, p));
    TRY(sun_history_times(t->sun, p->count, p->first_plane, p->hit, p->history, p->planes));
out:
    return rc;
}

status temperature_of_hits(const temperature_solver *t, const temperature_pixels *p)
{
    return facet_temperature_run(t->dev, shape1(p->count),
                                 &(facet_temperature_args){.count = p->count,
                                                           .first_plane = p->first_plane,
                                                           .hit = p->hit,
                                                           .temperature_k = t->facet_temperature_k,
                                                           .out_k = p->temperature_k,
                                                           .planes = p->planes});
}

/* Unrolls the bits of the day's slots into steps. */
static void unroll(const uint32_t *bits, long last, pixel_day *day)
{
    const long slots = (long)day->step_count;

    for (long i = 0, k = last - slots + 1; i < slots; i++, k++) {
        const long slot = (k % slots + slots) % slots;
        day->lit[i] = bits[slot / 32] >> (slot % 32) & 1u;
    }
}

status pixel_day_of(const temperature_solver *t, const ray_scene *rays, hit_record_buffer hit,
                    pixel_day *out)
{
    status rc = STATUS_OK;
    const uint32_t words = sun_history_words(t->sun), slots = sun_history_slots(t->sun);
    pixel_day day = {.step_count = slots, .step_s = 86400.0 / slots};
    const long last = sun_history_last(t->sun, &day.last_s);
    uint_buffer history = {0};
    uint32_t *bits = malloc(words * sizeof *bits);
    hit_record met;

    day.lit = calloc(slots, sizeof *day.lit);
    day.temperature_k = t->model ? malloc(slots * sizeof *day.temperature_k) : NULL;
    NEED(bits && day.lit && (!t->model || day.temperature_k), STATUS_MEMORY, "no memory for a day");
    TRY(device_allocate(t->dev, &history, words, NULL));
    TRY(sun_history_trace(t->sun, rays, &(sun_points){.count = 1, .facets = t->facets, .hit = hit},
                          history));
    TRY(device_download(t->dev, history, words, bits));
    TRY(device_download(t->dev, hit, 1, &met));
    unroll(bits, last, &day);
    if (t->model) {
        const thermal_subject subject = {.facet = &t->facet[met.facet],
                                         .count = 1,
                                         .lit = bits,
                                         .word_count = words,
                                         .slot_count = slots};
        TRY(thermal_day(t->model, &subject, last, day.temperature_k));
    }
    *out = day;
    day = (pixel_day){0};
out:
    pixel_day_free(&day);
    device_release(history);
    free(bits);
    return rc;
}

void pixel_day_free(pixel_day *day)
{
    free(day->temperature_k);
    free(day->lit);
    *day = (pixel_day){0};
}
