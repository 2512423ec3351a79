/* Sun history: at which steps of the last 24 hours the sun reached a point, a bit each. A day's steps
 * are its slots: step k, counted from the weather's first record, has slot k % slot_count. In a scene
 * with transmissive bodies a byte each, behind the bits, tells what fraction of the sun they let through,
 * 255 all of it: four slots a word. Thesis 2.2.1, eq. 2.4-4. */
#ifndef SUN_HISTORY_KERNEL_H
#define SUN_HISTORY_KERNEL_H

#include "kernels/dialect.h"
#include "kernels/records.h"

typedef struct sun_day {
    uint slot_count; /* of 24 hours */
    uint word_count; /* of a point's bits: bit slot % 32 of word slot / 32 */
    uint nearest;    /* slot of the step nearest to the image's time */
    float since_min; /* from that step to the image's time, may be negative */
    float step_min;
    uint stride; /* words of a point: its bits, and in a scene with bodies its shares */
    uint unused[2];
} sun_day;
RECORD_SIZE(sun_day, 32);

/* Words of shares for every word of bits. */
#define SUN_HISTORY_SHARES 8u

#ifdef __OPENCL_C_VERSION__

static inline uint sun_history_bit(global const uint *lit, uint slot)
{
    return lit[slot / 32] >> (slot % 32) & 1u;
}

static inline float sun_history_hours(sun_day day, global const uint *lit)
{
    uint count = 0;

    for (uint i = 0; i < day.word_count; i++) count += popcount(lit[i]);
    return (float)count * day.step_min / 60.0f;
}

/* Minutes since the sun came or went, NO_VALUE where it did neither in 24 hours. The edge lies midway
 * between two steps, as the thermal model has it. */
static inline float sun_history_minutes(sun_day day, global const uint *lit)
{
    const uint now = sun_history_bit(lit, day.nearest);

    for (uint back = 1; back < day.slot_count; back++) {
        const uint slot = (day.nearest + day.slot_count - back) % day.slot_count;
        if (sun_history_bit(lit, slot) != now)
            return ((float)back - 0.5f) * day.step_min + day.since_min;
    }
    return NO_VALUE;
}

#endif

#endif
