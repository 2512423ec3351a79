#include "radiance/incident.h"

#include "kernels/radiance/incident.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* The dome's points are padded to whole vectors. */
enum { POINTS_AT_ONCE = 16 };

struct incident {
    const ray_scene *scene;
    const hemisphere_grid *grid;
    surface_tables surfaces;
    incident_record params;
    float_buffer dome; /* shape (DOME_ROWS, params.dome_count) */
};

/* A point between two rows of a table. */
typedef struct table_place {
    double deg;
    uint32_t row, next;
    double fraction; /* of the next */
} table_place;

/* Point `i` of two in every interval of an even division of span_deg, after Gauss: exact for cubics
 * between the table's rows, of which there may be one alone. */
static table_place gauss_place(uint32_t i, uint32_t intervals, double span_deg, bool is_table)
{
    const double fraction = i % 2 ? .5 + .5 / sqrt(3.0) : .5 - .5 / sqrt(3.0);
    table_place at = {.deg = span_deg / intervals * (i / 2 + fraction)};

    if (is_table) {
        at.row = i / 2;
        at.next = at.row + 1;
        at.fraction = fraction;
    }
    return at;
}

/* Fills a point of the dome.
 *   point   in the first row; count: floats of a row */
static void fill_point(float *point, uint32_t count, table_place zenith, table_place azimuth,
                       uint32_t azimuth_count)
{
    const double down = zenith.deg * M_PI / 180.0, turn = azimuth.deg * M_PI / 180.0;
    const uint32_t row[2] = {zenith.row, zenith.next}, column[2] = {azimuth.row, azimuth.next};

    point[0] = (float)(sin(down) * sin(turn));
    point[count] = (float)(sin(down) * cos(turn));
    point[2 * count] = (float)cos(down);
    for (uint32_t k = 0; k < 4; k++) {
        float *corner = point + (DOME_CORNERS + k) * count;
        corner[0] = (float)(row[k / 2] * azimuth_count + column[k % 2]);
        corner[4 * count] = (float)((k / 2 ? zenith.fraction : 1.0 - zenith.fraction) *
                                    (k % 2 ? azimuth.fraction : 1.0 - azimuth.fraction));
    }
}

/* The sky in points.
 *   dome   shape (DOME_ROWS, count), 0 */
static void fill_dome(float *dome, uint32_t count, uint32_t zeniths, uint32_t azimuths,
                      const radiometry_record *frame)
{
    const double ring_rad = M_PI / 4.0 / zeniths, step_rad = M_PI / azimuths;

    for (uint32_t z = 0; z < 2 * zeniths; z++)
        for (uint32_t a = 0; a < 2 * azimuths; a++) {
            float *point = dome + z * 2 * azimuths + a;
            const table_place zenith = gauss_place(z, zeniths, 90.0, frame->zenith_count > 1);
            const table_place azimuth = gauss_place(a, azimuths, 360.0, frame->azimuth_count > 1);
            fill_point(point, count, zenith, azimuth, frame->azimuth_count);
            point[DOME_SOLID_ANGLE * count] =
                (float)(sin(zenith.deg * M_PI / 180.0) * ring_rad * step_rad);
        }
}

static status make_dome(incident *in, const radiometry_record *frame)
{
    status rc = STATUS_OK;
    const uint32_t zeniths = frame->zenith_count > 1 ? frame->zenith_count - 1 : 6;
    const uint32_t azimuths = frame->azimuth_count > 1 ? frame->azimuth_count - 1 : 12;
    const uint32_t groups = (4 * zeniths * azimuths + POINTS_AT_ONCE - 1) / POINTS_AT_ONCE;
    const uint32_t count = groups * POINTS_AT_ONCE;
    float *dome = calloc((size_t)DOME_ROWS * count, sizeof *dome);

    NEED(dome, STATUS_MEMORY, "no memory for the sky");
    fill_dome(dome, count, zeniths, azimuths, frame);
    in->params.dome_count = count;
    TRY(device_allocate(ray_scene_device(in->scene), &in->dome, (size_t)DOME_ROWS * count, dome));
out:
    free(dome);
    return rc;
}

status incident_open(incident **out, const ray_scene *scene, const hemisphere_grid *grid,
                     const surface_tables *surfaces, uint32_t lobe_rings,
                     const radiometry_record *frame)
{
    status rc = STATUS_OK;
    incident *in = calloc(1, sizeof *in);

    NEED(in, STATUS_MEMORY, "no memory for the incident radiance");
    NEED(lobe_rings * frame->zenith_count * frame->azimuth_count <= INCIDENT_WEIGHTS,
         STATUS_ARGUMENT,
         "the sky has %u x %u directions, and lobes %u rings, expected %u together or fewer",
         frame->zenith_count, frame->azimuth_count, lobe_rings, INCIDENT_WEIGHTS);
    in->params.cell_count = hemisphere_grid_cell_count(grid);
    in->params.ring_count = lobe_rings;
    in->scene = scene;
    in->grid = grid;
    in->surfaces = *surfaces;
    TRY(make_dome(in, frame));
    *out = in;
    in = NULL;
out:
    incident_free(in);
    return rc;
}

void incident_free(incident *in)
{
    if (!in) return;
    device_release(in->dome);
    free(in);
}

static incident_record params_of(const incident *in, const incident_pixels *p)
{
    incident_record params = in->params;

    params.light_length = p->light_length;
    params.is_of_facets = p->background.memory == NULL;
    params.keeps_sky = p->keeps_sky;
    return params;
}

static hemisphere_tables rays_of(const incident *in, const incident_pixels *p)
{
    hemisphere_tables rays = shape_factor_rays(in->grid, &p->points);

    rays.background = p->background;
    rays.background_lit = p->background_lit;
    rays.gloss_words = p->gloss;
    return rays;
}

/* What bodies change of it. */
static status run_media(const incident *in, const incident_pixels *p, float_buffer out)
{
    return incident_media_run(ray_scene_device(in->scene), shape1(p->frame.pixel_count),
                              &(incident_media_args){.frame = p->frame,
                                                     .camera = p->camera,
                                                     .params = params_of(in, p),
                                                     .tree = ray_scene_tree(in->scene),
                                                     .medium = media_tables(p->media),
                                                     .surface = in->surfaces,
                                                     .light = p->light,
                                                     .hemisphere = rays_of(in, p),
                                                     .spectra = p->spectra,
                                                     .out = out});
}

status incident_compute(const incident *in, const incident_pixels *p, float_buffer out)
{
    status rc = STATUS_OK;
    device *dev = ray_scene_device(in->scene);

    TRY(incident_run(dev, device_bundle_shape(dev, p->frame.pixel_count, 1),
                     &(incident_args){.frame = p->frame,
                                      .camera = p->camera,
                                      .params = params_of(in, p),
                                      .dome = in->dome,
                                      .surface = in->surfaces,
                                      .light = p->light,
                                      .hemisphere = rays_of(in, p),
                                      .spectra = p->spectra,
                                      .out = out}));
    if (p->media) TRY(run_media(in, p, out));
out:
    return rc;
}
