#include "thermal/thermal.h"

#include "base/unique_rows.h"
#include "kernels/thermal/thermal.h"
#include "sky/sun.h"
#include "thermal/thermal_model.h"
#include "thermal/value_check.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

static status upload_forcing(thermal *t, const forcing_laws *laws, const weather *w,
                             const site *place)
{
    status rc = STATUS_OK;
    const double origin_s = weather_origin_s(w, place);
    forcing_record *forcing = malloc(w->count * sizeof *forcing);

    NEED(forcing, STATUS_MEMORY, "no memory for %zu steps of weather", w->count);
    for (size_t i = 0; i < w->count; i++) {
        const double time_s = origin_s + 3600.0 * w->record[i].time_h;
        const sun_position sun = sun_at(time_s, place->latitude_deg, place->longitude_deg);
        forcing[i] = forcing_of(&w->record[i], sun, laws, t->layered != NULL);
        t->mean_air_k += w->record[i].air_temperature_k / (double)w->count;
    }
    TRY(device_allocate(t->dev, &t->forcing, w->count, forcing));
out:
    free(forcing);
    return rc;
}

static status keep_matter(thermal *t, const thermal_matter *m)
{
    status rc = STATUS_OK;
    const size_t bytes = m->count * sizeof *m->material;
    const size_t layered_bytes = m->count * sizeof *m->layered;

    t->material = malloc(bytes + 1);
    NEED(t->material, STATUS_MEMORY, "no memory for %zu materials", m->count);
    memcpy(t->material, m->material, bytes);
    if (m->layered) {
        t->layered = malloc(layered_bytes + 1);
        NEED(t->layered, STATUS_MEMORY, "no memory for %zu materials", m->count);
        memcpy(t->layered, m->layered, layered_bytes);
    }
    TRY(device_allocate(t->dev, &t->materials, m->count, m->material));
out:
    return rc;
}

static status upload_power(thermal *t, const thermal_matter *m, const weather *w)
{
    status rc = STATUS_OK;
    float *power = NULL;
    bool any = false;

    for (size_t k = 0; m->power && k < m->count; k++) any |= m->power[k].count > 0;
    if (!any) return STATUS_OK;
    power = malloc(w->count * m->count * sizeof *power);
    NEED(power, STATUS_MEMORY, "no memory for the power of %zu materials", m->count);
    for (size_t i = 0; i < w->count; i++)
        for (size_t k = 0; k < m->count; k++)
            power[i * m->count + k] =
                (float)heat_schedule_at_hour(&m->power[k], w->record[i].time_h);
    TRY(device_allocate(t->dev, &t->power, w->count * m->count, power));
    t->power_materials = (uint32_t)m->count;
out:
    free(power);
    return rc;
}

status thermal_open(thermal **out, device *dev, const thermal_matter *matter, const weather *w,
                    const site *place)
{
    status rc = STATUS_OK;
    thermal *t = calloc(1, sizeof *t);

    NEED(t, STATUS_MEMORY, "no memory for temperatures");
    *t = (thermal){
        .dev = dev,
        .thesis = matter->laws.thesis,
        .step_count = w->count,
        .step_s = w->interval_s,
        .time_h = (place->time_s - weather_origin_s(w, place)) / 3600.0 - w->record[0].time_h,
    };
    TRY(keep_matter(t, matter));
    TRY(upload_forcing(t, &matter->laws, w, place));
    TRY(upload_power(t, matter, w));
    *out = t;
    t = NULL;
out:
    thermal_free(t);
    return rc;
}

void thermal_free(thermal *t)
{
    if (!t) return;
    device_release(t->exchange.received_w_m2);
    device_release(t->exchange.lateral_w_m2);
    device_release(t->power);
    device_release(t->forcing);
    device_release(t->materials);
    free(t->sky_fraction);
    free(t->layered);
    free(t->material);
    free(t);
}

/* Facets as the kernel takes them. */
typedef struct batch {
    facet_record *facet; /* shape (count) */
    uint32_t *lit;       /* shape (word_count, count) */
    size_t count;
    uint32_t word_count, slot_count;
} batch;

/* The ladders of facets; those that state a temperature need none.
 *   out   shape (count) */
static void fill_layered(const thermal *t, const facet_record *facet, size_t count,
                         layered_record *out)
{
    for (size_t i = 0; i < count; i++) {
        const uint32_t m = facet[i].material, column = facet[i].received_column;
        if (facet[i].stated_temperature_k > 0.0f)
            out[i] = (layered_record){.stated_temperature_k = facet[i].stated_temperature_k,
                                      .emissivity = t->material[m].thermal_emissivity,
                                      .received_column = column};
        else
            layered_fill(&out[i], &facet[i], &t->material[m], &t->layered[m], t->mean_air_k);
        out[i].sky_fraction =
            column > 0 ? t->sky_fraction[column - 1] : 0.5f * (1.0f + facet[i].normal[2]);
    }
}

