#include "render/render_sensor.h"

#include "render/render_plane.h"
#include "sensor/detector_chain.h"
#include "thermal/value_check.h"

#include <stdio.h>
#include <stdlib.h>

typedef char plane_name[RENDER_PLANE_NAME_SIZE];

static status create(image **out, output_folder *folder, const scene *s, const detector_chain *d,
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
    TRY(image_create(out, folder, stem, detector_chain_columns(d), detector_chain_rows(d), planes,
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
    detector_chain *d = NULL;

    TRY(detector_chain_open(&d, dev, &s->sensor, image_columns(cube), image_rows(cube)));
    const size_t pixels = (size_t)detector_chain_columns(d) * detector_chain_rows(d);
    TRY(create(&img, folder, s, d, cube));
    for (uint32_t i = 0; i < s->band_count; i++) {
        TRY(detector_chain_band(d, &s->bands[i], s->air, scene_quadrature(s), image_values(cube, i),
                                image_values(img, i)));
        const size_t at = value_check_finite(image_values(img, i), pixels);
        NEED(at == pixels, STATUS_ARGUMENT,
             "sensor_%s: found %g in row %zu, column %zu, expected a finite number: is [sensor] "
             "right?",
             s->bands[i].name, (double)image_values(img, i)[at], at / detector_chain_columns(d),
             at % detector_chain_columns(d));
        image_unload(cube);
        image_unload(img);
    }
    TRY(image_finish(img, header));
    *out = img;
    img = NULL;
out:
    image_free(img);
    detector_chain_free(d);
    return rc;
}
