/* Incident faces: sides of facets that neighbouring pixels see, each once, and what they send. Device
 * only. */
#ifndef INCIDENT_FACES_H
#define INCIDENT_FACES_H

#include "kernels/radiance/incident_rays.h"

/* Places where a face may be found, a power of 2. */
#define FACE_SLOTS (RAY_LANES == 16 ? 2048u : 32u)

/* A side of a facet, in the sun or not. */
typedef struct incident_face {
    uint word; /* that the rays to it bear */
    uint is_back;
    incident_facet seen; /* weight 1, without its emissivity */
    uint material;
} incident_face;

/* Those that the lanes see through the cells of a part. Neighbours see the same. */
typedef struct incident_faces {
    incident_part part;
    incident_face face[LANES_WIDTH * ROUND];
    uint count;
    ushort slot[FACE_SLOTS]; /* face + 1; 0: none */
} incident_faces;

static inline uint incident_add_face(incident_faces *faces, const incident_tables *t, uint word,
                                     uint is_back)
{
    const uint facet = word & ~HEMISPHERE_LIT;
    const float lit = word & HEMISPHERE_LIT ? 1.0f : 0.0f;

    faces->face[faces->count] =
        (incident_face){.word = word,
                        .is_back = is_back,
                        .seen = see_face(&t->emitters, t->frame, facet, 1.0f, lit, is_back),
                        .material = t->emitters.surfaces.facets[facet].material};
    return faces->count++;
}

/* The face that a ray met, added where it is new. */
static inline uint incident_take_face(incident_faces *faces, const incident_tables *t, uint word,
                                      uint is_back)
{
    const uint golden = 2654435769u; /* 2^32 (sqrt(5) - 1) / 2 */
    uint slot = (word + is_back) * golden / (0xffffffffu / FACE_SLOTS + 1u);

    for (; faces->slot[slot]; slot = (slot + 1u) % FACE_SLOTS) {
        const uint k = faces->slot[slot] - 1u;
        if (faces->face[k].word == word && faces->face[k].is_back == is_back) return k;
    }
    const uint k = incident_add_face(faces, t, word, is_back);
    faces->slot[slot] = (ushort)(k + 1u);
    return k;
}

/* Adds the faces that the lanes see through a cell. */
static inline void incident_see_faces(incident_faces *faces, incident_rays *rays,
                                      const incident_group *g, const incident_tables *t, uint c)
{
    const incident_view view = incident_look(g, t, c);
    incident_aim aim;
    lanes cosine = (lanes)1.0f;

    if (!view.met) return;
    for (uint left = view.met, those; left; left &= ~those) {
        const uint i = incident_first_of(left), word = ((const uint *)&view.word)[i];
        global const float *normal = t->emitters.surfaces.facets[word & ~HEMISPHERE_LIT].normal;
        const lanes towards = normal[0] * view.direction[0] + normal[1] * view.direction[1] +
                              normal[2] * view.direction[2];
        const uint behind = lanes_bits_of(towards > 0.0f), is_back = behind >> i & 1u;
        const uint k = incident_take_face(faces, t, word, is_back);
        those = left & lanes_bits_of(view.word == word) & (is_back ? behind : ~behind);
        cosine = view.word == word ? fabs(towards) : cosine;
        for (uint bits = those; bits; bits &= bits - 1u) {
            const uint lane = incident_first_of(bits);
            aim.target[lane] = k;
            aim.material[lane] = faces->face[k].material;
        }
    }
    incident_add_rays(rays, &view, &aim, t, cosine);
}

/* What reaches a face, and how much more it emits as a black body, in blocks of samples. */
typedef struct face_light {
    spectrum arriving[SIDE], more[SIDE];
} face_light;

