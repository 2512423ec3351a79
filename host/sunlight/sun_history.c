#include "sunlight/sun_history.h"

#include "kernels/sunlight/sun_history.h"
#include "sky/sun.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct sun_history {
    device *dev;
    sun_day day;
    const media *dimming;
    sun_memory *memory; /* NULL: none */
    float (*suns)[4];   /* shape (32 words, 4) */
    float_buffer sun;   /* the same */
    long last;
    double last_s;
};

/* Slots of the day fill up from the last step backwards. */
static void set_suns(float (*sun)[4], const sun_day *day, const site *place, double origin_s,
                     double step_s, long last)
{
    for (long k = last; k > last - (long)day->slot_count; k--) {
        const double time_s = origin_s + (double)k * step_s;
        const long slots = (long)day->slot_count;
        float *out = sun[(k % slots + slots) % slots];
        double direction[3];
        sun_direction(sun_at(time_s, place->latitude_deg, place->longitude_deg), direction);
        for (int i = 0; i < 3 && direction[2] > 0.0; i++) out[i] = (float)direction[i];
    }
}

static sun_day day_of(const site *place, double origin_s, double step_s)
{
    const double position = (place->time_s - origin_s) / step_s;
    const long slots = lround(86400.0 / step_s), nearest = lround(floor(position + 0.5));

    return (sun_day){
        .slot_count = (uint32_t)slots,
        .word_count = (uint32_t)(slots + 31) / 32,
        .nearest = (uint32_t)((nearest % slots + slots) % slots),
        .since_min = (float)((position - floor(position + 0.5)) * step_s / 60.0),
        .step_min = (float)(step_s / 60.0),
    };
}

status sun_history_open(sun_history **out, device *dev, const site *place, double origin_s,
                        double step_s, const media *dimming, sun_memory *memory)
{
    status rc = STATUS_OK;
    sun_history *history = calloc(1, sizeof *history);

    NEED(history, STATUS_MEMORY, "no memory for the sun's day");
    history->dev = dev;
    history->dimming = dimming;
    history->memory = memory;
    history->day = day_of(place, origin_s, step_s);
    history->day.stride = history->day.word_count * (dimming ? 1 + SUN_HISTORY_SHARES : 1);
    const size_t slots = 32 * (size_t)history->day.word_count;
    history->suns = calloc(slots, sizeof *history->suns);
    NEED(history->suns, STATUS_MEMORY, "no memory for the sun's day");
    history->last = (long)ceil((place->time_s - origin_s) / step_s - 1e-6);
    history->last_s = origin_s + (double)history->last * step_s;
    set_suns(history->suns, &history->day, place, origin_s, step_s, history->last);
    TRY(device_allocate(dev, &history->sun, 4 * slots, history->suns[0]));
    *out = history;
    history = NULL;
out:
    sun_history_free(history);
    return rc;
}

void sun_history_free(sun_history *history)
{
    if (!history) return;
    device_release(history->sun);
    free(history->suns);
    free(history);
}

uint32_t sun_history_slots(const sun_history *history)
{
    return history->day.slot_count;
}

long sun_history_last(const sun_history *history, double *out_time_s)
{
    *out_time_s = history->last_s;
    return history->last;
}

uint32_t sun_history_words(const sun_history *history)
{
    return history->day.stride;
}

/* Casts the rays towards the suns of a table; slots without a sun get no bit. */
static status trace(const sun_history *history, const ray_scene *scene, const sun_points *points,
                    float_buffer sun, uint_buffer out_lit)
{
    status rc = STATUS_OK;
    const uint32_t count = points->count, words = history->day.word_count;
    const media *dimming = history->dimming;

    TRY(sun_history_run(history->dev, device_bundle_shape(history->dev, count, words),
                        &(sun_history_args){.count = count,
                                            .day = history->day,
                                            .tree = ray_scene_tree(scene),
                                            .facets = points->facets,
                                            .sun = sun,
                                            .hit = points->hit,
                                            .order = points->order,
                                            .lit = out_lit}));
    if (!dimming) goto out;
    TRY(sun_fraction_run(history->dev, shape2(count, SUN_HISTORY_SHARES * words),
                         &(sun_fraction_args){.count = count,
                                              .day = history->day,
                                              .world = ray_scene_tree(scene).world,
                                              .medium = media_tables(dimming),
                                              .sun = sun,
                                              .hit = points->hit,
                                              .lit = out_lit}));
out:
    return rc;
}

