#include "kernels/thermal/layered.h"

/* Turns temperatures into what facets send out: what they emit and reflect of the longwave.
 * Launch: (facet_count). facet: (facet_count); forcing: (step_count); received_w_m2: shape
 * (step_count, received_columns), of those that have a column; rows: (step_count, facet_count),
 * temperature in, W m-2 out. */
kernel void radiosity(const uint facet_count, const uint step_count,
                      global const layered_record *facet, global const forcing_record *forcing,
                      const uint received_columns, OPTIONAL global const float *received_w_m2,
                      global float *rows)
{
    const uint i = get_global_id(0);
    if (i >= facet_count) return;
    const float emissivity = facet[i].emissivity, sky = facet[i].sky_fraction;
    const uint column = received_columns > 0 ? facet[i].received_column : 0;

    for (uint step = 0; step < step_count; step++) {
        const size_t place = (size_t)step * facet_count + i;
        const float usual_w_m2 = sky * forcing[step].sky_longwave_w_m2 +
                                 (1.0f - sky) * thermal_black_w_m2(forcing[step].air_temperature_k);
        const float down_w_m2 =
            column > 0 ? received_w_m2[(size_t)step * received_columns + column - 1] : usual_w_m2;
        rows[place] =
            emissivity * thermal_black_w_m2(rows[place]) + (1.0f - emissivity) * down_w_m2;
    }
}
