#include "surroundings.h"

/* Facets that are held at once; more rays take further rounds. */
#define ROUND 64u

/* Weights of the sky's directions for a diffuse surface. The cells that see the sky count what they
 * weigh; what the cells above the horizon miss of the open sky's integral is added by the share of
 * the sky that is seen.
 *   dome   (dome_count, 8): direction, solid angle, and its place in the table: rows and shares of
 *          zenith and azimuth */
static void count_sky(float *weights, radiometry_record frame, const float *normal,
                      diffuse_view view, uint cell_count, global const float *cell,
                      global const uint *met, uint stride, uint dome_count,
                      global const float *dome)
{
    float open = 0.0f, exact = 0.0f, direction[3];

    for (uint c = 0; c < cell_count; c++) {
        const float of_cell = cell_direction(&view.axes, cell, c, direction);
        const uint is_above = direction[2] > 0.0f;
        const float sees = met[(size_t)c * stride] == RECORD_NONE ? 1.0f : 0.0f;
        const float weight =
            of_cell * (is_above ? view.above * (sees - view.seen) : view.below * sees);
        exact += is_above ? of_cell * view.above : 0.0f;
        if (weight != 0.0f)
            incident_add_sky(weights, frame,
                             sky_find(frame, direction[0], direction[1], direction[2]), weight);
    }
    for (uint pass = 0; pass < 2u && view.seen > 0.0f; pass++)
        for (uint d = 0; d < dome_count; d++) {
            const float8 at = vload8(d, dome);
            const float facing =
                fmax((at.s0 * normal[0] + at.s1 * normal[1] + at.s2 * normal[2]) * at.s3, 0.0f);
            if (pass == 0u) {
                open += facing;
            } else if (facing > 0.0f) {
                const uint low = (uint)at.s4, left = (uint)at.s6;
                const uint high = min(low + 1u, frame.zenith_count - 1u);
                const uint right = min(left + 1u, frame.azimuth_count - 1u);
                incident_add_sky(weights, frame,
                                 (sky_lookup){{low, high, at.s5}, {left, right, at.s7}},
                                 facing / open * exact * view.seen);
            }
        }
}

/* Adds what `count` facets send to every sample of a pixel. */
static void add_facets(const incident_facet *facets, uint count, radiometry_record frame,
                       global const float *spectra, global const float *emissivity,
                       global float *out)
{
    const uint row = frame.sample_count;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum first = spectrum_load(spectra + SPECTRA_PLANCK_FIRST * row, block);
        const spectrum second = spectrum_load(spectra + SPECTRA_PLANCK_SECOND * row, block);
        const spectrum sun = spectrum_load(spectra + SPECTRA_SUN * row, block);
        const spectrum sky = spectrum_load(spectra + SPECTRA_SKY * row, block);
        spectrum sum = spectrum_load(out, block);
        for (uint i = 0; i < count; i++)
            sum += facets[i].weight *
                   incident_radiance(
                       &facets[i], lookup_spectrum(emissivity, row, facets[i].emissivity, block),
                       planck_radiance(first, second, facets[i].temperature_k), sun, sky);
        spectrum_store(sum, out, block);
    }
}

static void write_sky(const float *weights, radiometry_record frame, global const float *spectra,
                      global float *out)
{
    const uint row = frame.sample_count, directions = frame.zenith_count * frame.azimuth_count;
    global const float *sky = spectra + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * row;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        spectrum sum = (spectrum)0.0f;
        for (uint d = 0; d < directions; d++)
            if (weights[d] != 0.0f) sum += weights[d] * spectrum_load(sky + (size_t)d * row, block);
        spectrum_store(sum, out, block);
    }
}

/* Radiance that reaches every pixel's surface, weighted for its reflection: each ray of the
 * hemisphere brings the facet that it met (its own temperature, emissivity at the ray's angle, sun
 * and share of the sky) or the sky of its direction; a mirror has one ray. Exact counterpart of the
 * background in eq. 2.4-1 and 2.4-2.
 * Launch: (frame.pixel_count).
 * cell: (cell_count, 4), met: (cell_count, pixel_count), see hemisphere.cl; dome: (dome_count, 8)
 * facets, temperature_k, facet_background: per facet, the ground's behind the real ones
 * hit, background, background_lit: per pixel; the last two are read for mirrors
 * spectra, emissivity: as radiometry.cl
 * out: (pixel_count, 2, sample_count), W m-2 sr-1 um-1: of the sky, and of facets and ground */
kernel void incident(const radiometry_record frame, const camera_record camera,
                     const uint cell_count, const uint dome_count, global const float *cell,
                     global const float *dome, global const facet_record *facets,
                     global const material_record *materials, global const float *temperature_k,
                     global const background_record *facet_background, global const hit_record *hit,
                     global const background_record *background, global const float *background_lit,
                     global const uint *met, global const float *spectra,
                     global const float *emissivity, global float *out)
{
    const uint pixel = get_global_id(0);
    if (pixel >= frame.pixel_count) return;
    const hit_record at = hit[pixel];
    if (at.facet == RECORD_NONE) return;

    const around from = {facets, materials, temperature_k, facet_background};
    const background_record mirrored = background[pixel];
    const uint kind = pixel_interaction(materials[facets[at.facet].material], mirrored);
    const uint rays = kind == INTERACTION_DIFFUSE ? cell_count : 0u;
    const diffuse_view view = look_around(at.normal, rays, cell, met + pixel, frame.pixel_count);
    global float *from_sky = out + (size_t)pixel * 2u * frame.sample_count;
    global float *from_facets = from_sky + frame.sample_count;
    float weights[INCIDENT_DIRECTIONS], direction[3];
    incident_facet seen[ROUND];
    uint count = 0;

    for (uint d = 0; d < frame.zenith_count * frame.azimuth_count; d++) weights[d] = 0.0f;
    if (kind == INTERACTION_DIFFUSE) {
        count_sky(weights, frame, at.normal, view, cell_count, cell, met + pixel, frame.pixel_count,
                  dome_count, dome);
    } else {
        float ray[3];
        pixel_ray(camera, frame.columns, frame.first_pixel + pixel, ray);
        for (int k = 0; k < 3; k++)
            direction[k] = ray[k] - 2.0f * pixel_dot(ray, at.normal) * at.normal[k];
        if (kind == INTERACTION_SPECULAR_SKY)
            incident_add_sky(weights, frame,
                             sky_find(frame, direction[0], direction[1], direction[2]), 1.0f);
        else
            seen[count++] =
                see_facet(from, frame, mirrored.facet, 1.0f, background_lit[pixel], direction);
    }
    write_sky(weights, frame, spectra, from_sky);
    for (uint k = 0; k < frame.sample_count; k++) from_facets[k] = 0.0f;
    for (uint c = 0; c < rays; c++) {
        const uint word = met[(size_t)c * frame.pixel_count + pixel];
        if (word == RECORD_NONE) continue;
        const float weight = cell_direction(&view.axes, cell, c, direction);
        seen[count++] = see_facet(from, frame, word & ~HEMISPHERE_LIT,
                                  weight * (direction[2] > 0.0f ? view.above : view.below),
                                  word & HEMISPHERE_LIT ? 1.0f : 0.0f, direction);
        if (count < ROUND) continue;
        add_facets(seen, count, frame, spectra, emissivity, from_facets);
        count = 0;
    }
    if (count > 0) add_facets(seen, count, frame, spectra, emissivity, from_facets);
}
