#include "incident.h"

#include "../kernels/incident.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* Facets that are sampled at once, and pixels of a work-item of incident.cl, its LANES_WIDTH. */
enum { CHUNK = 1 << 15, PIXELS_AT_ONCE = 16 };

struct incident {
    const ray_scene *scene;
    const shape_factor_grid *grid;
    shape_factor_tables tables;
    device_memory facet_background; /* background_record, per facet, the ground's last */
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

/* The middle of a facet, as a hit from its front. */
static hit_record facet_middle(const geometry *g, uint32_t facet)
{
    const int corners = g->corner[facet][3] == UINT32_MAX ? 3 : 4;
    hit_record hit = {.facet = g->area_m2[facet] > 0.0f ? facet : RECORD_NONE};

    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < corners; c++)
            hit.point[k] += g->position[g->corner[facet][c]][k] / (float)corners;
        hit.normal[k] = g->normal[facet][k];
    }
    return hit;
}

/* Samples facets first .. first + count - 1 and keeps their records. */
static status sample_facets(incident *in, const geometry *g, uint32_t first, uint32_t count,
                            background_record *out)
{
    status rc = STATUS_OK;
    device *dev = ray_scene_device(in->scene);
    shape_factor_points points = {.count = count};
    device_memory background = NULL;
    hit_record *hits = malloc(count * sizeof *hits);

    NEED(hits, STATUS_MEMORY, "no memory for %u facets", count);
    for (uint32_t i = 0; i < count; i++) hits[i] = facet_middle(g, first + i);
    TRY(device_allocate(dev, &points.hit, count * sizeof *hits, hits));
    TRY(device_allocate(dev, &points.met,
                        (size_t)count * shape_factor_cell_count(in->grid) * sizeof(uint32_t),
                        NULL));
    TRY(device_allocate(dev, &background, count * sizeof *out, NULL));
    TRY(shape_factor_run(in->grid, in->scene, &in->tables, NULL, &points, background));
    TRY(device_download(dev, background, 0, count * sizeof *out, out));
out:
    device_release(background);
    device_release(points.met);
    device_release(points.hit);
    free(hits);
    return rc;
}

static status sample_all(incident *in, const geometry *g)
{
    status rc = STATUS_OK;
    background_record *records = malloc(((size_t)g->facet_count + 1) * sizeof *records);

    NEED(records, STATUS_MEMORY, "no memory for %u facets", g->facet_count);
    for (uint32_t first = 0; first < g->facet_count; first += CHUNK) {
        const uint32_t left = g->facet_count - first;
        TRY(sample_facets(in, g, first, left < CHUNK ? left : CHUNK, records + first));
    }
    /* The endless plane sees nothing but sky. */
    records[g->facet_count] =
        (background_record){.shape_factor = 1.0f, .material = RECORD_NONE, .facet = RECORD_NONE};
    TRY(device_allocate(ray_scene_device(in->scene), &in->facet_background,
                        ((size_t)g->facet_count + 1) * sizeof *records, records));
out:
    free(records);
    return rc;
}

status incident_open(incident **out, const ray_scene *scene, const shape_factor_grid *grid,
                     const shape_factor_tables *tables, uint32_t lobe_rings, const geometry *g,
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
    TRY(sample_all(in, g));
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
    device_release(in->facet_background);
    free(in);
}

/* What bodies change of it. */
static status run_bodies(const incident *in, const incident_pixels *p, device_memory out)
{
    const device_memory cell = shape_factor_cells(in->grid);
    const world_record world = ray_scene_world(in->scene);
    const crossing_world bodies_around = bodies_world(p->bodies);
    const device_memory nodes = ray_scene_nodes(in->scene), blocks = ray_scene_blocks(in->scene);
    const device_memory body_nodes = bodies_nodes(p->bodies);
    const device_memory body_blocks = bodies_blocks(p->bodies);
    const device_memory medium = bodies_medium(p->bodies), levels = bodies_levels(p->bodies);

    return device_run(
        ray_scene_device(in->scene), "incident_bodies", shape1(p->frame.pixel_count), ARG(p->frame),
        ARG(p->camera), ARG(in->how), ARG(cell), ARG(world), ARG(bodies_around), ARG(nodes),
        ARG(blocks), ARG(body_nodes), ARG(body_blocks), ARG(medium), ARG(levels),
        ARG(in->tables.facet), ARG(in->tables.material), ARG(in->tables.temperature_k),
        ARG(in->facet_background), ARG(p->points.hit), ARG(p->background), ARG(p->background_lit),
        ARG(p->points.met), ARG(p->spectra), ARG(p->emissivity), ARG(p->extinction), ARG(out));
}

status incident_run(const incident *in, const incident_pixels *p, device_memory out)
{
    status rc = STATUS_OK;
    const device_memory cell = shape_factor_cells(in->grid);
    const uint32_t groups = (p->frame.pixel_count + PIXELS_AT_ONCE - 1) / PIXELS_AT_ONCE;
    const device_shape shape = {{groups, 1}, 4};

    TRY(device_run(ray_scene_device(in->scene), "incident", shape, ARG(p->frame), ARG(p->camera),
                   ARG(in->how), ARG(cell), ARG(in->dome), ARG(in->tables.facet),
                   ARG(in->tables.material), ARG(in->tables.temperature_k),
                   ARG(in->facet_background), ARG(p->points.hit), ARG(p->background),
                   ARG(p->background_lit), ARG(p->points.met), ARG(p->spectra), ARG(p->emissivity),
                   ARG(out)));
    if (p->bodies) TRY(run_bodies(in, p, out));
out:
    return rc;
}
