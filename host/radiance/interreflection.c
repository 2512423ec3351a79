#include "radiance/interreflection.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

/* Few, so that light goes on only where it matters; many, so that launches take longer than it takes to
 * make them. */
enum { CHUNK = 1 << 10 };

/* The tail needs five depths behind the first, which closes the series. */
enum { TAIL_DEPTHS = 6 };

/* Facets that pass light on together. */
typedef struct chunk {
    uint32_t first;
    uint32_t last_depth; /* the last at which they do */
    shape_factor_points points;
    float_buffer arriving; /* what reaches them: (count, 2, spectra.sample_count) */
    float_buffer kept;     /* and did two and four depths before, the same; empty: not asked for */
} chunk;

struct interreflection {
    interreflection_scene from;
    interreflection_spectra spectra;
    uint32_t depth;
    light_tables light; /* light_length: spectra.sample_count */
    uint32_t chunk_count;
    chunk *chunks;
    float sun[3]; /* that the rays were cast for */
    bool is_lit;
};

static device *device_of(const interreflection *f)
{
    return ray_scene_device(f->from.scene);
}

/* Facets with the ground's. */
static size_t count_all(const interreflection *f)
{
    return (size_t)f->from.shape->facet_count + 1;
}

/* The middle of a facet, as a hit from its front; a little beside it, or rays would run into the edges
 * of symmetric rooms, where the sun shines in. */
static hit_record middle(const geometry *g, uint32_t facet)
{
    static const float weight[2][4] = {{.36f, .33f, .31f, 0.0f}, {.27f, .24f, .26f, .23f}};
    const int corners = g->corner[facet][3] == UINT32_MAX ? 3 : 4;
    hit_record hit = {.facet = g->area_m2[facet] > 0.0f ? facet : RECORD_NONE};

    for (int k = 0; k < 3; k++) {
        for (int c = 0; c < corners; c++)
            hit.point[k] += weight[corners - 3][c] * g->position[g->corner[facet][c]][k];
        hit.normal[k] = g->normal[facet][k];
    }
    return hit;
}

static status open_chunk(const interreflection *f, chunk *c, uint32_t first, uint32_t count)
{
    status rc = STATUS_OK;
    const uint32_t cells = hemisphere_grid_cell_count(f->from.grid);
    hit_record *hits = malloc(count * sizeof *hits);

    *c = (chunk){.first = first, .last_depth = 1, .points.count = count};
    NEED(hits, STATUS_MEMORY, "no memory for %u facets", count);
    for (uint32_t i = 0; i < count; i++) hits[i] = middle(f->from.shape, first + i);
    TRY(device_allocate(device_of(f), &c->points.hit, count, hits));
    TRY(device_allocate(device_of(f), &c->points.met, (size_t)count * cells, NULL));
out:
    free(hits);
    return rc;
}

static void free_chunk(chunk *c)
{
    device_release(c->kept);
    device_release(c->arriving);
    device_release(c->points.met);
    device_release(c->points.hit);
}

static status cast_rays(const interreflection *f, const chunk *c,
                        background_record_buffer background)
{
    return shape_factor_run(f->from.grid, f->from.scene, &f->from.surfaces, f->sun, &c->points,
                            background);
}

/* Keeps the last chunk where a facet of it passes light on: what it reflects of the fraction of its hemisphere
 * that facets fill.
 *   reach   shape (facet_count): set to that */
static status sort_chunk(interreflection *f, chunk *c, const background_record *records,
                         const float *reflectance, uint32_t wanted, float *reach)
{
    status rc = STATUS_OK;
    const double rest = wanted > 0 ? 0.0 : INTERREFLECTION_REST;
    bool passes = false;

    for (uint32_t i = c->first; i < c->first + c->points.count; i++) {
        reach[i] = reflectance[i] * (1.0f - records[i].shape_factor);
        passes = passes || (double)reach[i] > rest;
    }
    if (!passes || wanted == 1) {
        free_chunk(c);
        f->chunk_count--;
        goto out;
    }
    TRY(device_allocate(device_of(f), &c->arriving,
                        (size_t)c->points.count * 2 * f->spectra.sample_count, NULL));
out:
    return rc;
}

