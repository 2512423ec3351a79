/* A pixel a work-item. */
#define LANES_WIDTH 1
#include "kernels/media/cloud.h"
#include "kernels/media/crossing.h"
#include "kernels/radiance/gloss.h"
#include "kernels/radiance/incident_hemisphere.h"

/* What a ray is looked up in. */
typedef struct body_tables {
    radiometry_record frame;
    tree_tables tree; /* of what is opaque */
    medium_tables medium;
    emitter_tables emitters;
    spectra_tables spectra;
} body_tables;

/* One ray from a surface: its weight, what it met, and the bodies on its way and on the sun's. */
typedef struct body_ray {
    float weight;
    uint facet; /* RECORD_NONE: the sky */
    sky_lookup sky;
    incident_facet seen;
    transmission_path way, sun;
    uint is_down; /* bodies are seen from above */
} body_ray;

/* Casts a ray again. */
static body_ray look(const body_tables *t, const hit_record *at, const float *direction,
                     float weight, float lit)
{
    const tree_tables *tree = &t->tree;
    ray r = ray_leaving(&tree->world, at->point, at->normal, direction);
    body_ray out = {.weight = weight, .is_down = direction[2] < 0.0f};
    const hit_record met = hemisphere_record(&r, ray_closest(tree->nodes, tree->blocks, &r), tree);

    out.facet = met.facet;
    r.limit = met.facet == RECORD_NONE ? INFINITY : met.range_m;
    out.way = crossing_path(&t->medium, &r);
    crossing_set_vertical(&t->medium, &r, &out.way);
    if (met.facet == RECORD_NONE) {
        out.sky = sky_find(t->frame, direction[0], direction[1], direction[2]);
        return out;
    }
    out.seen = see_facet(&t->emitters, t->frame, met.facet, weight, lit, direction);
    if (out.seen.sun > 0.0f) {
        const ray towards_sun = ray_leaving(&tree->world, met.point, met.normal, t->frame.sun);
        out.sun = crossing_path(&t->medium, &towards_sun);
    }
    return out;
}

/* A surface's diffuse lobe, and the ring of it that a ray lies in. */
typedef struct body_lobe {
    diffuse_view view;
    uint first, ring, ring_count; /* first: its row, RECORD_NONE: Lambertian, or a mirror */
} body_lobe;

/* Takes the ray through a cell of a hemisphere.
 *   weight   that of the diffuse share; becomes the ray's
 * Returns its word, see hemisphere.cl. */
static uint take_cell_ray(const hemisphere_tables *rays, const body_lobe *lobe, uint count,
                          uint place, uint c, float *out_direction, float *weight)
{
    global const float *cell = rays->cell + 4u * c;

    hemisphere_cell_directions(&lobe->view.axes, &lobe->view.sets, cell, out_direction);
    *weight *= cell[3];
    *weight *= out_direction[2] > 0.0f ? lobe->view.above : lobe->view.below;
    return rays->met[(size_t)c * count + place];
}

/* Adds what bodies change of one ray to every sample. */
static void add_change(const body_ray *r, const body_lobe *lobe, const body_tables *t,
                       global float *out)
{
    const uint row = t->frame.sample_count;
    global const float *rows = t->spectra.rows, *emissivity = t->spectra.emissivity;
    global const float *sky = rows + (size_t)(SPECTRA_PATHS + 2u * t->frame.path_count) * row;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum first = spectrum_load(rows + SPECTRA_PLANCK_FIRST * row, block);
        const spectrum second = spectrum_load(rows + SPECTRA_PLANCK_SECOND * row, block);
        spectrum before, after;
        if (r->facet == RECORD_NONE) {
            before = after = sky_radiance(sky, t->frame, r->sky, block);
        } else {
            const spectrum sun = spectrum_load(rows + SPECTRA_SUN * row, block);
            const spectrum diffuse = spectrum_load(rows + SPECTRA_SKY * row, block);
            const spectrum e = lookup_spectrum(emissivity, row, r->seen.emissivity, block);
            const spectrum black = planck_radiance(first, second, r->seen.temperature_k);
            const spectrum left =
                sun * transmission_along(t->spectra.extinction, row, &r->sun, block);
            const incident_light light = light_of(&t->emitters, r->facet, block);
            before = incident_radiance(&r->seen, e, black, sun, diffuse, light);
            after = incident_radiance(&r->seen, e, black, left, diffuse, light);
        }
        after = cloud_seen(after, &t->spectra, t->frame, &r->way, r->is_down, block);
        const spectrum fraction =
            lobe_of_ring(emissivity, row, lobe->first, lobe->ring, block) /
            lobe_sum(&lobe->view, 0u, lobe->ring_count, emissivity, row, lobe->first, block);
        spectrum_store(spectrum_load(out, block) + r->weight * fraction * (after - before), out,
                       block);
    }
}