static inline void incident_light_faces(const incident_faces *faces, const incident_tables *t,
                                        uint block, uint b, face_light *out)
{
    const uint row = t->frame.sample_count;
    const spectrum first = spectrum_load(t->spectra.rows + SPECTRA_PLANCK_FIRST * row, block);
    const spectrum second = spectrum_load(t->spectra.rows + SPECTRA_PLANCK_SECOND * row, block);
    const spectrum sun = spectrum_load(t->spectra.rows + SPECTRA_SUN * row, block);
    const spectrum sky = spectrum_load(t->spectra.rows + SPECTRA_SKY * row, block);

    for (uint k = 0; k < faces->count; k++) {
        const incident_facet *seen = &faces->face[k].seen;
        const spectrum black_body = planck_radiance(first, second, seen->temperature_k);
        const spectrum arriving = incident_arriving(seen, black_body, sun, sky,
                                                    light_of(&t->emitters, seen->facet, block));
        out[k].arriving[b] = arriving;
        out[k].more[b] = black_body - arriving;
    }
}

/* What the faces send to a lane in `side` blocks of samples. */
INLINE void incident_from_faces(const incident_rays *rays, uint lane, const face_light *light,
                                const incident_lobe *lobe, const incident_tables *t, uint block,
                                const uint side, spectrum *out)
{
    const uint row = t->frame.sample_count;
    uint n = 0;

    UNROLL
    for (uint b = 0; b < side; b++) out[b] = (spectrum)0.0f;
    for (uint r = 0; n < rays->count[lane]; r++) {
        spectrum sum[SIDE];
        UNROLL
        for (uint b = 0; b < side; b++) sum[b] = (spectrum)0.0f;
        for (; n < rays->ring_end[r][lane]; n++) {
            const incident_ray ray = rays->ray[lane][n];
            const face_light *from = &light[ray.target];
            UNROLL
            for (uint b = 0; b < side; b++) {
                const spectrum own =
                    lookup_spectrum(t->spectra.emissivity, row, ray.emissivity, block + b);
                sum[b] =
                    fma((spectrum)ray.weight, fma(own, from->more[b], from->arriving[b]), sum[b]);
            }
        }
        UNROLL
        for (uint b = 0; b < side; b++) out[b] = fma(lobe->ring[r][b], sum[b], out[b]);
    }
}

/* Adds what the faces send to `side` blocks of samples of the lanes. */
INLINE void incident_add_blocks(const incident_faces *faces, const incident_rays *rays,
                                const incident_group *g, const incident_tables *t,
                                face_light *light, uint block, const uint side, global float *out)
{
    incident_lobe lobe;
    spectrum sum[SIDE];

    for (uint b = 0; b < side; b++) incident_light_faces(faces, t, block + b, b, light);
    for (uint k = 0; k < g->column_count; k++) {
        incident_find_lobe(&lobe, g, incident_first_of(g->column[k]), t, block, side);
        for (uint bits = g->column[k]; bits; bits &= bits - 1u) {
            const uint i = incident_first_of(bits);
            global float *to = incident_rows_of(g, i, t, out);
            incident_from_faces(rays, i, light, &lobe, t, block, side, sum);
            UNROLL
            for (uint b = 0; b < side; b++)
                incident_add(sum[b], 1.0f - g->specular[i], faces->part, to, block + b);
        }
    }
}

/* Adds what pixels get of the facets that they see through the cells of a part.
 *   out   of pixel 0 */
static inline void incident_add_faces(const incident_group *g, const incident_tables *t,
                                      incident_part part, global float *out)
{
    const uint blocks = t->frame.sample_count / SPECTRUM_WIDTH;
    incident_faces faces;
    incident_rays rays;
    face_light light[LANES_WIDTH * ROUND];
    uint block = 0;

    incident_clear_rays(&rays);
    faces.part = part;
    faces.count = 0u;
    for (uint k = 0; k < FACE_SLOTS; k++) faces.slot[k] = 0u;
    for (uint c = part.first; c < part.end; c++) {
        incident_see_faces(&faces, &rays, g, t, c);
        incident_end_cell(&rays, c < t->cells.count ? ring_of_cell(t->cells, c)
                                                    : (c - t->cells.count) / g->near.rays.rows);
    }
    for (; block + SIDE <= blocks; block += SIDE)
        incident_add_blocks(&faces, &rays, g, t, light, block, SIDE, out);
    for (; block < blocks; block++) incident_add_blocks(&faces, &rays, g, t, light, block, 1u, out);
}

#endif
