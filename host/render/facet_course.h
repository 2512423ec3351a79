/* Facet course: temperatures of a scene's facets at many times of its day, as a render has them, without the
 * light. */
#ifndef FACET_COURSE_H
#define FACET_COURSE_H

#include "device/device.h"
#include "scene/scene.h"

typedef struct facet_course facet_course;

/* The scene and the device must outlive it. */
status facet_course_open(facet_course **out, device *dev, const scene *s);
void facet_course_free(facet_course *c);

/* Computes the temperatures at a time of the scene's local day.
 *   out_k   shape (the scene's facet_count)
 * Fails as temperature_open does. */
status facet_course_at(facet_course *c, double time_s, float *out_k);

#endif
