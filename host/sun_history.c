#include "sun_history.h"

#include "../kernels/sun_history.h"
#include "sun.h"

#include <math.h>
#include <stdlib.h>

struct sun_history {
    device *dev;
    sun_day day;
    const bodies *dimming;
    device_memory sun; /* float, shape (32 words, 4) */
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
    const uint32_t slots = (uint32_t)lround(86400.0 / step_s);

    return (sun_day){
        .slot_count = slots,
        .word_count = (slots + 31) / 32,
        .nearest = (uint32_t)((uint64_t)floor(position + 0.5) % slots),
        .since_min = (float)((position - floor(position + 0.5)) * step_s / 60.0),
        .step_min = (float)(step_s / 60.0),
    };
}

status sun_history_open(sun_history **out, device *dev, const site *place, double origin_s,
                        double step_s, const bodies *dimming)
{
    status rc = STATUS_OK;
    float(*sun)[4] = NULL;
    sun_history *history = calloc(1, sizeof *history);

    NEED(history, STATUS_MEMORY, "no memory for the sun's day");
    history->dev = dev;
    history->dimming = dimming;
    history->day = day_of(place, origin_s, step_s);
    history->day.stride = history->day.word_count * (dimming ? 1 + SUN_HISTORY_SHARES : 1);
    const size_t slots = 32 * (size_t)history->day.word_count;
    sun = calloc(slots, sizeof *sun);
    NEED(sun, STATUS_MEMORY, "no memory for the sun's day");
    history->last = (long)ceil((place->time_s - origin_s) / step_s - 1e-6);
    history->last_s = origin_s + (double)history->last * step_s;
    set_suns(sun, &history->day, place, origin_s, step_s, history->last);
    TRY(device_allocate(dev, &history->sun, slots * sizeof *sun, sun));
    *out = history;
    history = NULL;
out:
    free(sun);
    sun_history_free(history);
    return rc;
}

void sun_history_free(sun_history *history)
{
    if (!history) return;
    device_release(history->sun);
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

static status trace_shares(const sun_history *history, const ray_scene *scene, uint32_t count,
                           device_memory hit, device_memory lit)
{
    const world_record world = ray_scene_world(scene);
    const crossing_world around = bodies_world(history->dimming);
    const device_memory nodes = bodies_nodes(history->dimming);
    const device_memory blocks = bodies_blocks(history->dimming);
    const device_memory medium = bodies_medium(history->dimming);
    const device_memory levels = bodies_levels(history->dimming);

    return device_run(history->dev, "sun_share",
                      shape2(count, SUN_HISTORY_SHARES * history->day.word_count), ARG(count),
                      ARG(history->day), ARG(world), ARG(around), ARG(nodes), ARG(blocks),
                      ARG(medium), ARG(levels), ARG(history->sun), ARG(hit), ARG(lit));
}

status sun_history_trace(const sun_history *history, const ray_scene *scene, device_memory facets,
                         uint32_t count, device_memory hit, device_memory out_lit)
{
    status rc = STATUS_OK;
    const world_record world = ray_scene_world(scene);
    const device_memory nodes = ray_scene_nodes(scene), blocks = ray_scene_blocks(scene);

    TRY(device_run(history->dev, "sun_history",
                   device_ray_shape(history->dev, count, history->day.word_count), ARG(count),
                   ARG(history->day), ARG(world), ARG(nodes), ARG(blocks), ARG(facets),
                   ARG(history->sun), ARG(hit), ARG(out_lit)));
    if (history->dimming) TRY(trace_shares(history, scene, count, hit, out_lit));
out:
    return rc;
}

status sun_history_times(const sun_history *history, uint32_t count, uint32_t first_plane,
                         device_memory hit, device_memory lit, device_memory out_planes)
{
    return device_run(history->dev, "sun_times", shape1(count), ARG(count), ARG(first_plane),
                      ARG(history->day), ARG(hit), ARG(lit), ARG(out_planes));
}
