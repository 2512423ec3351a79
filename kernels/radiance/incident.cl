#include "kernels/radiance/gloss.h"
#include "kernels/radiance/incident_faces.h"
#include "kernels/radiance/sky_columns.h"
#include "kernels/radiance/sky_pixel.h"

/* Adds what a facet sends to every sample of a pixel. */
static void add_facet(const incident_facet *seen, around from, radiometry_record frame,
                      global const float *spectra, global const float *emissivity,
                      global float *out)
{
    const uint row = frame.sample_count;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum first = spectrum_load(spectra + SPECTRA_PLANCK_FIRST * row, block);
        const spectrum second = spectrum_load(spectra + SPECTRA_PLANCK_SECOND * row, block);
        const spectrum radiance = incident_radiance(
            seen, lookup_spectrum(emissivity, row, seen->emissivity, block),
            planck_radiance(first, second, seen->temperature_k),
            spectrum_load(spectra + SPECTRA_SUN * row, block),
            spectrum_load(spectra + SPECTRA_SKY * row, block), light_of(from, seen->facet, block));
        spectrum_store(spectrum_load(out, block) + seen->weight * radiance, out, block);
    }
}

/* Writes what arrives from sky, facets and ground at the lanes that reflect diffusely.
 *   column   of the sky, the last one of the group before
 *   out      of pixel 0 */
INLINE void write_diffuse(sky_column *column, const incident_group *g, const incident_tables *t,
                          global float *out)
{
    const incident_record how = t->from.how;

    for (uint first = 0; first < how.cell_count; first += ROUND) {
        const incident_part part = {first, min(first + ROUND, how.cell_count)};
        if (!how.keeps_sky) sky_add(column, g, t, part, out);
        if (how.is_of_facets)
            incident_add_facets(g, t, part, out + t->frame.sample_count);
        else
            incident_add_faces(g, t, part, out + t->frame.sample_count);
    }
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
 *   out   of this pixel: of the sky, and of facets and ground */
static void add_gloss(around from, radiometry_record frame, camera_record camera, uint pixel,
                      const hit_record *at, const background_record *mirrored, float mirrored_lit,
                      global const uint *gloss_words, global const float *spectra,
                      global const float *emissivity, global float *out)
{
    const uint row = frame.sample_count;
    const material_record material = from.materials[from.facets[at->facet].material];
    const uint count = gloss_count(material);
    const float weight = material.specular_share / (float)count;
    global const float *sky = spectra + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * row;
    float direction[3];

    for (uint n = 0; n < count; n++) {
        const uint word =
            gloss_met(frame, material, mirrored->facet, mirrored_lit, gloss_words, pixel, n);
        gloss_direction(frame, camera, at, material, pixel, n, direction);
        if (word != RECORD_NONE) {
            const incident_facet seen = see_facet(from, frame, word & ~HEMISPHERE_LIT, weight,
                                                  word & HEMISPHERE_LIT ? 1.0f : 0.0f, direction);
            add_facet(&seen, from, frame, spectra, emissivity, out + row);
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
 * and what it sees itself) or the sky of its direction, and so does each ray of a specular share. Exact
 * counterpart of the background in eq. 2.4-1 and 2.4-2.
 * Launch: (frame.pixel_count / RAY_BUNDLE where RAY_LANES is 16, rounded up, else frame.pixel_count).
 * cell: (how.cell_count, 4), met: (how.cell_count, pixel_count), see hemisphere.cl
 * dome: (DOME_ROWS, how.dome_count)
 * facets, temperature_k, facet_background: per facet, the ground's behind the real ones
 * light: see surroundings.h
 * hit: (pixel_count); order: (pixel_count), which pixel each of hit and met is, NULL: the same
 * background, background_lit: per pixel; read for mirrors, not of facets
 * gloss_words: (LOBE_RAYS, pixel_count), see gloss.cl; NULL where nothing is rough
 * spectra, emissivity: as radiometry.cl, of the frame's samples: the knots
 * out: (pixel_count, 2, sample_count), W m-2 sr-1 um-1: of the sky, and of facets and ground */
SHARED_BODY kernel void
incident(const radiometry_record frame, const camera_record camera, const incident_record how,
         global const float *cell, global const float *dome, global const facet_record *facets,
         global const material_record *materials, global const float *temperature_k,
         global const background_record *facet_background, global const float *light,
         global const hit_record *hit, OPTIONAL global const uint *order,
         OPTIONAL global const background_record *background,
         OPTIONAL global const float *background_lit, global const uint *met,
         OPTIONAL global const uint *gloss_words, global const float *spectra,
         global const float *emissivity, global float *out)
{
    const uint begin = get_global_id(0) * RAY_GROUPS * LANES_WIDTH;
    const uint end = min(begin + RAY_GROUPS * LANES_WIDTH, frame.pixel_count);
    const around from = {facets, materials, temperature_k, facet_background, light, how};
    const incident_cells cells = {how.cell_count, how.ring_count, cell, met};
    const incident_tables t = {frame, from, cells, dome, spectra, emissivity};
    sky_column column;

    sky_forget(&column);
    for (uint first = begin; first < end; first += LANES_WIDTH) {
        const incident_group g = incident_take_group(first, &t, hit, order);
        clear_others(&g, &t, out);
        if (g.diffuse) write_diffuse(&column, &g, &t, out);
        for (uint i = 0; i < g.lane_count; i++) {
            if (g.specular[i] == 0.0f) continue;
            const uint pixel = g.point[i];
            const hit_record at = hit[first + i];
            const background_record mirrored = background[pixel];
            add_gloss(from, frame, camera, pixel, &at, &mirrored, background_lit[pixel],
                      gloss_words, spectra, emissivity, incident_rows_of(&g, i, &t, out));
        }
    }
}
