/* Temperature: of the facets and of the pixels of a scene at its time; a pixel's follows from its
 * own history of sun and shadow. Thesis 2.2.1, 2.5.5, Figures 3-8, 3-9. */
#ifndef TEMPERATURE_H
#define TEMPERATURE_H

#include "rays/media.h"
#include "rays/ray_scene.h"
#include "scene/scene.h"
#include "sunlight/sun_memory.h"

typedef struct temperature_solver temperature_solver;

/* What temperatures follow from; must outlive them. */
typedef struct temperature_scene {
    const scene *s;
    const ray_scene *rays;
    const media *dimming;       /* NULL: none */
    facet_record_buffer facets; /* shape (facet_count), the ground's last */
    const facet_record *facet;  /* the same; need not outlive temperature_open */
    size_t facet_count;
    sun_memory *memory; /* of the same scene at other times of its day; NULL: none */
} temperature_scene;

/* Computes the facets' temperatures: stated ones, or from the weather: in thesis mode with the sun
 * on them whenever it shines, in exact mode the mean over points of their area, each with its own sun
 * and shadow. The device must outlive it. Fails with STATUS_ARGUMENT, and the facet's name, where none
 * can have its temperature. */
status temperature_open(temperature_solver **out, device *dev, const temperature_scene *from);
void temperature_free(temperature_solver *t);

/* Shape (facet_count). */
float_buffer temperature_of_facets(const temperature_solver *t);

/* 32-bit words in which a pixel's history of the last 24 hours fits. */
uint32_t temperature_history_words(const temperature_solver *t);

/* Pixels of a tile, and what is computed of them. */
typedef struct temperature_pixels {
    uint32_t count;
    hit_record_buffer hit;      /* shape (count) */
    uint_buffer order;          /* shape (count), see sun_points */
    uint_buffer history;        /* shape (count, words): written */
    float_buffer temperature_k; /* shape (count): written, 0 where a pixel meets nothing */
    uint32_t first_plane;
    float_buffer
        planes; /* shape (first_plane + SUN_PLANES, count): the last SUN_PLANES are written */
} temperature_pixels;

/* Gives the pixels their facets' temperatures; the planes get NO_VALUE, order and history are not
 * used. */
status temperature_of_hits(const temperature_solver *t, const temperature_pixels *pixels);

/* Casts the rays towards the day's suns and computes the temperatures of the pixels. */
status temperature_of_pixels(const temperature_solver *t, const ray_scene *rays,
                             const temperature_pixels *pixels);

/* The 24 hours up to a site's time, as a point went through them. */
typedef struct pixel_day {
    uint32_t step_count;
    double step_s, last_s; /* between steps; UTC time of the last step */
    bool *lit;             /* shape (step_count): the sun reaches it */
    float *temperature_k;  /* shape (step_count); NULL where temperatures are stated */
} pixel_day;

/* The day of one point.
 *   hit   one hit_record that met something
 *   out   to be freed with pixel_day_free */
status pixel_day_of(const temperature_solver *t, const ray_scene *rays, hit_record_buffer hit,
                    pixel_day *out);
void pixel_day_free(pixel_day *day);

#endif
