#include "kernels/sunlight/sun_history.h"

/* Launch: (count). hit: per point; lit: shape (count, day.stride); planes: shape
 * (SUN_PLANES, count): hours lit in the last 24, minutes since the sun came or went; NO_VALUE where
 * there is none. */
kernel void sun_times(const uint count, const uint first_plane, const sun_day day,
                      global const hit_record *hit, global const uint *lit, global float *planes)
{
    const uint i = get_global_id(0);
    if (i >= count) return;
    global float *out = planes + (size_t)first_plane * count + i;
    global const uint *own = lit + (size_t)i * day.stride;
    const uint met = hit[i].facet != RECORD_NONE;
    out[0] = met ? sun_history_hours(day, own) : NO_VALUE;
    out[count] = met ? sun_history_minutes(day, own) : NO_VALUE;
}
