#include "gloss.h"
#include "sky_weights.h"

/* Cells whose facets are held at once. */
#define ROUND 16u

/* The directions of a ring that count for any lane.
 *   out_used   their rows of the weights; returns how many they are */
static uint list_used(const lanes *weights, uint directions, ushort *out_used)
{
    uint count = 0;

    for (uint d = 0; d < directions; d++) {
        out_used[count] = (ushort)d;
        count += lanes_any(weights[d] != 0.0f);
    }
    return count;
}

/* Adds the sky's radiance in a ring to all lanes.
 *   weight   shape (directions, LANES_WIDTH) */
static void add_ring(const float *weight, const ushort *used, uint used_count, uint row_length,
                     global const float *sky, uint block, spectrum sum[LANES_WIDTH])
{
    for (uint u = 0; u < used_count; u++) {
        const float *of_lane = weight + used[u] * LANES_WIDTH;
        const spectrum radiance = spectrum_load(sky + (size_t)used[u] * row_length, block);
        UNROLL
        for (uint i = 0; i < LANES_WIDTH; i++) sum[i] += of_lane[i] * radiance;
    }
}

/* Writes the sky's radiance by the weights of its directions. */
static void write_sky(const lanes *weights, radiometry_record frame, const incident_group *g,
                      uint ring_count, global const float *spectra, global const float *emissivity,
                      global float *out)
{
    const uint row = frame.sample_count, directions = frame.zenith_count * frame.azimuth_count;
    global const float *sky = spectra + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * row;
    ushort used[INCIDENT_WEIGHTS];

    for (uint i = 0; i < g->lane_count; i++)
        for (uint k = 0; k < row; k++) out[i * 2u * row + k] = 0.0f;
    for (uint r = 0; r < ring_count; r++) {
        const lanes *of_ring = weights + r * directions;
        const uint used_count = list_used(of_ring, directions, used);
        for (uint block = 0; block < row / SPECTRUM_WIDTH && used_count > 0; block++) {
            spectrum sum[LANES_WIDTH];
            UNROLL
            for (uint i = 0; i < LANES_WIDTH; i++) sum[i] = (spectrum)0.0f;
            add_ring((const float *)of_ring, used, used_count, row, sky, block, sum);
            for (uint i = 0; i < g->lane_count; i++) {
                global float *to = out + (size_t)i * 2u * row;
                spectrum_store(spectrum_load(to, block) +
                                   sum[i] * lobe_of_ring(emissivity, row, g->lobe[i], r, block),
                               to, block);
            }
        }
    }
}

/* Adds what `count` facets send to every sample of a pixel.
 *   lobe, ring   of the pixel's surface, and where the facets stand in it */
static void add_facets(const incident_facet *facets, uint count, around from,
                       radiometry_record frame, global const float *spectra,
                       global const float *emissivity, uint lobe, uint ring, global float *out)
{
    const uint row = frame.sample_count;

    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum first = spectrum_load(spectra + SPECTRA_PLANCK_FIRST * row, block);
        const spectrum second = spectrum_load(spectra + SPECTRA_PLANCK_SECOND * row, block);
        const spectrum sun = spectrum_load(spectra + SPECTRA_SUN * row, block);
        const spectrum sky = spectrum_load(spectra + SPECTRA_SKY * row, block);
        spectrum sum = (spectrum)0.0f;
        for (uint i = 0; i < count; i++)
            sum += facets[i].weight *
                   incident_radiance(&facets[i],
                                     lookup_spectrum(emissivity, row, facets[i].emissivity, block),
                                     planck_radiance(first, second, facets[i].temperature_k), sun,
                                     sky, light_of(from, facets[i].facet, block));
        sum = spectrum_load(out, block) + sum * lobe_of_ring(emissivity, row, lobe, ring, block);
        spectrum_store(sum, out, block);
    }
}