/* The step that a slot holds in a day that ends with step `last`. */
static long step_of(const sun_history *history, uint32_t slot, long last)
{
    const long slots = (long)history->day.slot_count;

    return last - ((last - (long)slot) % slots + slots) % slots;
}

/* Suns of the steps that a day which ended with step `from` did not have. Sets the bits and bytes of
 * their slots too.
 *   out_mask   shape (stride) */
static status take_new_suns(const sun_history *history, long from, float_buffer *out_sun,
                            uint32_t *out_mask)
{
    status rc = STATUS_OK;
    const sun_day *day = &history->day;
    const size_t slots = 32 * (size_t)day->word_count;
    float(*sun)[4] = calloc(slots, sizeof *sun);

    NEED(sun, STATUS_MEMORY, "no memory for the sun's day");
    memset(out_mask, 0, day->stride * sizeof *out_mask);
    for (uint32_t slot = 0; slot < day->slot_count; slot++) {
        if (step_of(history, slot, from) == step_of(history, slot, history->last)) continue;
        memcpy(sun[slot], history->suns[slot], sizeof *sun);
        out_mask[slot / 32] |= 1u << (slot % 32);
        if (history->dimming) out_mask[day->word_count + slot / 4] |= 255u << (slot % 4 * 8);
    }
    TRY(device_allocate(history->dev, out_sun, 4 * slots, sun[0]));
out:
    free(sun);
    return rc;
}

/* Traces what an entry does not know yet, and brings it and out_lit up to date. */
static status trace_new(const sun_history *history, const ray_scene *scene,
                        const sun_points *points, sun_memory_entry *entry, uint_buffer out_lit)
{
    status rc = STATUS_OK;
    const uint32_t stride = history->day.stride;
    const size_t words = (size_t)points->count * stride;
    uint32_t *mask = malloc(stride * sizeof *mask), *lit = malloc(words * sizeof *lit);
    float_buffer sun = {0};

    NEED(mask && lit, STATUS_MEMORY, "no memory for the sun's day of %u points", points->count);
    TRY(take_new_suns(history, entry->last, &sun, mask));
    TRY(trace(history, scene, points, sun, out_lit));
    TRY(device_download(history->dev, out_lit, words, lit));
    for (size_t i = 0; i < words; i++) entry->lit[i] = (entry->lit[i] & ~mask[i % stride]) | lit[i];
    TRY(device_upload(history->dev, out_lit, words, entry->lit));
out:
    device_release(sun);
    free(lit);
    free(mask);
    return rc;
}

static status trace_remembered(const sun_history *history, const ray_scene *scene,
                               const sun_points *points, uint_buffer out_lit)
{
    status rc = STATUS_OK;
    const uint32_t count = points->count;
    hit_record *met = malloc(count * sizeof *met);
    sun_memory_entry *entry;

    NEED(met, STATUS_MEMORY, "no memory for %u points", count);
    TRY(device_download(history->dev, points->hit, count, met));
    TRY(sun_memory_find(history->memory, met, count, history->day.stride, &entry));
    if (entry->last == SUN_MEMORY_NOTHING) {
        TRY(trace(history, scene, points, history->sun, out_lit));
        TRY(device_download(history->dev, out_lit, (size_t)count * history->day.stride,
                            entry->lit));
    } else {
        TRY(trace_new(history, scene, points, entry, out_lit));
    }
    entry->last = history->last;
out:
    free(met);
    return rc;
}

status sun_history_trace(const sun_history *history, const ray_scene *scene,
                         const sun_points *points, uint_buffer out_lit)
{
    if (history->memory) return trace_remembered(history, scene, points, out_lit);
    return trace(history, scene, points, history->sun, out_lit);
}

status sun_history_times(const sun_history *history, uint32_t count, uint32_t first_plane,
                         hit_record_buffer hit, uint_buffer lit, float_buffer out_planes)
{
    return sun_times_run(history->dev, shape1(count),
                         &(sun_times_args){.count = count,
                                           .first_plane = first_plane,
                                           .day = history->day,
                                           .hit = hit,
                                           .lit = lit,
                                           .planes = out_planes});
}
