#include "thermal/facet_check.h"

#include "thermal/value_check.h"

#include <math.h>

#define COLDER_K 60.0 /* than the air: clear skies cool by less than half of it */
#define HOTTEST_K 2000.0

static bool has_area(const scene *s, size_t i)
{
    const geometry *g = s->shape;

    return i >= g->facet_count || (g->area_m2[i] > 0.0f && isfinite(g->area_m2[i]));
}

static bool has_power(const scene *s, const facet_record *facet)
{
    return facet->power_w_m2 != 0.0f || s->materials[facet->material].power.count > 0;
}

static double coldest_air_k(const weather *w)
{
    double coldest = INFINITY;

    for (size_t i = 0; i < w->count; i++) coldest = fmin(coldest, w->record[i].air_temperature_k);
    return coldest;
}

static void warn_of_power(const scene *s, const facet_record *facet, size_t count,
                          const float *facet_k)
{
    const double least_k = coldest_air_k(s->history) - COLDER_K;
    size_t odd = 0, first = 0;
    char text[1024];

    for (size_t i = 0; i < count; i++) {
        const double k = (double)facet_k[i];
        if ((k >= least_k && k <= HOTTEST_K) || !has_area(s, i) || !has_power(s, &facet[i]))
            continue;
        if (odd++ == 0) first = i;
    }
    if (odd == 0) return;
    status_warn(
        "%s: its power of %g W/m2, and what its material generates by the hour, takes it to "
        "%.4g K (%zu such facets), expected %.4g to %g K: power counts per m2, positive where it "
        "heats",
        scene_facet_text(s, (uint32_t)first, text, sizeof text), (double)facet[first].power_w_m2,
        (double)facet_k[first], odd, least_k, HOTTEST_K);
}

status facet_check(const scene *s, const facet_record *facet, size_t count, const float *facet_k)
{
    char text[1024];

    for (size_t i = 0; i < count; i++) {
        if (value_check_kelvin(facet_k[i]) || !has_area(s, i)) continue;
        return status_set(STATUS_ARGUMENT, "%s: found a temperature of %g K, expected %s",
                          scene_facet_text(s, (uint32_t)i, text, sizeof text), (double)facet_k[i],
                          VALUE_CHECK_RANGE);
    }
    if (s->thermal != SCENE_THERMAL_FIXED && s->history) warn_of_power(s, facet, count, facet_k);
    return STATUS_OK;
}