/* Facets that the lanes see through the cells of a round. */
typedef struct incident_round {
    incident_facet seen[LANES_WIDTH][ROUND];
    uint count[LANES_WIDTH];
} incident_round;

/* Adds the facets that the lanes see through a cell. */
static void see_cell(incident_round *round, const incident_group *g, around from,
                     radiometry_record frame, incident_cells cells, uint c)
{
    const lanes_bits word =
        lanes_load_bits(cells.met + (size_t)c * frame.pixel_count, g->first, frame.pixel_count);
    const uint met = g->diffuse & lanes_bits_of(word != RECORD_NONE);
    lanes direction[3], cosine = (lanes)1.0f;

    if (!met) return;
    hemisphere_lanes_direction(&g->view.axes, cells.cell + 4u * c, direction);
    const lanes weight =
        cells.cell[4u * c + 3u] * (direction[2] > 0.0f ? g->view.above : g->view.below);
    for (uint left = met; left; left &= left - 1u) {
        const uint i = 31u - clz(left & -left), facet = ((const uint *)&word)[i];
        const float along[3] = {lane_of(&direction[0], i), lane_of(&direction[1], i),
                                lane_of(&direction[2], i)};
        float lane_cosine;
        round->seen[i][round->count[i]] =
            see_face(from, frame, facet & ~HEMISPHERE_LIT, lane_of(&weight, i),
                     facet & HEMISPHERE_LIT ? 1.0f : 0.0f, along, &lane_cosine);
        LANES_SET(cosine, i, lane_cosine);
    }
    const lanes angle_deg = acos(fmin(cosine, 1.0f)) * (180.0f / PI_F);
    for (uint left = met; left; left &= left - 1u) {
        const uint i = 31u - clz(left & -left);
        incident_facet *seen = &round->seen[i][round->count[i]++];
        seen->emissivity = lookup_emissivity(from.materials[from.facets[seen->facet].material],
                                             lane_of(&angle_deg, i), 0u);
    }
}

/* Adds what the facets around diffuse pixels send. */
static void add_cells(const incident_group *g, around from, radiometry_record frame,
                      incident_cells cells, global const float *spectra,
                      global const float *emissivity, global float *out)
{
    const uint of_ring = cells.count / cells.ring_count;
    incident_round round;

    for (uint first = 0, end; first < cells.count; first = end) {
        const uint ring = ring_of_cell(cells, first);
        end = min(first + ROUND, (ring + 1u) * of_ring);
        for (uint i = 0; i < LANES_WIDTH; i++) round.count[i] = 0;
        for (uint c = first; c < end; c++) see_cell(&round, g, from, frame, cells, c);
        for (uint i = 0; i < LANES_WIDTH; i++)
            if (round.count[i] > 0)
                add_facets(round.seen[i], round.count[i], from, frame, spectra, emissivity,
                           g->lobe[i], ring, out + 2u * i * frame.sample_count);
    }
}

/* Divides what reaches a surface by the sum of its lobe's weights.
 *   out   of this lane: of the sky, and of facets and ground */
static void divide_by_lobe(const incident_group *g, uint lane, uint ring_count, uint row,
                           global const float *emissivity, global float *out)
{
    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum sum =
            lobe_sum(&g->view, lane, ring_count, emissivity, row, g->lobe[lane], block);
        for (uint part = 0; part < 2u; part++)
            spectrum_store(spectrum_load(out + part * row, block) / sum, out + part * row, block);
    }
}

