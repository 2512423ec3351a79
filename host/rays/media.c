#include "rays/media.h"

#include "kernels/media/cloud.h"
#include "scene/scene.h"
#include "tree/bvh_memory.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

struct media {
    device *dev;
    const scene *s;
    medium_world world;
    bvh_memory tree;
    uint_buffer medium;
    float_buffer level;
};

static bool is_body(const scene *s, uint32_t facet)
{
    return s->materials[s->material_of[s->shape->material[facet]]].medium != RECORD_NONE;
}

/* Corners of one kind of facets; the others lose their area. */
static void keep(const scene *s, bool wanted, uint32_t (*out)[4])
{
    for (uint32_t i = 0; i < s->shape->facet_count; i++) {
        static const uint32_t nowhere[4] = {0, 0, 0, UINT32_MAX};
        const uint32_t *from = is_body(s, i) == wanted ? s->shape->corner[i] : nowhere;
        memcpy(out[i], from, sizeof nowhere);
    }
}

void media_leave_out(const scene *s, uint32_t (*out)[4])
{
    keep(s, false, out);
}

static status upload_tree(media *b)
{
    status rc = STATUS_OK;
    const geometry *g = b->s->shape;
    bvh *tree = NULL;
    uint32_t(*corner)[4] = malloc(((size_t)g->facet_count + 1) * sizeof *corner);

    NEED(corner, STATUS_MEMORY, "no memory for %u facets", g->facet_count);
    keep(b->s, true, corner);
    const bvh_source source = {.facet_count = g->facet_count,
                               .vertex_count = g->vertex_count,
                               .corner = (const uint32_t(*)[4])corner,
                               .position = (const float(*)[3])g->position};
    TRY(bvh_build(&tree, &source));
    const bvh_tables *tables = bvh_look(tree);
    memcpy(b->world.low, tables->low, sizeof b->world.low);
    memcpy(b->world.high, tables->high, sizeof b->world.high);
    TRY(bvh_memory_take(&b->tree, b->dev, &tree));
out:
    bvh_free(tree);
    free(corner);
    return rc;
}

static status upload_media(media *b)
{
    status rc = STATUS_OK;
    const scene *s = b->s;
    const geometry *g = s->shape;
    uint32_t *medium = malloc(((size_t)g->facet_count + 1) * sizeof *medium);

    NEED(medium, STATUS_MEMORY, "no memory for %u facets", g->facet_count);
    for (uint32_t i = 0; i < g->facet_count; i++)
        medium[i] = s->materials[s->material_of[g->material[i]]].medium;
    TRY(device_allocate(b->dev, &b->medium, g->facet_count, medium));
    for (uint32_t i = 0; i < s->medium_count; i++) {
        const scene_material *m = &s->materials[s->medium_material[i]];
        b->world.stated_k[i] = (float)m->temperature_k;
        b->world.broad_band_per_m[i] =
            (float)(m->extinction ? m->extinction->broad_band_per_m : m->grey_extinction_per_m);
        b->world.scatters[i] = m->scattering != NULL;
    }
out:
    free(medium);
    return rc;
}

/* assumed: z 0 is where the levels begin. */
static status upload_levels(media *b)
{
    status rc = STATUS_OK;
    const atmosphere *air = b->s->air;
    const size_t count = (size_t)air->level_count;
    float(*level)[2] = calloc(count + 1, sizeof *level);

    NEED(level, STATUS_MEMORY, "no memory for the levels of the air");
    for (size_t i = 0; i < count; i++) {
        level[i][0] = (float)air->level_altitude_m[i];
        level[i][1] = (float)air->level_temperature_k[i];
    }
    b->world.level_count = (uint32_t)count;
    b->world.altitude_m = level[0][0] + (float)b->s->shape->origin_m[2];
    TRY(device_allocate(b->dev, &b->level, 2 * (count + 1), level[0]));
out:
    free(level);
    return rc;
}

status media_open(media **out, device *dev, const scene *s)
{
    status rc = STATUS_OK;
    media *b = NULL;

    *out = NULL;
    if (s->medium_count == 0) return STATUS_OK;
    b = calloc(1, sizeof *b);
    NEED(b, STATUS_MEMORY, "no memory for transmissive bodies");
    b->dev = dev;
    b->s = s;
    TRY(upload_tree(b));
    TRY(upload_media(b));
    TRY(upload_levels(b));
    *out = b;
    b = NULL;
out:
    media_free(b);
    return rc;
}

void media_free(media *b)
{
    if (!b) return;
    device_release(b->level);
    device_release(b->medium);
    bvh_memory_free(&b->tree);
    free(b);
}

medium_tables media_tables(const media *b)
{
    return (medium_tables){.media = b->world,
                           .medium_nodes = b->tree.node,
                           .medium_blocks = b->tree.block,
                           .medium_row = b->medium,
                           .air_level = b->level};
}

bool media_scatter(const media *b)
{
    for (uint32_t i = 0; i < b->s->medium_count; i++)
        if (b->world.scatters[i]) return true;
    return false;
}

/* A table's value per sample; without one a constant. */
static void fill(float *row, const wavelength_grid *grid, const double *table, double constant,
                 const double *wavenumber_cm1, uint32_t count)
{
    for (uint32_t i = 0; i < count; i++)
        row[i] = (float)(table ? wavelength_grid_value(grid, table, wavenumber_cm1[i]) : constant);
}

status media_sample(const media *b, const double *wavenumber_cm1, uint32_t count, float_buffer *out)
{
    status rc = STATUS_OK;
    const size_t values = (size_t)(CLOUD_GROUND + 1u) * count;
    float *rows = calloc(values + 1, sizeof *rows);

    NEED(rows, STATUS_MEMORY, "no memory for the extinction of bodies");
    for (uint32_t m = 0; m < b->s->medium_count; m++) {
        const scene_material *from = &b->s->materials[b->s->medium_material[m]];
        float *const own = rows + (size_t)m * count;
        const extinction *e = from->extinction;
        const scattering *sc = from->scattering;
        fill(own, e ? &e->grid : NULL, e ? e->per_m : NULL, from->grey_extinction_per_m,
             wavenumber_cm1, count);
        if (!sc) continue;
        fill(own + (size_t)CLOUD_ALBEDO * count, &sc->grid, sc->albedo, 0.0, wavenumber_cm1, count);
        fill(own + (size_t)CLOUD_ASYMMETRY * count, &sc->grid, sc->asymmetry, 0.0, wavenumber_cm1,
             count);
    }
    TRY(device_allocate(b->dev, out, values, rows));
out:
    free(rows);
    return rc;
}