/* Changes what reaches every pixel's surface by what transmissive bodies take and give on the ways of
 * its rays, and on the sun's to the facets that they met.
 * Launch: (frame.pixel_count).
 * As incident.cl; out: as that wrote it */
kernel void incident_media(const radiometry_record frame, const camera_record camera,
                           const incident_record params, TABLES(TREE_TABLES), TABLES(MEDIUM_TABLES),
                           TABLES(SURFACE_TABLES), TABLES(LIGHT_TABLES), TABLES(HEMISPHERE_TABLES),
                           TABLES(SPECTRA_TABLES), global float *out)
{
    const uint place = get_global_id(0);
    if (place >= frame.pixel_count) return;
    const hemisphere_tables rays = TABLES_GIVEN(HEMISPHERE_TABLES);
    const hit_record at = rays.hit[place];
    const uint pixel = hemisphere_point(rays.order, place);
    if (at.facet == RECORD_NONE) return;

    const surface_tables surfaces = TABLES_GIVEN(SURFACE_TABLES);
    const body_tables t = {.frame = frame,
                           .tree = TABLES_GIVEN(TREE_TABLES),
                           .medium = TABLES_GIVEN(MEDIUM_TABLES),
                           .emitters = {.surfaces = surfaces,
                                        .light = TABLES_GIVEN(LIGHT_TABLES),
                                        .light_length = params.light_length},
                           .spectra = TABLES_GIVEN(SPECTRA_TABLES)};
    const material_record material = surfaces.materials[surfaces.facets[at.facet].material];
    const float specular = material.specular_share;
    const uint cell_rays = specular < 1.0f ? params.cell_count : 0u;
    const incident_cells cells = {cell_rays, params.ring_count,  rays.cell,
                                  rays.met,  rays.direction_set, rays.near_rays};
    body_lobe lobe = {.view = look_around(at.normal, cells, place, frame.pixel_count),
                      .ring_count = params.ring_count};
    global float *from_sky = out + (size_t)pixel * 2u * frame.sample_count;
    float direction[3];

    for (uint c = 0; c < cell_rays + gloss_count(material); c++) {
        const uint n = c - cell_rays;
        uint word;
        float weight = specular / (float)gloss_count(material);
        if (c < cell_rays) {
            weight = 1.0f - specular;
            word = take_cell_ray(&rays, &lobe, frame.pixel_count, place, c, direction, &weight);
            lobe.first = material.lobe_first;
            lobe.ring = ring_of_cell(cells, c);
        } else {
            word = gloss_met(frame, material, rays.background[pixel].facet,
                             rays.background_lit[pixel], rays.gloss_words, pixel, n);
            gloss_direction(frame, camera, &at, material, pixel, n, direction);
            lobe.first = RECORD_NONE;
        }
        const float lit = word != RECORD_NONE && (word & HEMISPHERE_LIT) ? 1.0f : 0.0f;
        const body_ray r = look(&t, &at, direction, weight, lit);
        if (r.way.length_m[0] > 0.0f || r.sun.length_m[0] > 0.0f)
            add_change(&r, &lobe, &t,
                       r.facet == RECORD_NONE ? from_sky : from_sky + frame.sample_count);
    }
}
