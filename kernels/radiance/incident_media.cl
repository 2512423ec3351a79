/* A pixel a work-item. */
#define LANES_WIDTH 1
#include "kernels/media/cloud.h"
#include "kernels/media/crossing.h"
#include "kernels/radiance/gloss.h"
#include "kernels/radiance/incident_hemisphere.h"

/* Opaque geometry, and bodies. */
typedef struct both_trees {
    const world_record *world;
    global const bvh_node *nodes;
    global const bvh_block *blocks;
    const medium_world *media;
    global const bvh_node *medium_nodes;
    global const bvh_block *medium_blocks;
    global const uint *medium;
    global const float *level;
} both_trees;

/* The tables of spectra that a ray reads. */
typedef struct body_spectra {
    global const float *rows, *emissivity, *extinction;
} body_spectra;

/* One ray from a surface: its weight, what it met, and the bodies on its way and on the sun's. */
typedef struct body_ray {
    float weight;
    uint facet; /* RECORD_NONE: the sky */
    sky_lookup sky;
    incident_facet seen;
    transmission_path way, sun;
    uint is_down; /* bodies are seen from above */
} body_ray;

static transmission_path cross(const both_trees *trees, const ray *r)
{
    return crossing_path(trees->media, trees->medium_nodes, trees->medium_blocks, trees->medium,
                         trees->level, r);
}

/* Casts a ray again. */
static body_ray look(const both_trees *trees, around from, radiometry_record frame,
                     const hit_record *at, const float *direction, float weight, float lit)
{
    ray r = ray_leaving(trees->world, at->point, at->normal, direction);
    body_ray out = {.weight = weight, .is_down = direction[2] < 0.0f};
    const hit_record met = hemisphere_record(&r, ray_closest(trees->nodes, trees->blocks, &r),
                                             trees->world, trees->blocks);

    out.facet = met.facet;
    r.limit = met.facet == RECORD_NONE ? INFINITY : met.range_m;
    out.way = cross(trees, &r);
    crossing_set_vertical(trees->media, trees->medium_nodes, trees->medium_blocks, trees->medium,
                          &r, &out.way);
    if (met.facet == RECORD_NONE) {
        out.sky = sky_find(frame, direction[0], direction[1], direction[2]);
        return out;
    }
    out.seen = see_facet(from, frame, met.facet, weight, lit, direction);
    if (out.seen.sun > 0.0f) {
        const ray towards_sun = ray_leaving(trees->world, met.point, met.normal, frame.sun);
        out.sun = cross(trees, &towards_sun);
    }
    return out;
}

/* A surface's diffuse lobe, and the ring of it that a ray lies in. */
typedef struct body_lobe {
    diffuse_view view;
    uint first, ring, ring_count; /* first: its row, RECORD_NONE: Lambertian, or a mirror */
} body_lobe;

/* Adds what bodies change of one ray to every sample. */
static void add_change(const body_ray *r, const body_lobe *lobe, around from,
                       radiometry_record frame, body_spectra tables, global float *out)
{
    const uint row = frame.sample_count;
    global const float *sky = tables.rows + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * row;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum first = spectrum_load(tables.rows + SPECTRA_PLANCK_FIRST * row, block);
        const spectrum second = spectrum_load(tables.rows + SPECTRA_PLANCK_SECOND * row, block);
        spectrum before, after;
        if (r->facet == RECORD_NONE) {
            before = after = sky_radiance(sky, frame, r->sky, block);
        } else {
            const spectrum sun = spectrum_load(tables.rows + SPECTRA_SUN * row, block);
            const spectrum diffuse = spectrum_load(tables.rows + SPECTRA_SKY * row, block);
            const spectrum e = lookup_spectrum(tables.emissivity, row, r->seen.emissivity, block);
            const spectrum black = planck_radiance(first, second, r->seen.temperature_k);
            const spectrum left = sun * transmission_along(tables.extinction, row, &r->sun, block);
            const incident_light light = light_of(from, r->facet, block);
            before = incident_radiance(&r->seen, e, black, sun, diffuse, light);
            after = incident_radiance(&r->seen, e, black, left, diffuse, light);
        }
        after =
            cloud_seen(after, tables.rows, tables.extinction, frame, &r->way, r->is_down, block);
        const spectrum fraction =
            lobe_of_ring(tables.emissivity, row, lobe->first, lobe->ring, block) /
            lobe_sum(&lobe->view, 0u, lobe->ring_count, tables.emissivity, row, lobe->first, block);
        spectrum_store(spectrum_load(out, block) + r->weight * fraction * (after - before), out,
                       block);
    }
}

