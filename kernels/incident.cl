#include "gloss.h"
#include "sky_columns.h"

/* Cells whose facets are held at once. */
#define ROUND 16u

/* Writes the sky's radiance by the weights of its directions. */
static void write_sky(radiometry_record frame, const incident_group *g, incident_cells cells,
                      uint dome_count, global const float *dome, global const float *spectra,
                      global const float *emissivity, global float *out)
{
    const uint row = frame.sample_count, directions = frame.zenith_count * frame.azimuth_count;
    global const float *sky = spectra + (size_t)(SPECTRA_PATHS + 2u * frame.path_count) * row;
    float weight[INCIDENT_WEIGHTS * SKY_COLUMNS];
    uint lobe[SKY_COLUMNS];
    lanes weights[INCIDENT_WEIGHTS];
    spectrum sum[SKY_COLUMNS];
    sky_columns columns;

    sky_weigh(weights, frame, g, cells, dome_count, dome);
    sky_list_used(&columns, weights, cells.ring_count, directions);
    sky_find_columns(&columns, weights, g);
    for (uint first = 0; first < columns.count; first += SKY_COLUMNS) {
        sky_pack(&columns, weights, first, g, weight, lobe);
        for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
            sky_sum(&columns, weight, lobe, cells.ring_count, directions, sky, emissivity, row,
                    block, sum);
            for (uint i = 0; i < g->lane_count; i++) {
                const uint c = columns.of_lane[i] - first;
                if (c < SKY_COLUMNS) spectrum_store(sum[c], out + (size_t)i * 2u * row, block);
            }
        }
    }
}

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

/* A side of a facet, in the sun or not. */
typedef struct incident_face {
    facet_record facet;
    incident_facet seen; /* weight 1, without its emissivity */
    uint is_back;
} incident_face;

/* A ray that met a face. */
typedef struct incident_ray {
    uint face;
    float weight;
    lookup emissivity; /* at the ray's angle */
} incident_ray;

/* What the lanes see through the cells of a round. Neighbours see the same faces. */
typedef struct incident_round {
    incident_face face[LANES_WIDTH * ROUND];
    lanes_bits word[ROUND]; /* that the rays to a face bear, RECORD_NONE: free */
    uint face_count;
    incident_ray ray[LANES_WIDTH][ROUND];
    uint ray_count[LANES_WIDTH];
} incident_round;

static uint is_behind(const facet_record *facet, const float *direction)
{
    return pixel_dot(facet->normal, direction) > 0.0f;
}

static uint add_face(incident_round *round, around from, radiometry_record frame, uint word,
                     const float *direction)
{
    const uint k = round->face_count++, facet = word & ~HEMISPHERE_LIT;
    incident_face *face = &round->face[k];
    float cosine;

    if (k % LANES_WIDTH == 0u) round->word[k / LANES_WIDTH] = (lanes_bits)RECORD_NONE;
    ((uint *)round->word)[k] = word;
    face->facet = from.facets[facet];
    face->is_back = is_behind(&face->facet, direction);
    face->seen =
        see_face(from, frame, facet, 1.0f, word & HEMISPHERE_LIT ? 1.0f : 0.0f, direction, &cosine);
    return k;
}

/* The face that a ray met, added to the round where it is new. */
static uint take_face(incident_round *round, around from, radiometry_record frame, uint word,
                      const float *direction)
{
    for (uint first = 0; first < round->face_count; first += LANES_WIDTH) {
        uint same = lanes_bits_of(round->word[first / LANES_WIDTH] == word);
        for (; same; same &= same - 1u) {
            const uint k = first + 31u - clz(same & -same);
            if (is_behind(&round->face[k].facet, direction) == round->face[k].is_back) return k;
        }
    }
    return add_face(round, from, frame, word, direction);
}

/* Sends the rays of the lanes whose bits are set to a face. */
static void send_rays(incident_round *round, uint bits, uint face, const lanes *weight)
{
    for (; bits; bits &= bits - 1u) {
        const uint i = 31u - clz(bits & -bits);
        incident_ray *ray = &round->ray[i][round->ray_count[i]];
        ray->face = face;
        ray->weight = lane_of(weight, i);
    }
}

/* Finds the emissivity that the last rays of the lanes meet, and counts them. */
static void end_rays(incident_round *round, around from, uint bits, lanes cosine)
{
    const lanes angle_deg = acos(fmin(cosine, 1.0f)) * (180.0f / PI_F);

    for (; bits; bits &= bits - 1u) {
        const uint i = 31u - clz(bits & -bits);
        incident_ray *ray = &round->ray[i][round->ray_count[i]++];
        ray->emissivity = lookup_emissivity(from.materials[round->face[ray->face].facet.material],
                                            lane_of(&angle_deg, i), 0u);
    }
}

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
    for (uint left = met, those; left; left &= ~those) {
        const uint i = 31u - clz(left & -left), met_word = ((const uint *)&word)[i];
        const float along[3] = {lane_of(&direction[0], i), lane_of(&direction[1], i),
                                lane_of(&direction[2], i)};
        const uint k = take_face(round, from, frame, met_word, along);
        const incident_face *face = &round->face[k];
        const lanes towards = face->facet.normal[0] * direction[0] +
                              face->facet.normal[1] * direction[1] +
                              face->facet.normal[2] * direction[2];
        const uint behind = lanes_bits_of(towards > 0.0f);
        those = left & lanes_bits_of(word == met_word) & (face->is_back ? behind : ~behind);
        those |= left & -left;
        cosine = word == met_word ? fabs(towards) : cosine;
        send_rays(round, those, k, &weight);
    }
    end_rays(round, from, met, cosine);
}