load_tables thermal_loads(const thermal *t, uint_buffer lit)
{
    return (load_tables){.forcing = t->forcing,
                         .sunlit = lit,
                         .power_materials = t->power_materials,
                         .power = t->power};
}

device_shape thermal_shape(const thermal *t, size_t facet_count)
{
    /* Outside thesis mode the start takes some days of its own. */
    const double step_of_facet_s = t->layered ? 7e-7 : t->thesis ? 5e-8 : 2e-7;
    const uint32_t at_once = device_describe(t->dev)->ray_lanes;
    device_shape shape = device_ray_shape(t->dev, facet_count, 1);

    shape.item_s = at_once * step_of_facet_s * (double)t->step_count;
    return shape;
}

status thermal_upload_layered(const thermal *t, const facet_record *facet, size_t count,
                              layered_record_buffer *out)
{
    status rc = STATUS_OK;
    layered_record *layered = malloc((count + 1) * sizeof *layered);

    NEED(layered, STATUS_MEMORY, "no memory for %zu facets of layers", count);
    fill_layered(t, facet, count, layered);
    TRY(device_allocate(t->dev, out, count, layered));
out:
    free(layered);
    return rc;
}

/* Launches the model's kernel over a batch.
 *   lit   NULL: always lit */
static status run_layered(const thermal *t, const batch *b, thermal_span span, uint_buffer lit,
                          float_buffer out_temperature_k)
{
    status rc = STATUS_OK;
    layered_record_buffer facets = {0};

    TRY(thermal_upload_layered(t, b->facet, b->count, &facets));
    TRY(layered_run(t->dev, thermal_shape(t, b->count),
                    &(layered_args){.span = span,
                                    .facets = facets,
                                    .load = thermal_loads(t, lit),
                                    .exchange = t->exchange,
                                    .temperature_k = out_temperature_k}));
out:
    device_release(facets);
    return rc;
}

static status run_thermal(const thermal *t, const batch *b, thermal_span span, uint_buffer lit,
                          float_buffer out_temperature_k)
{
    status rc = STATUS_OK;
    facet_record_buffer facets = {0};

    TRY(device_allocate(t->dev, &facets, b->count, b->facet));
    TRY(thermal_run(t->dev, thermal_shape(t, b->count),
                    &(thermal_args){.span = span,
                                    .thesis = t->thesis,
                                    .facets = facets,
                                    .materials = t->materials,
                                    .load = thermal_loads(t, lit),
                                    .temperature_k = out_temperature_k}));
out:
    device_release(facets);
    return rc;
}

/* Computes rows of temperatures; the span's steps and weight are set. */
static status compute(const thermal *t, const batch *b, thermal_span span, float *out_temperature_k)
{
    status rc = STATUS_OK;
    uint_buffer lit = {0};
    float_buffer temperature_k = {0};
    const size_t values = span.row_count * b->count;

    span.facet_count = (uint)b->count;
    span.sunlit_words = b->word_count;
    span.sunlit_period = b->slot_count;
    span.step_s = (float)t->step_s;
    span.step_count = (uint)t->step_count;
    if (b->word_count > 0) TRY(device_allocate(t->dev, &lit, b->count * b->word_count, b->lit));
    TRY(device_allocate(t->dev, &temperature_k, values, NULL));
    TRY((t->layered ? run_layered : run_thermal)(t, b, span, lit, temperature_k));
    TRY(device_download(t->dev, temperature_k, values, out_temperature_k));
out:
    device_release(temperature_k);
    device_release(lit);
    return rc;
}

/* Normals are told apart in steps of 2^-13, and computed at these: a step is worth 0.1 W/m2 of the
 * sun, and meshes hold the same normal with different roundings. Slope and azimuth follow from it. */
static facet_record key_of(const facet_record *facet)
{
    facet_record key = *facet;

    for (int i = 0; i < 3; i++) key.normal[i] = roundf(facet->normal[i] * 8192.0f) / 8192.0f + 0.0f;
    key.slope_rad = key.azimuth_rad = 0.0f;
    return key;
}

/* Subjects that differ. */
typedef struct kinds {
    uint32_t *key;           /* shape (subjects, words of a facet and of its history) */
    uint32_t *group, *first; /* as unique_rows tells them */
    uint32_t *place;         /* of a kind in the batch */
    batch each;
} kinds;

static void kinds_free(kinds *k)
{
    free(k->each.lit);
    free(k->each.facet);
    free(k->place);
    free(k->first);
    free(k->group);
    free(k->key);
}

static bool is_slab(const thermal *t, const facet_record *facet)
{
    return !(facet->stated_temperature_k > 0.0f) && t->material[facet->material].exposed_area < 0;
}

