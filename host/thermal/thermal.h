/* Thermal: temperatures from the weather history: a reconstruction of what THERM does (thesis 2.2,
 * kernels/thermal/thermal.h), or facets of several layers (kernels/thermal/layered.h). Facets and pixels are computed
 * alike: a pixel is a facet with its own history of sun and shadow (Figures 3-8, 3-9). */
#ifndef THERMAL_H
#define THERMAL_H

#include "launches.h"
#include "material/heat_schedule.h"
#include "material/layered.h"
#include "sky/site.h"
#include "weather/forcing.h"
#include "weather/weather.h"

typedef struct thermal thermal;

/* The materials that facets name. */
typedef struct thermal_matter {
    const material_record *material; /* shape (count) */
    const layered_matter *layered;   /* shape (count); NULL: as THERM does it */
    const heat_schedule *power;      /* shape (count); NULL: none */
    size_t count;
    forcing_laws laws; /* how weather acts on them */
} thermal_matter;

/* Turns the weather into what acts on a surface. The last full day of the history is the day of the
 * site's time. The device must outlive it. */
status thermal_open(thermal **out, device *dev, const thermal_matter *matter, const weather *w,
                    const site *place);
void thermal_free(thermal *t);

/* What to compute temperatures of. */
typedef struct thermal_subject {
    const facet_record *facet; /* shape (count) */
    size_t count;
    const uint32_t *lit; /* shape (count, word_count), bit slot % 32 of word slot / 32: 1 where
                               the sun reaches it; NULL: always lit */
    uint32_t word_count; /* 0 without lit */
    uint32_t slot_count; /* step k has slot k % slot_count */
} thermal_subject;

/* Computes the temperatures at the site's time, linear between steps. What is equal is computed
 * once, so that a value depends neither on its neighbours nor on its place.
 *   out_temperature_k   shape (count)
 * Fails with STATUS_ARGUMENT where the weather does not cover the site's time. */
status thermal_at_time(const thermal *t, const thermal_subject *subject, float *out_temperature_k);

/* Computes the temperatures at the slot_count steps of the weather that end with step `last`, the same
 * bits as thermal_at_time gives at a step.
 *   subject             count 1, with lit
 *   out_temperature_k   shape (slot_count); NAN where the weather has no such step */
status thermal_day(const thermal *t, const thermal_subject *subject, long last,
                   float *out_temperature_k);

/* Computes the temperatures of facets at every step of the weather, always lit.
 *   facet               shape (count)
 *   out_temperature_k   shape (weather's count, count)
 * Fails with STATUS_ARGUMENT where no surface can have a temperature. */
status thermal_histories(const thermal *t, const facet_record *facet, size_t count,
                         float *out_temperature_k);

#endif
