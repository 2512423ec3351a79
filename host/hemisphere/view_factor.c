#include "hemisphere/view_factor.h"

#include "mesh/facet_sample.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

enum { FACETS_AT_ONCE = 1 << 14 };

/* What is filled row by row. */
typedef struct collection {
    view_factors *f;
    size_t room;     /* for shares */
    uint32_t *place; /* shape (facet_count): of a facet in the row that is filled, counted from 1 */
    uint32_t cell_count;
    float (*cell)[4];
    const hemisphere_grid *part[FACET_SAMPLES]; /* each cell belongs to one */
    uint32_t *met[FACET_SAMPLES];               /* shape (cells of the part, FACETS_AT_ONCE) */
} collection;

static status make_room(collection *c)
{
    status rc = STATUS_OK;
    void *grown;

    if (c->f->share_count + c->cell_count <= c->room) return STATUS_OK;
    c->room = 2 * c->room + c->cell_count;
    NEED(c->room < UINT32_MAX, STATUS_MEMORY, "more view factors than can be numbered");
    grown = realloc(c->f->seen, c->room * sizeof *c->f->seen);
    NEED(grown, STATUS_MEMORY, "no memory for %zu view factors", c->room);
    c->f->seen = grown;
    grown = realloc(c->f->fraction, c->room * sizeof *c->f->fraction);
    NEED(grown, STATUS_MEMORY, "no memory for %zu view factors", c->room);
    c->f->fraction = grown;
out:
    return rc;
}

/* Adds what a ray met; RECORD_NONE: nothing. */
static void add(collection *c, view_record *view, uint32_t met, float fraction, bool is_up)
{
    view_factors *f = c->f;

    if (met == RECORD_NONE) {
        *(is_up ? &view->sky : &view->below) += fraction;
        return;
    }
    if (c->place[met] == 0) {
        f->seen[f->share_count] = met;
        f->fraction[f->share_count++] = 0.0f;
        c->place[met] = (uint32_t)f->share_count - view->first;
    }
    f->fraction[view->first + c->place[met] - 1] += fraction;
}

/* Fills the row of facet `first + i`; `count` were traced. */
static status add_row(collection *c, const geometry *g, uint32_t first, uint32_t i, uint32_t count)
{
    status rc = STATUS_OK;
    view_factors *f = c->f;
    view_record view = {.first = (uint32_t)f->share_count};
    size_t next[FACET_SAMPLES] = {0};
    const double up = (double)g->normal[first + i][2], level = sqrt(fmax(0.0, 1.0 - up * up));

    TRY(make_room(c));
    for (uint32_t k = 0; k < c->cell_count; k++) {
        const float *cell = c->cell[k];
        const uint32_t part = hemisphere_grid_part_of(k, FACET_SAMPLES);
        /* The grid's first direction is upslope, its second one level (hemisphere.h). */
        const bool is_up = (double)cell[0] * level + (double)cell[2] * up >= 0.0;
        add(c, &view, c->met[part][next[part]++ * count + i], cell[3], is_up);
    }
    view.count = (uint32_t)f->share_count - view.first;
    for (uint32_t k = 0; k < view.count; k++) c->place[f->seen[view.first + k]] = 0;
    f->view[first + i] = view;
out:
    return rc;
}

/* Casts the rays of part k from the k-th points of facets. */
static status trace_part(collection *c, const ray_scene *rays, const geometry *g, uint32_t first,
                         uint32_t count, int k)
{
    status rc = STATUS_OK;
    device *dev = ray_scene_device(rays);
    shape_factor_points points = {.count = count};
    const size_t words = (size_t)count * hemisphere_grid_cell_count(c->part[k]);
    hit_record *at = malloc(count * sizeof *at), all[FACET_SAMPLES];

    NEED(at, STATUS_MEMORY, "no memory for %u points", count);
    for (uint32_t i = 0; i < count; i++) {
        facet_sample(all, g, first + i, 1);
        at[i] = all[k];
        if (!(g->area_m2[first + i] > 0.0f)) at[i].facet = RECORD_NONE;
    }
    TRY(device_allocate(dev, &points.hit, count, at));
    TRY(device_allocate(dev, &points.met, words, NULL));
    TRY(shape_factor_trace(c->part[k], rays, NULL, &points));
    TRY(device_download(dev, points.met, words, c->met[k]));
out:
    device_release(points.met);
    device_release(points.hit);
    free(at);
    return rc;
}

static status trace_all(collection *c, const ray_scene *rays, const geometry *g)
{
    status rc = STATUS_OK;

    for (int k = 0; k < FACET_SAMPLES; k++) {
        c->met[k] = malloc((size_t)hemisphere_grid_cell_count(c->part[k]) * FACETS_AT_ONCE *
                           sizeof *c->met[k]);
        NEED(c->met[k], STATUS_MEMORY, "no memory for the views of %d facets", FACETS_AT_ONCE);
    }
    for (uint32_t first = 0; first < g->facet_count; first += FACETS_AT_ONCE) {
        const uint32_t left = g->facet_count - first;
        const uint32_t count = left < FACETS_AT_ONCE ? left : FACETS_AT_ONCE;
        for (int k = 0; k < FACET_SAMPLES; k++) TRY(trace_part(c, rays, g, first, count, k));
        for (uint32_t i = 0; i < count; i++) TRY(add_row(c, g, first, i, count));
    }
out:
    for (int k = 0; k < FACET_SAMPLES; k++) free(c->met[k]);
    return rc;
}

/* Parts the grid between the points of a facet, then traces. */
static status collect(collection *c, const ray_scene *rays, const hemisphere_grid *grid,
                      const geometry *g)
{
    status rc = STATUS_OK;
    device *dev = ray_scene_device(rays);
    hemisphere_grid *part[FACET_SAMPLES] = {0};

    c->cell = malloc(c->cell_count * sizeof *c->cell);
    NEED(c->cell, STATUS_MEMORY, "no memory for a hemisphere of %u cells", c->cell_count);
    TRY(device_download(dev, hemisphere_grid_cells(grid), 4 * (size_t)c->cell_count, c->cell[0]));
    for (uint32_t k = 0; k < FACET_SAMPLES; k++) {
        TRY(hemisphere_grid_open_part(&part[k], dev, grid, k, FACET_SAMPLES));
        c->part[k] = part[k];
    }
    TRY(trace_all(c, rays, g));
out:
    for (int k = 0; k < FACET_SAMPLES; k++) hemisphere_grid_free(part[k]);
    free(c->cell);
    return rc;
}

status view_factor_trace(view_factors **out, const ray_scene *rays, const hemisphere_grid *grid,
                         const geometry *g, size_t facet_count)
{
    status rc = STATUS_OK;
    view_factors *f = calloc(1, sizeof *f);
    collection c = {.f = f,
                    .place = calloc(facet_count + 1, sizeof *c.place),
                    .cell_count = hemisphere_grid_cell_count(grid)};

    NEED(f && c.place, STATUS_MEMORY, "no memory for the views of %zu facets", facet_count);
    f->facet_count = facet_count;
    f->view = calloc(facet_count + 1, sizeof *f->view);
    NEED(f->view, STATUS_MEMORY, "no memory for the views of %zu facets", facet_count);
    TRY(collect(&c, rays, grid, g));
    for (size_t i = g->facet_count; i < facet_count; i++) f->view[i].sky = 1.0f;
    *out = f;
    f = NULL;
out:
    free(c.place);
    view_factor_free(f);
    return rc;
}

void view_factor_free(view_factors *factors)
{
    if (!factors) return;
    free(factors->fraction);
    free(factors->seen);
    free(factors->view);
    free(factors);
}
