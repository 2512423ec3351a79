#include "station/table_light.h"

#include "station/light_split.h"

#include <math.h>

void table_light_split(weather_table *table, const site *place, const char *path)
{
    weather *w = table->history;
    const double origin_s = weather_origin_s(w, place);
    double hours = 0.0;

    for (size_t i = 0; i < w->count; i++) {
        weather_record *r = &w->record[i];
        const double time_s = origin_s + 3600.0 * r->time_h, half_s = 0.5 * w->interval_s;
        double direct = NAN, diffuse = NAN;
        if (!table->is_global[i]) continue;
        const sun_span sun = sun_span_at(place, time_s - half_s, time_s + half_s);
        if (sun.beyond_w_m2 <= 0.0) continue; /* stays what it is: the clock is checked elsewhere */
        if (light_split_complete(&sun, r->diffuse_w_m2, &direct, &diffuse))
            hours += w->interval_s / 3600.0;
        r->direct_w_m2 = direct;
        r->diffuse_w_m2 = diffuse;
    }
    if (hours > 0.0)
        status_warn(
            "%s: direct and diffuse light of %.4g hours follow from the global irradiance, by the "
            "diffuse fraction of Erbs (1982)",
            path, hours);
}