/* Takes pixels `first` and following; what their rays met is looked at by `look_around`. */
static incident_group take_group(uint first, radiometry_record frame, around from,
                                 incident_cells cells, global const hit_record *hit)
{
    incident_group g = {.first = first};
    lanes normal[3] = {(lanes)0.0f, (lanes)0.0f, (lanes)1.0f};

    g.lane_count = min((uint)LANES_WIDTH, frame.pixel_count - first);
    for (uint i = 0; i < LANES_WIDTH; i++) {
        g.specular[i] = 0.0f;
        g.lobe[i] = RECORD_NONE;
        if (i >= g.lane_count || hit[first + i].facet == RECORD_NONE) continue;
        const uint material = from.facets[hit[first + i].facet].material;
        if (!from.how.is_of_facets) g.specular[i] = from.materials[material].specular_share;
        for (int k = 0; k < 3; k++) LANES_SET(normal[k], i, hit[first + i].normal[k]);
        if (g.specular[i] == 1.0f) continue;
        g.diffuse |= 1u << i;
        g.lobe[i] = from.materials[material].lobe_first;
    }
    if (!g.diffuse) cells.count = 0u;
    g.view = look_around(normal, cells, first, frame.pixel_count);
    return g;
}

/* Multiplies the radiance of a lane by a share.
 *   out   of this lane: of the sky, and of facets and ground */
static void keep_share(float share, uint row, global float *out)
{
    for (uint k = 0; k < 2u * row; k++) out[k] *= share;
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
            add_facets(&seen, 1u, from, frame, spectra, emissivity, RECORD_NONE, 0u, out + row);
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
 * Launch: (frame.pixel_count / LANES_WIDTH, rounded up).
 * cell: (how.cell_count, 4), met: (how.cell_count, pixel_count), see hemisphere.cl
 * dome: (how.dome_count, 8), see sky_weights.h
 * facets, temperature_k, facet_background: per facet, the ground's behind the real ones
 * light: see surroundings.h
 * hit, background, background_lit: per pixel; the last two are read for mirrors, not of facets
 * gloss_words: (LOBE_RAYS, pixel_count), see gloss.cl; NULL where nothing is rough
 * spectra, emissivity: as radiometry.cl
 * out: (pixel_count, 2, sample_count), W m-2 sr-1 um-1: of the sky, and of facets and ground */
kernel void incident(const radiometry_record frame, const camera_record camera,
                     const incident_record how, global const float *cell, global const float *dome,
                     global const facet_record *facets, global const material_record *materials,
                     global const float *temperature_k,
                     global const background_record *facet_background, global const float *light,
                     global const hit_record *hit, global const background_record *background,
                     global const float *background_lit, global const uint *met,
                     global const uint *gloss_words, global const float *spectra,
                     global const float *emissivity, global float *out)
{
    const uint first = get_global_id(0) * LANES_WIDTH;
    if (first >= frame.pixel_count) return;
    const around from = {facets, materials, temperature_k, facet_background, light, how};
    const incident_cells cells = {how.cell_count, how.ring_count, cell, met};
    const incident_group g = take_group(first, frame, from, cells, hit);
    const uint row = frame.sample_count;
    global float *from_sky = out + (size_t)first * 2u * row;
    lanes weights[INCIDENT_WEIGHTS];

    sky_weigh(weights, frame, &g, cells, how.dome_count, dome);
    write_sky(weights, frame, &g, how.ring_count, spectra, emissivity, from_sky);
    for (uint i = 0; i < g.lane_count; i++)
        for (uint k = 0; k < row; k++) from_sky[(2u * i + 1u) * row + k] = 0.0f;
    if (g.diffuse) add_cells(&g, from, frame, cells, spectra, emissivity, from_sky + row);
    for (uint i = 0; i < g.lane_count; i++) {
        global float *own = from_sky + 2u * i * row;
        if (g.lobe[i] != RECORD_NONE) divide_by_lobe(&g, i, how.ring_count, row, emissivity, own);
        if (g.specular[i] == 0.0f) continue;
        const hit_record at = hit[first + i];
        const background_record mirrored = background[first + i];
        keep_share(1.0f - g.specular[i], row, own);
        add_gloss(from, frame, camera, first + i, &at, &mirrored, background_lit[first + i],
                  gloss_words, spectra, emissivity, own);
    }
}