/* Casts the rays of all facets; keeps those that pass light on. */
static status look_around(interreflection *f, const float *reflectance, uint32_t wanted,
                          float *reach)
{
    status rc = STATUS_OK;
    const uint32_t count = f->from.shape->facet_count;
    background_record_buffer background = {0};
    background_record *records = calloc(count_all(f), sizeof *records);

    f->chunks = calloc(count / CHUNK + 1, sizeof *f->chunks);
    NEED(records && f->chunks, STATUS_MEMORY, "no memory for %u facets", count);
    TRY(device_allocate(device_of(f), &background, CHUNK, NULL));
    for (uint32_t first = 0; first < count; first += CHUNK) {
        chunk *c = &f->chunks[f->chunk_count++];
        TRY(open_chunk(f, c, first, count - first < CHUNK ? count - first : CHUNK));
        TRY(cast_rays(f, c, background));
        TRY(device_download(device_of(f), background, c->points.count, records + first));
        TRY(sort_chunk(f, c, records, reflectance, wanted, reach));
    }
    /* The endless plane sees nothing but sky. */
    records[count] =
        (background_record){.shape_factor = 1.0f, .material = RECORD_NONE, .facet = RECORD_NONE};
    TRY(device_allocate(device_of(f), &f->light.facet_background, count_all(f), records));
out:
    device_release(background);
    free(records);
    return rc;
}

/* Whether light of one more depth adds to a chunk's facets. */
static bool is_reached(const chunk *c, const float *reach)
{
    for (uint32_t i = c->first; i < c->first + c->points.count; i++)
        if ((double)reach[i] > INTERREFLECTION_REST) return true;
    return false;
}

/* Makes room for what the depths beyond the last are found from. */
static status make_tail(interreflection *f, chunk *c)
{
    if (c->last_depth < TAIL_DEPTHS) return STATUS_OK;
    return device_allocate(device_of(f), &c->kept,
                           (size_t)c->points.count * 2 * f->spectra.sample_count, NULL);
}

/* Finds how deep light goes.
 *   reach   shape (facet_count + 1): what it adds to facets at depth 2; overwritten */
static status find_depth(interreflection *f, const float *reflectance, float *reach)
{
    status rc = STATUS_OK;
    const size_t all = count_all(f);
    float_buffer reflects = {0}, before = {0}, after = {0};

    TRY(device_allocate(device_of(f), &reflects, all, reflectance));
    TRY(device_allocate(device_of(f), &before, all, reach));
    TRY(device_allocate(device_of(f), &after, all, reach));
    f->depth = 1;
    for (uint32_t d = 2; d <= INTERREFLECTION_DEPTH; d++) {
        for (uint32_t i = 0; i < f->chunk_count; i++)
            if (is_reached(&f->chunks[i], reach)) f->chunks[i].last_depth = f->depth = d;
        if (f->depth < d) break;
        for (uint32_t i = 0; i < f->chunk_count; i++) {
            const shape_factor_points *points = &f->chunks[i].points;
            TRY(interreflection_reach_run(
                device_of(f), shape1(points->count),
                &(interreflection_reach_args){.count = points->count,
                                              .cell_count =
                                                  hemisphere_grid_cell_count(f->from.grid),
                                              .hemisphere = shape_factor_rays(f->from.grid, points),
                                              .reflectance = reflects,
                                              .before = before,
                                              .reach = after}));
        }
        TRY(device_download(device_of(f), after, all, reach));
        TRY(device_upload(device_of(f), before, all, reach));
    }
    for (uint32_t i = 0; i < f->chunk_count; i++) TRY(make_tail(f, &f->chunks[i]));
out:
    device_release(after);
    device_release(before);
    device_release(reflects);
    return rc;
}

status interreflection_open(interreflection **out, const interreflection_scene *from,
                            const float *reflectance, uint32_t depth,
                            const interreflection_spectra *spectra, const float *sun)
{
    status rc = STATUS_OK;
    interreflection *f = calloc(1, sizeof *f);
    float *reach = calloc((size_t)from->shape->facet_count + 1, sizeof *reach);

    NEED(f && reach, STATUS_MEMORY, "no memory for %u facets", from->shape->facet_count);
    f->from = *from;
    f->spectra = *spectra;
    memcpy(f->sun, sun, sizeof f->sun);
    TRY(look_around(f, reflectance, depth, reach));
    f->depth = depth;
    for (uint32_t i = 0; i < f->chunk_count; i++) f->chunks[i].last_depth = depth;
    if (depth == 0) TRY(find_depth(f, reflectance, reach));
    TRY(device_allocate(device_of(f), &f->light.light,
                        count_all(f) * LIGHT_ROWS * spectra->sample_count, NULL));
    *out = f;
    f = NULL;
out:
    free(reach);
    interreflection_free(f);
    return rc;
}

