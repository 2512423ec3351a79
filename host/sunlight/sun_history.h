/* Sun history: on which steps of the 24 hours before a time the sun reaches points; one shadow ray
 * a point and step with the sun up. Thesis 2.2.1, Figure 3-8. */
#ifndef SUN_HISTORY_H
#define SUN_HISTORY_H

#include "rays/media.h"
#include "rays/ray_scene.h"
#include "sky/site.h"
#include "sunlight/sun_memory.h"

typedef struct sun_history sun_history;

/* Computes where the sun stood. The last step is the first at or after the site's time.
 *   origin_s   UTC time in seconds of step 0, before the site's time or after it
 *   step_s     divides an hour
 *   dimming    bodies that let a fraction of the sun through, which is told behind the bits; NULL:
 *              none
 *   memory     of histories with the same origin and step, whose rays need not be cast again; what
 *              this one casts is added; NULL: none */
status sun_history_open(sun_history **out, device *dev, const site *place, double origin_s,
                        double step_s, const media *dimming, sun_memory *memory);
void sun_history_free(sun_history *history);

/* Steps of 24 hours. Step k of the weather has bit k % slots. */
uint32_t sun_history_slots(const sun_history *history);

/* Number of the last step, and when it is: UTC, since 1970. */
long sun_history_last(const sun_history *history, double *out_time_s);

/* 32-bit words that hold the bits, and shares, of a point. */
uint32_t sun_history_words(const sun_history *history);

/* The points whose day is wanted. */
typedef struct sun_points {
    uint32_t count;
    facet_record_buffer facets; /* the ground's too */
    hit_record_buffer hit;      /* shape (count) */
    uint_buffer order; /* shape (count): which points are looked at side by side, see point_order.h;
                        * NULL: as they stand. No bit depends on it */
} sun_points;

/* Casts the rays.
 *   out_lit   shape (count, words): 1 where the sun reaches the outward side of the facet,
 *             or either side of a two-sided one. The ground plane is never in shadow (assumed) */
status sun_history_trace(const sun_history *history, const ray_scene *scene,
                         const sun_points *points, uint_buffer out_lit);

/* Sums the bits up: hours lit in the last 24, minutes since the sun came or went.
 *   out_planes   shape (first_plane + 2, count); its last two rows are written, NO_VALUE
 *                where a point has no value */
status sun_history_times(const sun_history *history, uint32_t count, uint32_t first_plane,
                         hit_record_buffer hit, uint_buffer lit, float_buffer out_planes);

#endif
