#include "incident.h"

#include "../kernels/incident.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Pixels of a work-item of incident.cl, its LANES_WIDTH. */
enum { PIXELS_AT_ONCE = 16 };

struct incident {
    const ray_scene *scene;
    const shape_factor_grid *grid;
    shape_factor_tables tables;
    incident_record how;
    device_memory dome; /* float, shape (how.dome_count, 8) */
};

/* Point `i` of two in every interval of an even division of span_deg, after Gauss: exact for cubics
 * between the table's rows.
 *   out_row, out_share   its place in the table; 0 where that has one row */
static double gauss_deg(uint32_t i, uint32_t intervals, double span_deg, bool is_table,
                        float *out_row, float *out_share)
{
    const double share = i % 2 ? .5 + .5 / sqrt(3.0) : .5 - .5 / sqrt(3.0);

    *out_row = is_table ? (float)(i / 2) : 0.0f;
    *out_share = is_table ? (float)share : 0.0f;
    return span_deg / intervals * (i / 2 + share);
}

/* The sky in points: direction, solid angle, place in the table. */
static void fill_dome(float *dome, uint32_t zeniths, uint32_t azimuths,
                      const radiometry_record *frame)
{
    const double ring_rad = M_PI / 4.0 / zeniths, step_rad = M_PI / azimuths;

    for (uint32_t z = 0; z < 2 * zeniths; z++)
        for (uint32_t a = 0; a < 2 * azimuths; a++) {
            float *cell = dome + 8 * (z * 2 * azimuths + a);
            const double zenith =
                M_PI / 180.0 *
                gauss_deg(z, zeniths, 90.0, frame->zenith_count > 1, &cell[4], &cell[5]);
            const double azimuth =
                M_PI / 180.0 *
                gauss_deg(a, azimuths, 360.0, frame->azimuth_count > 1, &cell[6], &cell[7]);
            cell[0] = (float)(sin(zenith) * sin(azimuth));
            cell[1] = (float)(sin(zenith) * cos(azimuth));
            cell[2] = (float)cos(zenith);
            cell[3] = (float)(sin(zenith) * ring_rad * step_rad);
        }
}

static status make_dome(incident *in, const radiometry_record *frame)
{
    status rc = STATUS_OK;
    const uint32_t zeniths = frame->zenith_count > 1 ? frame->zenith_count - 1 : 6;
    const uint32_t azimuths = frame->azimuth_count > 1 ? frame->azimuth_count - 1 : 12;
    float *dome = NULL;

    in->how.dome_count = 4 * zeniths * azimuths;
    dome = malloc(in->how.dome_count * 8 * sizeof *dome);
    NEED(dome, STATUS_MEMORY, "no memory for the sky");
    fill_dome(dome, zeniths, azimuths, frame);
    TRY(device_allocate(ray_scene_device(in->scene), &in->dome,
                        in->how.dome_count * 8 * sizeof *dome, dome));
out:
    free(dome);
    return rc;
}

status incident_open(incident **out, const ray_scene *scene, const shape_factor_grid *grid,
                     const shape_factor_tables *tables, uint32_t lobe_rings,
                     const radiometry_record *frame)
{
    status rc = STATUS_OK;
    incident *in = calloc(1, sizeof *in);

    NEED(in, STATUS_MEMORY, "no memory for the incident radiance");
    NEED(lobe_rings * frame->zenith_count * frame->azimuth_count <= INCIDENT_WEIGHTS,
         STATUS_ARGUMENT,
         "the sky has %u x %u directions, and lobes %u rings, expected %u together or fewer",
         frame->zenith_count, frame->azimuth_count, lobe_rings, INCIDENT_WEIGHTS);
    in->how.cell_count = shape_factor_cell_count(grid);
    in->how.ring_count = lobe_rings;
    in->scene = scene;
    in->grid = grid;
    in->tables = *tables;
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

static incident_record how_of(const incident *in, const incident_pixels *p)
{
    incident_record how = in->how;

    how.light_length = p->light_length;
    how.is_of_facets = p->background == NULL;
    how.keeps_sky = p->keeps_sky;
    return how;
}

/* What bodies change of it. */
static status run_bodies(const incident *in, const incident_pixels *p, device_memory out)
{
    const incident_record how = how_of(in, p);
    const device_memory cell = shape_factor_cells(in->grid);
    const world_record world = ray_scene_world(in->scene);
    const crossing_world bodies_around = bodies_world(p->bodies);
    const device_memory nodes = ray_scene_nodes(in->scene), blocks = ray_scene_blocks(in->scene);
    const device_memory body_nodes = bodies_nodes(p->bodies);
    const device_memory body_blocks = bodies_blocks(p->bodies);
    const device_memory medium = bodies_medium(p->bodies), levels = bodies_levels(p->bodies);

    return device_run(ray_scene_device(in->scene), "incident_bodies", shape1(p->frame.pixel_count),
                      ARG(p->frame), ARG(p->camera), ARG(how), ARG(cell), ARG(world),
                      ARG(bodies_around), ARG(nodes), ARG(blocks), ARG(body_nodes),
                      ARG(body_blocks), ARG(medium), ARG(levels), ARG(in->tables.facet),
                      ARG(in->tables.material), ARG(in->tables.temperature_k),
                      ARG(p->facet_background), ARG(p->light), ARG(p->points.hit),
                      ARG(p->background), ARG(p->background_lit), ARG(p->points.met), ARG(p->gloss),
                      ARG(p->spectra), ARG(p->emissivity), ARG(p->extinction), ARG(out));
}

status incident_run(const incident *in, const incident_pixels *p, device_memory out)
{
    status rc = STATUS_OK;
    const incident_record how = how_of(in, p);
    const device_memory cell = shape_factor_cells(in->grid);
    const uint32_t groups = (p->frame.pixel_count + PIXELS_AT_ONCE - 1) / PIXELS_AT_ONCE;
    const device_shape shape = {{groups, 1}, 4};

    TRY(device_run(ray_scene_device(in->scene), "incident", shape, ARG(p->frame), ARG(p->camera),
                   ARG(how), ARG(cell), ARG(in->dome), ARG(in->tables.facet),
                   ARG(in->tables.material), ARG(in->tables.temperature_k),
                   ARG(p->facet_background), ARG(p->light), ARG(p->points.hit), ARG(p->background),
                   ARG(p->background_lit), ARG(p->points.met), ARG(p->gloss), ARG(p->spectra),
                   ARG(p->emissivity), ARG(out)));
    if (p->bodies) TRY(run_bodies(in, p, out));
out:
    return rc;
}
