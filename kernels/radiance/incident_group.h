/* Incident group: neighbouring pixels that are looked at together, and which of them are alike. Device
 * only. */
#ifndef INCIDENT_GROUP_H
#define INCIDENT_GROUP_H

#include "kernels/hemisphere/near_rest.h"
#include "kernels/radiance/incident_hemisphere.h"

/* Cells of the hemisphere that are looked at together, and blocks of samples that are summed side by side
 * where there are as many: rows of tables lie apart by powers of 2, and one block of all would crowd
 * each other out of a CPU's caches. A GPU's work-items have little memory. */
#define ROUND (RAY_LANES == 16 ? 72u : 16u)
#define SIDE (RAY_LANES == 16 ? 4u : 1u)

/* What all that arrives is read from; see incident.cl. */
typedef struct incident_tables {
    radiometry_record frame;
    incident_record params;
    emitter_tables emitters;
    incident_cells cells;
    spectra_tables spectra;
    global const float *dome;
} incident_tables;

/* Such cells: from `first` to before `end`. */
typedef struct incident_part {
    uint first, end;
} incident_part;

/* Facets near the lanes that their rays brought too little of, near_facets.cl; incident_near.h. */
typedef struct incident_near {
    near_rays rays;
    lanes_bits ring[NEAR_FACETS]; /* of the lobes, that each lies in */
    lanes rest[2];            /* what rays beside near facets count, below and above the horizon, */
    lanes sky[2];             /* and what of them is sky */
    lanes change[LOBE_RINGS]; /* of the weights of diffuse lobes' rings */
} incident_near;

/* LANES_WIDTH neighbouring pixels. */
typedef struct incident_group {
    uint first, lane_count;
    uint point[LANES_WIDTH];     /* which pixel each is */
    uint diffuse;                /* a bit per lane that is, wholly or partly */
    float specular[LANES_WIDTH]; /* share */
    uint lobe[LANES_WIDTH];      /* first row of the diffuse lobe, RECORD_NONE: Lambertian */
    uint column_count;
    uint column[LANES_WIDTH]; /* a bit per diffuse lane: those with one normal, set and lobe */
    diffuse_view view;
    incident_near near;
} incident_group;

/* The first lane of some. */
static inline uint incident_first_of(uint bits)
{
    return 31u - clz(bits & -bits);
}

/* Finds which diffuse lanes have equal normals, sets of directions and lobes. */
static inline void incident_find_columns(incident_group *g)
{
    const lanes *normal = g->view.axes.normal;
    const lanes_bits set = g->view.sets.first;

    g->column_count = 0u;
    for (uint left = g->diffuse, same; left; left &= ~same) {
        const uint lane = incident_first_of(left);
        same = left & lanes_bits_of((normal[0] == lane_of(&normal[0], lane)) &
                                    (normal[1] == lane_of(&normal[1], lane)) &
                                    (normal[2] == lane_of(&normal[2], lane)) &
                                    (set == ((const uint *)&set)[lane]));
        for (uint i = 0; i < LANES_WIDTH; i++) same &= ~((uint)(g->lobe[i] != g->lobe[lane]) << i);
        g->column[g->column_count++] = same;
    }
}

/* Takes pixels from place `first` on, and looks at what their rays met. */
static inline incident_group incident_take_group(uint first, const incident_tables *t,
                                                 const hemisphere_tables *rays)
{
    const surface_tables *surfaces = &t->emitters.surfaces;
    global const hit_record *hit = rays->hit;
    incident_group g = {.first = first};
    incident_cells cells = t->cells;
    lanes normal[3] = {(lanes)0.0f, (lanes)0.0f, (lanes)1.0f};

    g.lane_count = min((uint)LANES_WIDTH, t->frame.pixel_count - first);
    for (uint i = 0; i < LANES_WIDTH; i++) {
        g.specular[i] = 0.0f;
        g.lobe[i] = RECORD_NONE;
        if (i < g.lane_count) g.point[i] = hemisphere_point(rays->order, first + i);
        if (i >= g.lane_count || hit[first + i].facet == RECORD_NONE) continue;
        const uint material = surfaces->facets[hit[first + i].facet].material;
        if (!t->params.is_of_facets) g.specular[i] = surfaces->materials[material].specular_share;
        for (int k = 0; k < 3; k++) LANES_SET(normal[k], i, hit[first + i].normal[k]);
        if (g.specular[i] == 1.0f) continue;
        g.diffuse |= 1u << i;
        g.lobe[i] = surfaces->materials[material].lobe_first;
    }
    if (!g.diffuse) cells.count = 0u;
    g.view = look_around(normal, cells, first, t->frame.pixel_count);
    incident_find_columns(&g);
    return g;
}

/* What the rings of a lane's hemisphere count in `side` blocks of samples: its lobe divided by the sum of
 * the lobe's weights. */
typedef struct incident_lobe {
    spectrum ring[LOBE_RINGS][SIDE];
} incident_lobe;

INLINE void incident_find_lobe(incident_lobe *out, const incident_group *g, uint lane,
                               const incident_tables *t, uint block, const uint side)
{
    const uint row = t->frame.sample_count, rings = t->cells.ring_count, lobe = g->lobe[lane];

    UNROLL
    for (uint b = 0; b < side; b++) {
        const spectrum scale =
            1.0f / lobe_sum(&g->view, lane, rings, t->spectra.emissivity, row, lobe, block + b);
        for (uint r = 0; r < rings; r++)
            out->ring[r][b] = scale * lobe_of_ring(t->spectra.emissivity, row, lobe, r, block + b);
    }
}

/* The rows of a lane's pixel.
 *   out   of pixel 0 */
static inline global float *incident_rows_of(const incident_group *g, uint lane,
                                             const incident_tables *t, global float *out)
{
    return out + (size_t)g->point[lane] * 2u * t->frame.sample_count;
}

/* Adds to a row of radiance; the first part begins it.
 *   share   that counts */
static inline void incident_add(spectrum radiance, float fraction, incident_part part,
                                global float *out, uint block)
{
    const spectrum before = part.first == 0u ? (spectrum)0.0f : spectrum_load(out, block);

    spectrum_store(fma((spectrum)fraction, radiance, before), out, block);
}

#endif