void interreflection_free(interreflection *f)
{
    if (!f) return;
    for (uint32_t i = 0; i < f->chunk_count; i++) free_chunk(&f->chunks[i]);
    device_release(f->light.light);
    device_release(f->light.facet_background);
    free(f->chunks);
    free(f);
}

static radiometry_record frame_of(const interreflection *f, const radiometry_record *frame,
                                  uint32_t count)
{
    radiometry_record out = *frame;

    out.sample_count = f->spectra.sample_count;
    out.pixel_count = count;
    return out;
}

/* Writes the light of facets from what arrives there.
 *   c   NULL: of the first facets, what closes it */
static status write_light(const interreflection *f, const radiometry_record *frame, const chunk *c,
                          uint32_t keeps)
{
    device_shape shape = shape1(frame->pixel_count);

    shape.item_s = 1e-8 * frame->sample_count;
    return interreflection_run(
        device_of(f), shape,
        &(interreflection_args){.frame = *frame,
                                .hit = c ? c->points.hit : (hit_record_buffer){0},
                                .surface = f->from.surfaces,
                                .facet_background = f->light.facet_background,
                                .spectra = f->spectra.tables,
                                .arriving = c ? c->arriving : (float_buffer){0},
                                .keeps = keeps,
                                .kept = c ? c->kept : (float_buffer){0},
                                .light = f->light.light});
}

/* What a chunk keeps at a depth. */
static uint32_t keeps_at(const chunk *c, uint32_t depth)
{
    if (!c->kept.memory) return INTERREFLECTION_KEEPS_NONE;
    return depth == c->last_depth       ? INTERREFLECTION_ADDS_TAIL
           : depth == c->last_depth - 2 ? INTERREFLECTION_KEEPS_MIDDLE
           : depth == c->last_depth - 4 ? INTERREFLECTION_KEEPS_FIRST
                                        : INTERREFLECTION_KEEPS_NONE;
}

/* Takes light one facet further. */
static status pass_on(const interreflection *f, const radiometry_record *frame, uint32_t depth)
{
    status rc = STATUS_OK;

    for (uint32_t i = 0; i < f->chunk_count; i++) {
        const chunk *c = &f->chunks[i];
        const incident_pixels pixels = {
            .frame = frame_of(f, frame, c->points.count),
            .points = c->points,
            .light = f->light,
            .light_length = f->spectra.sample_count,
            .keeps_sky = depth > 2,
            .spectra = f->spectra.tables,
        };
        if (depth <= c->last_depth) TRY(incident_compute(f->from.incident, &pixels, c->arriving));
    }
    for (uint32_t i = 0; i < f->chunk_count; i++) {
        const chunk *c = &f->chunks[i];
        const radiometry_record these = frame_of(f, frame, c->points.count);
        if (depth <= c->last_depth) TRY(write_light(f, &these, c, keeps_at(c, depth)));
    }
out:
    return rc;
}

/* Casts the rays again, for another sun. */
static status turn_sun(interreflection *f, const float *sun)
{
    status rc = STATUS_OK;
    background_record_buffer background = {0};

    f->is_lit = false;
    memcpy(f->sun, sun, sizeof f->sun);
    TRY(device_allocate(device_of(f), &background, CHUNK, NULL));
    for (uint32_t i = 0; i < f->chunk_count; i++) TRY(cast_rays(f, &f->chunks[i], background));
out:
    device_release(background);
    return rc;
}

status interreflection_set_sun(interreflection *f, const radiometry_record *frame)
{
    status rc = STATUS_OK;
    const bool has_ground = ray_scene_tree(f->from.scene).world.ground_facet != RECORD_NONE;
    const radiometry_record all = frame_of(f, frame, f->from.shape->facet_count + has_ground);

    if (memcmp(f->sun, frame->sun, sizeof f->sun) != 0) TRY(turn_sun(f, frame->sun));
    if (f->is_lit) goto out;
    TRY(write_light(f, &all, NULL, INTERREFLECTION_KEEPS_NONE));
    for (uint32_t d = 2; d <= f->depth; d++) TRY(pass_on(f, frame, d));
    f->is_lit = true;
out:
    return rc;
}

light_tables interreflection_light(const interreflection *f)
{
    return f->light;
}
