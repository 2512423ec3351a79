/* Temperature: of the facets and of the pixels of a scene at its time; a pixel's follows from its
 * own history of sun and shadow. Thesis 2.2.1, 2.5.5, Figures 3-8, 3-9. */
#ifndef TEMPERATURE_H
#define TEMPERATURE_H

#include "bodies.h"
#include "ray_scene.h"
#include "scene.h"
#include "sun_memory.h"

typedef struct temperature temperature;

/* Computes the facets' temperatures: stated ones, or from the weather: in thesis mode with the sun
 * on them whenever it shines, in exact mode the mean over points of their area, each with its own sun
 * and shadow. Scene, rays, device and memory must outlive it.
 *   memory          of the same scene at other times of its day; NULL: none
 *   facet, facets   facet_record, shape (facet_count), the ground's last, here and on the device */
status temperature_open(temperature **out, device *dev, const scene *s, const ray_scene *rays,
                        const bodies *dimming, device_memory facets, const facet_record *facet,
                        size_t facet_count, sun_memory *memory);
void temperature_free(temperature *t);

/* float, shape (facet_count). */
device_memory temperature_of_facets(const temperature *t);

/* 32-bit words in which a pixel's history of the last 24 hours fits. */
uint32_t temperature_history_words(const temperature *t);

/* Gives the pixels of a tile their facets' temperatures.
 *   hit          hit_record, shape (count)
 *   out_k        float, shape (count); 0 where a pixel meets nothing
 *   out_planes   float, shape (first_plane + SUN_PLANES, count): the last SUN_PLANES get NO_VALUE */
status temperature_of_hits(const temperature *t, uint32_t count, device_memory hit,
                           uint32_t first_plane, device_memory out_k, device_memory out_planes);

/* Casts the rays towards the day's suns and computes the temperatures of a tile.
 *   hit, order    hit_record, uint32, shape (count); see sun_history_trace
 *   out_history   uint32, shape (count, words)
 *   out_k         float, shape (count); 0 where a pixel meets nothing
 *   out_planes    float, shape (first_plane + SUN_PLANES, count): the last SUN_PLANES are written */
status temperature_of_pixels(const temperature *t, const ray_scene *rays, uint32_t count,
                             device_memory hit, device_memory order, uint32_t first_plane,
                             device_memory out_history, device_memory out_k,
                             device_memory out_planes);

/* The 24 hours up to a site's time, as a point went through them. */
typedef struct temperature_day {
    uint32_t step_count;
    double step_s, last_s; /* between steps; UTC time of the last step */
    bool *lit;             /* shape (step_count): the sun reaches it */
    float *temperature_k;  /* shape (step_count); NULL where temperatures are stated */
} temperature_day;

/* The day of one point.
 *   hit   one hit_record that met something
 *   out   to be freed with temperature_day_free */
status temperature_day_of(const temperature *t, const ray_scene *rays, device_memory hit,
                          temperature_day *out);
void temperature_day_free(temperature_day *day);

#endif