/* Changes what reaches every pixel's surface by what transmissive bodies take and give on the ways of
 * its rays, and on the sun's to the facets that they met.
 * Launch: (frame.pixel_count).
 * As incident.cl, and the trees of what is opaque (nodes, blocks) and of bodies; medium, level: see
 * crossing.cl; extinction: see cloud.h; out: as incident.cl wrote it */
kernel void
incident_media(const radiometry_record frame, const camera_record camera, const incident_record how,
               global const float *cell, const world_record world, const medium_world media,
               global const bvh_node *nodes, global const bvh_block *blocks,
               global const bvh_node *medium_nodes, global const bvh_block *medium_blocks,
               global const uint *medium, global const float *level,
               global const facet_record *facets, global const material_record *materials,
               global const float *temperature_k, global const background_record *facet_background,
               global const float *light, global const hit_record *hit,
               OPTIONAL global const uint *order, global const background_record *background,
               global const float *background_lit, global const uint *met,
               OPTIONAL global const uint *gloss_words, global const float *spectra,
               global const float *emissivity, global const float *extinction, global float *out)
{
    const uint place = get_global_id(0);
    if (place >= frame.pixel_count) return;
    const hit_record at = hit[place];
    const uint pixel = hemisphere_point(order, place);
    if (at.facet == RECORD_NONE) return;

    const around from = {facets, materials, temperature_k, facet_background, light, how};
    const both_trees trees = {&world,       nodes,         blocks, &media,
                              medium_nodes, medium_blocks, medium, level};
    const body_spectra tables = {spectra, emissivity, extinction};
    const material_record material = materials[facets[at.facet].material];
    const float specular = material.specular_share;
    const uint cell_rays = specular < 1.0f ? how.cell_count : 0u;
    const incident_cells cells = {cell_rays, how.ring_count, cell, met};
    body_lobe lobe = {.view = look_around(at.normal, cells, place, frame.pixel_count),
                      .ring_count = how.ring_count};
    global float *from_sky = out + (size_t)pixel * 2u * frame.sample_count;
    float direction[3];

    for (uint c = 0; c < cell_rays + gloss_count(material); c++) {
        const uint n = c - cell_rays;
        uint word;
        float weight = specular / (float)gloss_count(material);
        if (c < cell_rays) {
            word = met[(size_t)c * frame.pixel_count + place];
            hemisphere_lanes_direction(&lobe.view.axes, cell + 4u * c, direction);
            weight = (1.0f - specular) * cell[4u * c + 3u];
            weight *= direction[2] > 0.0f ? lobe.view.above : lobe.view.below;
            lobe.first = material.lobe_first;
            lobe.ring = ring_of_cell(cells, c);
        } else {
            word = gloss_met(frame, material, background[pixel].facet, background_lit[pixel],
                             gloss_words, pixel, n);
            gloss_direction(frame, camera, &at, material, pixel, n, direction);
            lobe.first = RECORD_NONE;
        }
        const float lit = word != RECORD_NONE && (word & HEMISPHERE_LIT) ? 1.0f : 0.0f;
        const body_ray r = look(&trees, from, frame, &at, direction, weight, lit);
        if (r.way.length_m[0] > 0.0f || r.sun.length_m[0] > 0.0f)
            add_change(&r, &lobe, from, frame, tables,
                       r.facet == RECORD_NONE ? from_sky : from_sky + frame.sample_count);
    }
}