/* What reaches a face, and how much more it emits as a black body, in a block of samples. */
typedef struct face_light {
    spectrum arriving, more;
} face_light;

static void light_faces(const incident_round *round, around from, uint row,
                        global const float *spectra, uint block, face_light *out)
{
    const spectrum first = spectrum_load(spectra + SPECTRA_PLANCK_FIRST * row, block);
    const spectrum second = spectrum_load(spectra + SPECTRA_PLANCK_SECOND * row, block);
    const spectrum sun = spectrum_load(spectra + SPECTRA_SUN * row, block);
    const spectrum sky = spectrum_load(spectra + SPECTRA_SKY * row, block);

    for (uint k = 0; k < round->face_count; k++) {
        const incident_facet *seen = &round->face[k].seen;
        const spectrum black_body = planck_radiance(first, second, seen->temperature_k);
        out[k].arriving =
            incident_arriving(seen, black_body, sun, sky, light_of(from, seen->facet, block));
        out[k].more = black_body - out[k].arriving;
    }
}

/* Adds what the faces of a round send to every sample of the lanes.
 *   ring   that the round's cells lie in */
static void add_round(const incident_round *round, const incident_group *g, around from, uint row,
                      uint ring, global const float *spectra, global const float *emissivity,
                      global float *out)
{
    face_light light[LANES_WIDTH * ROUND];

    for (uint block = 0; block < row / SPECTRUM_WIDTH && round->face_count > 0u; block++) {
        light_faces(round, from, row, spectra, block, light);
        for (uint i = 0; i < LANES_WIDTH; i++) {
            global float *to = out + (size_t)i * 2u * row;
            spectrum sum = (spectrum)0.0f;
            if (round->ray_count[i] == 0u) continue;
            for (uint n = 0; n < round->ray_count[i]; n++) {
                const incident_ray *ray = &round->ray[i][n];
                const face_light *of_face = &light[ray->face];
                const spectrum own = lookup_spectrum(emissivity, row, ray->emissivity, block);
                sum = fma((spectrum)ray->weight, fma(own, of_face->more, of_face->arriving), sum);
            }
            sum *= lobe_of_ring(emissivity, row, g->lobe[i], ring, block);
            spectrum_store(spectrum_load(to, block) + sum, to, block);
        }
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
        round.face_count = 0u;
        for (uint i = 0; i < LANES_WIDTH; i++) round.ray_count[i] = 0u;
        for (uint c = first; c < end; c++) see_cell(&round, g, from, frame, cells, c);
        add_round(&round, g, from, frame.sample_count, ring, spectra, emissivity, out);
    }
}

/* Divides what reaches a surface by the sum of its lobe's weights.
 *   first_part   1: of facets and ground alone
 *   out          of this lane: of the sky, and of facets and ground */
static void divide_by_lobe(const incident_group *g, uint lane, uint ring_count, uint first_part,
                           uint row, global const float *emissivity, global float *out)
{
    for (uint block = 0; block < row / SPECTRUM_WIDTH; block++) {
        const spectrum sum =
            lobe_sum(&g->view, lane, ring_count, emissivity, row, g->lobe[lane], block);
        for (uint part = first_part; part < 2u; part++)
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

    if (!how.keeps_sky)
        write_sky(frame, &g, cells, how.dome_count, dome, spectra, emissivity, from_sky);
    for (uint i = 0; i < g.lane_count; i++)
        for (uint k = 0; k < row; k++) from_sky[(2u * i + 1u) * row + k] = 0.0f;
    if (g.diffuse) add_cells(&g, from, frame, cells, spectra, emissivity, from_sky + row);
    for (uint i = 0; i < g.lane_count; i++) {
        global float *own = from_sky + 2u * i * row;
        if (g.lobe[i] != RECORD_NONE)
            divide_by_lobe(&g, i, how.ring_count, how.keeps_sky, row, emissivity, own);
        if (g.specular[i] == 0.0f) continue;
        const hit_record at = hit[first + i];
        const background_record mirrored = background[first + i];
        keep_share(1.0f - g.specular[i], row, own);
        add_gloss(from, frame, camera, first + i, &at, &mirrored, background_lit[first + i],
                  gloss_words, spectra, emissivity, own);
    }
}
