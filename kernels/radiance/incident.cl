#include "kernels/radiance/gloss.h"
#include "kernels/radiance/incident_faces.h"
#include "kernels/radiance/incident_near.h"
#include "kernels/radiance/sky_columns.h"
#include "kernels/radiance/sky_pixel.h"

/* Adds what a facet sends to every sample of a pixel. */
static void add_facet(const incident_facet *seen, const incident_tables *t, global float *out)
{
    const uint row = t->frame.sample_count;
    global const float *rows = t->spectra.rows;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum first = spectrum_load(rows + SPECTRA_PLANCK_FIRST * row, block);
        const spectrum second = spectrum_load(rows + SPECTRA_PLANCK_SECOND * row, block);
        const spectrum radiance = incident_radiance(
            seen, lookup_spectrum(t->spectra.emissivity, row, seen->emissivity, block),
            planck_radiance(first, second, seen->temperature_k),
            spectrum_load(rows + SPECTRA_SUN * row, block),
            spectrum_load(rows + SPECTRA_SKY * row, block),
            light_of(&t->emitters, seen->facet, block));
        spectrum_store(spectrum_load(out, block) + seen->weight * radiance, out, block);
    }
}

/* Writes what arrives from sky, facets and ground at the lanes that reflect diffusely.
 *   column   of the sky, the last one of the group before
 *   out      of pixel 0 */
INLINE void write_diffuse(sky_column *column, const incident_group *g, const incident_tables *t,
                          global float *out)
{
    const incident_record params = t->params;

    for (uint first = 0; first < params.cell_count; first += ROUND) {
        const incident_part part = {first, min(first + ROUND, params.cell_count)};
        if (!params.keeps_sky) sky_add(column, g, t, part, out);
        if (params.is_of_facets)
            incident_add_facets(g, t, part, out + t->frame.sample_count);
        else
            incident_add_faces(g, t, part, out + t->frame.sample_count);
    }
    if (g->near.rays.rows == 0u) return;
    const incident_part near = {params.cell_count,
                                params.cell_count + params.ring_count * g->near.rays.rows};
    incident_add_faces(g, t, near, out + t->frame.sample_count);
    incident_near_sky(g, t, out);
    incident_near_even(g, t, out);
}

/* Writes nothing where a lane reflects nothing diffusely.
 *   out   of pixel 0 */
static void clear_others(const incident_group *g, const incident_tables *t, global float *out)
{
    for (uint i = 0; i < g->lane_count; i++) {
        global float *own = incident_rows_of(g, i, t, out);
        for (uint k = 0; !(g->diffuse >> i & 1u) && k < 2u * t->frame.sample_count; k++)
            own[k] = 0.0f;
    }
}

/* Adds what the rays of a specular share bring.
 *   at    what the pixel sees
 *   out   of this pixel: of the sky, and of facets and ground */
static void add_gloss(const incident_tables *t, const hemisphere_tables *rays, camera_record camera,
                      uint pixel, const hit_record *at, global float *out)
{
    const radiometry_record frame = t->frame;
    const surface_tables *surfaces = &t->emitters.surfaces;
    const uint row = frame.sample_count, mirrored = rays->background[pixel].facet;
    const float mirrored_lit = rays->background_lit[pixel];
    const material_record material = surfaces->materials[surfaces->facets[at->facet].material];
    const uint count = gloss_count(material);
    const float weight = material.specular_share / (float)count;
    global const float *sky =
        t->spectra.rows + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * row;
    float direction[3];

    for (uint n = 0; n < count; n++) {
        const uint word =
            gloss_met(frame, material, mirrored, mirrored_lit, rays->gloss_words, pixel, n);
        gloss_direction(frame, camera, at, material, pixel, n, direction);
        if (word != RECORD_NONE) {
            const incident_facet seen =
                see_facet(&t->emitters, frame, word & ~HEMISPHERE_LIT, weight,
                          word & HEMISPHERE_LIT ? 1.0f : 0.0f, direction);
            add_facet(&seen, t, out + row);
            continue;
        }
        const sky_lookup place = sky_find(frame, direction[0], direction[1], direction[2]);
        for (uint block = 0; block < row / SPECTRUM_WIDTH; block++)
            spectrum_store(spectrum_load(out, block) +
                               weight * sky_radiance(sky, frame, place, block),
                           out, block);
    }
}

/* Radiance that reaches every pixel's surface, weighted for its reflection: each ray of the
 * hemisphere brings the facet that it met (its own temperature, emissivity at the ray's angle, sun
 * and what it sees itself) or the sky of its direction, and so does each ray of a specular fraction. Exact
 * counterpart of the background in eq. 2.4-1 and 2.4-2.
 * Launch: (frame.pixel_count / RAY_BUNDLE where RAY_LANES is 16, rounded up, else frame.pixel_count).
 * dome: (DOME_ROWS, params.dome_count)
 * rays: of params.cell_count cells; of pixels, or of facets where params.is_of_facets
 * spectra: of the frame's samples, the knots
 * out: (pixel_count, 2, sample_count), W m-2 sr-1 um-1: of the sky, and of facets and ground */
SHARED_BODY kernel void incident(const radiometry_record frame, const camera_record camera,
                                 const incident_record params, global const float *dome,
                                 TABLES(SURFACE_TABLES), TABLES(LIGHT_TABLES),
                                 TABLES(HEMISPHERE_TABLES), TABLES(SPECTRA_TABLES),
                                 global float *out)
{
    const uint begin = get_global_id(0) * RAY_GROUPS * LANES_WIDTH;
    const uint end = min(begin + RAY_GROUPS * LANES_WIDTH, frame.pixel_count);
    const hemisphere_tables rays = TABLES_GIVEN(HEMISPHERE_TABLES);
    const incident_tables t = {.frame = frame,
                               .params = params,
                               .emitters = {.surfaces = TABLES_GIVEN(SURFACE_TABLES),
                                            .light = TABLES_GIVEN(LIGHT_TABLES),
                                            .light_length = params.light_length},
                               .cells = {params.cell_count, params.ring_count, rays.cell, rays.met,
                                         rays.direction_set, rays.near_rays},
                               .spectra = TABLES_GIVEN(SPECTRA_TABLES),
                               .dome = dome};
    sky_column column;

    sky_forget(&column);
    for (uint first = begin; first < end; first += LANES_WIDTH) {
        incident_group g = incident_take_group(first, &t, &rays);
        incident_near_find(&g.near, &g, &t);
        clear_others(&g, &t, out);
        if (g.diffuse) write_diffuse(&column, &g, &t, out);
        for (uint i = 0; i < g.lane_count; i++) {
            if (g.specular[i] == 0.0f) continue;
            const hit_record at = rays.hit[first + i];
            add_gloss(&t, &rays, camera, g.point[i], &at, incident_rows_of(&g, i, &t, out));
        }
    }
}
