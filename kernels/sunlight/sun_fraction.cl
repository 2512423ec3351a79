#include "kernels/media/crossing.h"
#include "kernels/sunlight/sun_history.h"

/* Tells what fraction of the sun transmissive bodies let through at the steps that are lit: eq. 2.4-4.
 * Launch: (count, SUN_HISTORY_SHARES day.word_count): four slots a work-item.
 * sun, hit: see sun_history.cl
 * lit: (count, day.stride): bits are read, shares written */
kernel void sun_fraction(const uint count, const sun_day day, const world_record world,
                         TABLES(MEDIUM_TABLES), global const float *sun,
                         global const hit_record *hit, global uint *lit)
{
    const uint i = get_global_id(0), word = get_global_id(1);
    if (i >= count) return;
    const medium_tables medium = TABLES_GIVEN(MEDIUM_TABLES);
    const hit_record at = hit[i];
    global uint *own = lit + (size_t)i * day.stride;
    uint fractions = 0;

    for (uint k = 0; k < 4u; k++) {
        const uint slot = 4u * word + k;
        float direction[3];
        if (!sun_history_bit(own, slot)) continue;
        vstore3(vload4(slot, sun).xyz, 0, direction);
        const ray r = ray_leaving(&world, at.point, at.normal, direction);
        const transmission_path path = crossing_path(&medium, &r);
        const float fraction = transmission_broad_band(medium.media.broad_band_per_m, &path);
        fractions |= (uint)(255.0f * fraction + 0.5f) << 8u * k;
    }
    own[day.word_count + word] = fractions;
}
