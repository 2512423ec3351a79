#include "render/facet_course.h"

#include "rays/media.h"
#include "rays/scene_rays.h"
#include "render/render_tables.h"
#include "thermal/temperature.h"

#include <stdlib.h>

struct facet_course {
    scene at; /* the scene, at the time that is asked for */
    device *dev;
    media *dimming;
    ray_scene *rays;
    render_tables tables; /* facets alone */
    sun_memory *suns;
};

status facet_course_open(facet_course **out, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    facet_course *c = calloc(1, sizeof *c);

    NEED(c, STATUS_MEMORY, "no memory for the temperatures of a day");
    c->at = *s;
    c->dev = dev;
    c->tables.facet_count = s->shape->facet_count + (s->ground_material != RECORD_NONE);
    TRY(sun_memory_open(&c->suns));
    TRY(media_open(&c->dimming, dev, s));
    TRY(scene_rays_open(&c->rays, dev, s));
    TRY(render_tables_take_facets(&c->tables, dev, s));
    *out = c;
    c = NULL;
out:
    facet_course_free(c);
    return rc;
}

void facet_course_free(facet_course *c)
{
    if (!c) return;
    render_tables_free(&c->tables);
    ray_scene_free(c->rays);
    media_free(c->dimming);
    sun_memory_free(c->suns);
    free(c);
}

status facet_course_at(facet_course *c, double time_s, float *out_k)
{
    status rc = STATUS_OK;
    temperature_solver *solver = NULL;

    c->at.place.time_s = time_s;
    TRY(temperature_open(&solver, c->dev,
                         &(temperature_scene){.s = &c->at,
                                              .rays = c->rays,
                                              .dimming = c->dimming,
                                              .facets = c->tables.facets,
                                              .facet = c->tables.facet,
                                              .facet_count = c->tables.facet_count,
                                              .memory = c->suns}));
    TRY(device_download(c->dev, temperature_of_facets(solver), c->at.shape->facet_count, out_k));
out:
    temperature_free(solver);
    return rc;
}