/* Lays the kinds out, slabs first: lanes side by side then go the same way. */
static status fill_batch(kinds *k, const thermal *t, const thermal_subject *s)
{
    status rc = STATUS_OK;
    batch *b = &k->each;
    size_t place = 0;

    b->word_count = s->word_count;
    b->slot_count = s->slot_count;
    b->facet = malloc((b->count + 1) * sizeof *b->facet);
    b->lit = malloc((b->count * s->word_count + 1) * sizeof *b->lit);
    k->place = malloc((b->count + 1) * sizeof *k->place);
    NEED(b->facet && b->lit && k->place, STATUS_MEMORY, "no memory for %zu temperatures", b->count);
    for (int slabs = 1; slabs >= 0; slabs--) {
        for (size_t i = 0; i < b->count; i++) {
            const size_t subject = k->first[i];
            if (is_slab(t, &s->facet[subject]) != slabs) continue;
            b->facet[place] = key_of(&s->facet[subject]);
            for (size_t j = 0; j < s->word_count; j++)
                b->lit[j * b->count + place] = s->lit[subject * s->word_count + j];
            k->place[i] = (uint32_t)place++;
        }
    }
out:
    return rc;
}

static status kinds_find(kinds *k, const thermal *t, const thermal_subject *s)
{
    status rc = STATUS_OK;
    const size_t facet_words = sizeof *s->facet / sizeof(uint32_t);
    const size_t words = facet_words + s->word_count;

    k->key = malloc((s->count + 1) * words * sizeof *k->key);
    k->group = malloc((s->count + 1) * sizeof *k->group);
    k->first = malloc((s->count + 1) * sizeof *k->first);
    NEED(k->key && k->group && k->first, STATUS_MEMORY, "no memory for %zu temperatures", s->count);
    for (size_t i = 0; i < s->count; i++) {
        const facet_record key = key_of(&s->facet[i]);
        memcpy(k->key + i * words, &key, sizeof key);
        for (size_t j = 0; j < s->word_count; j++)
            k->key[i * words + facet_words + j] = s->lit[i * s->word_count + j];
    }
    TRY(unique_rows(k->key, words, s->count, k->group, k->first, &k->each.count));
    TRY(fill_batch(k, t, s));
out:
    return rc;
}

status thermal_at_time(const thermal *t, const thermal_subject *subject, float *out_temperature_k)
{
    status rc = STATUS_OK;
    const double position = t->time_h * 3600.0 / t->step_s;
    const thermal_span span = {.first_step = (uint)ceil(position),
                               .row_count = 1,
                               .weight = (float)(1.0 - (ceil(position) - position))};
    kinds k = {0};
    float *at_place_k = NULL;

    NEED(position >= 0.0 && position <= (double)t->step_count - 1.0, STATUS_ARGUMENT,
         "temperatures: %g h after the first weather record is outside the weather's %g h",
         t->time_h, ((double)t->step_count - 1.0) * t->step_s / 3600.0);
    if (subject->count == 0) goto out;
    TRY(kinds_find(&k, t, subject));
    at_place_k = malloc(k.each.count * sizeof *at_place_k);
    NEED(at_place_k, STATUS_MEMORY, "no memory for %zu temperatures", k.each.count);
    TRY(compute(t, &k.each, span, at_place_k));
    for (size_t i = 0; i < subject->count; i++)
        out_temperature_k[i] = at_place_k[k.place[k.group[i]]];
out:
    free(at_place_k);
    kinds_free(&k);
    return rc;
}

status thermal_histories(const thermal *t, const facet_record *facet, size_t count,
                         float *out_temperature_k)
{
    status rc = STATUS_OK;
    const batch b = {.facet = (facet_record *)facet, .count = count};
    const thermal_span span = {.row_count = (uint)t->step_count, .weight = 1.0f};

    TRY(compute(t, &b, span, out_temperature_k));
    for (size_t i = 0; i < t->step_count * count; i++)
        NEED(value_check_kelvin(out_temperature_k[i]), STATUS_ARGUMENT,
             "facet %zu: found a temperature of %g K at step %zu of the weather, expected %s",
             i % count, (double)out_temperature_k[i], i / count, VALUE_CHECK_RANGE);
out:
    return rc;
}

status thermal_day(const thermal *t, const thermal_subject *subject, long last,
                   float *out_temperature_k)
{
    status rc = STATUS_OK;
    facet_record one = key_of(&subject->facet[0]);
    const batch b = {.facet = &one,
                     .lit = (uint32_t *)subject->lit,
                     .count = 1,
                     .word_count = subject->word_count,
                     .slot_count = subject->slot_count};
    const thermal_span span = {.row_count = (uint)t->step_count, .weight = 1.0f};
    float *every_k = malloc(t->step_count * sizeof *every_k);

    NEED(every_k, STATUS_MEMORY, "no memory for a day's temperatures");
    TRY(compute(t, &b, span, every_k));
    for (long i = 0, k = last - (long)subject->slot_count + 1; k <= last; i++, k++)
        out_temperature_k[i] = k >= 0 && k < (long)t->step_count ? every_k[k] : NAN;
out:
    free(every_k);
    return rc;
}
