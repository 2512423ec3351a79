#include "render_sensor.h"

#include "degradation.h"
#include "render_plane.h"

#include <stdio.h>
#include <stdlib.h>

typedef char plane_name[RENDER_PLANE_NAME_SIZE];

static status create(image **out, output_folder *folder, const scene *s, const degraded *d,
                     const image *cube)
{
    status rc = STATUS_OK;
    char stem[512];
    image_plane *planes = calloc(s->band_count, sizeof *planes);
    plane_name *names = calloc(s->band_count, sizeof *names);

    NEED(planes && names, STATUS_MEMORY, "no memory for the sensor's planes");
    for (uint32_t i = 0; i < s->band_count; i++) {
        planes[i] = *image_plane_at(cube, i);
        snprintf(names[i], sizeof names[i], "sensor_%s", s->bands[i].name);
        planes[i].name = names[i];
    }
    snprintf(stem, sizeof stem, "%s_sensor", s->name);
    TRY(image_create(out, folder, stem, degraded_columns(d), degraded_rows(d), planes,
                     s->band_count));
out:
    free(names);
    free(planes);
    return rc;
}

status render_sensor_write(image **out, output_folder *folder, const scene *s, device *dev,
                           image *cube, const image_header *header)
{
    status rc = STATUS_OK;
    image *img = NULL;
    degraded *d = NULL;

    TRY(degraded_open(&d, dev, &s->sensor, image_columns(cube), image_rows(cube)));
    TRY(create(&img, folder, s, d, cube));
    for (uint32_t i = 0; i < s->band_count; i++) {
        TRY(degraded_band(d, &s->bands[i], s->air, scene_sums_points(s), image_values(cube, i),
                          image_values(img, i)));
        image_unload(cube);
        image_unload(img);
    }
    TRY(image_finish(img, header));
    *out = img;
    img = NULL;
out:
    image_free(img);
    degraded_free(d);
    return rc;
}
