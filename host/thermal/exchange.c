#include "thermal/exchange.h"

#include "hemisphere/view_factor.h"
#include "kernels/thermal/conduction.h"
#include "thermal/conduction.h"
#include "thermal/thermal_model.h"

#include <stdlib.h>
#include <string.h>

enum { WORK_ROWS = 9, PASSES = 8 };

#define LEAST_SHARE 0.005f /* of a view, that facets take */
#define SETTLED_W_M2 2.0f

/* What a step of a column takes on one core in the kernels, s. */
#define SENT_S 1e-7
#define RECEIVED_S 3e-7

/* What stays the same over the passes. */
typedef struct exchange {
    const scene *s;
    thermal *model;
    facet_record *facet; /* shape (facet_count) */
    size_t facet_count;
    const facet_light *sun;
    uint_buffer lit;          /* of all facets */
    float_buffer sent_w_m2;   /* shape (steps, facet_count) */
    float_buffer before_w_m2; /* what was received before, shape (steps, columns) */
    view_record_buffer view;  /* of the columns, and what they see */
    uint_buffer seen;
    float_buffer fraction;
} exchange;

static thermal_span span_of(const exchange *x, size_t count)
{
    return (thermal_span){.facet_count = (uint)count,
                          .row_count = (uint)x->model->step_count,
                          .sunlit_words = x->sun->words,
                          .weight = 1.0f,
                          .sunlit_period = x->sun->slots,
                          .step_s = (float)x->model->step_s,
                          .step_count = (uint)x->model->step_count};
}

/* The sun on facets, as lit.h has it.
 *   facet   shape (count): which ones; NULL: all */
static status upload_lit(const exchange *x, const uint32_t *facet, size_t count, uint_buffer *out)
{
    status rc = STATUS_OK;
    const size_t words = x->sun->words;
    uint32_t *row = NULL;

    if (words == 0) return STATUS_OK;
    row = malloc(count * words * sizeof *row);
    NEED(row, STATUS_MEMORY, "no memory for the sun on %zu facets", count);
    for (size_t i = 0; i < count; i++)
        for (size_t w = 0; w < words; w++)
            row[w * count + i] = x->sun->word[(facet ? facet[i] : i) * words + w];
    TRY(device_allocate(x->model->dev, out, count * words, row));
out:
    free(row);
    return rc;
}

/* What the kernel works with. */
typedef struct conducting {
    patch_tables patches;
    uint_buffer lit;
    conduction_progress *at; /* shape (patch_count) */
} conducting;

static void conducting_free(conducting *c)
{
    device_release(c->patches.progress);
    device_release(c->patches.numbers);
    device_release(c->patches.groups);
    device_release(c->patches.links);
    device_release(c->patches.patch_first);
    device_release(c->lit);
    free(c->at);
}

static status conducting_open(conducting *c, const exchange *x, const conduction_map *map)
{
    status rc = STATUS_OK;
    device *dev = x->model->dev;
    const size_t n = map->count, patches = map->patch_count;

    c->at = calloc(patches, sizeof *c->at);
    NEED(c->at, STATUS_MEMORY, "no memory for %zu patches", patches);
    TRY(upload_lit(x, map->facet, n, &c->lit));
    TRY(device_allocate(dev, &c->patches.patch_first, patches + 1, map->patch_first));
    TRY(device_allocate(dev, &c->patches.links, n, map->link));
    TRY(device_allocate(dev, &c->patches.groups, n, NULL));
    TRY(device_allocate(dev, &c->patches.numbers, n * WORK_ROWS, NULL));
    TRY(device_allocate(dev, &c->patches.progress, patches, c->at));
out:
    return rc;
}

/* Launches the kernel over the patches until all are done; the heat along facets stays with the model. */
static status conduct_map(const exchange *x, const conduction_map *map,
                          layered_record_buffer facets)
{
    status rc = STATUS_OK;
    thermal *t = x->model;
    const device_shape shape = {.size = {map->patch_count, 1}, .local = 1};
    conducting c = {0};
    bool is_done = false;

    TRY(conducting_open(&c, x, map));
    TRY(device_allocate(t->dev, &t->exchange.lateral_w_m2, map->count * 2 * t->step_count, NULL));
    const conduction_args args = {.span = span_of(x, map->count),
                                  .patch_count = map->patch_count,
                                  .facets = facets,
                                  .load = thermal_loads(t, c.lit),
                                  .exchange = t->exchange,
                                  .patch = c.patches,
                                  .out_w_m2 = t->exchange.lateral_w_m2};
    while (!is_done) {
        TRY(conduction_run(t->dev, shape, &args));
        TRY(device_download(t->dev, c.patches.progress, map->patch_count, c.at));
        is_done = true;
        for (uint32_t i = 0; i < map->patch_count; i++) is_done &= c.at[i].is_done;
    }
    t->exchange.lateral_columns = (uint32_t)map->count;
out:
    conducting_free(&c);
    return rc;
}

/* Finds the patches, and what passes along them. */
static status conduct(const exchange *x)
{
    status rc = STATUS_OK;
    conduction_map *map = NULL;
    facet_record *at_place = NULL;
    layered_record_buffer facets = {0};

    TRY(conduction_find(&map, x->s->shape, x->facet, x->model->material));
    if (map->count == 0) goto out;
    at_place = malloc(map->count * sizeof *at_place);
    NEED(at_place, STATUS_MEMORY, "no memory for %zu facets of patches", map->count);
    for (size_t i = 0; i < map->count; i++) at_place[i] = x->facet[map->facet[i]];
    TRY(thermal_upload_layered(x->model, at_place, map->count, &facets));
    TRY(conduct_map(x, map, facets));
    /* Backwards: a filler repeats the facet before it, without its neighbours. */
    for (size_t i = map->count; i-- > 0;) x->facet[map->facet[i]].lateral_column = (uint32_t)i + 1;
out:
    device_release(facets);
    free(at_place);
    conduction_free(map);
    return rc;
}

/* Gives a column to each facet that sees others, and keeps what they see. */
static status keep_views(exchange *x, const view_factors *f)
{
    status rc = STATUS_OK;
    thermal *t = x->model;
    uint32_t columns = 0;
    view_record *kept = malloc((f->facet_count + 1) * sizeof *kept);

    t->sky_fraction = malloc((f->facet_count + 1) * sizeof *t->sky_fraction);
    NEED(kept && t->sky_fraction, STATUS_MEMORY, "no memory for %zu views", f->facet_count);
    for (size_t i = 0; i < f->facet_count; i++) {
        const view_record *v = &f->view[i];
        if (1.0f - v->sky - v->below < LEAST_SHARE) continue;
        kept[columns] = *v;
        t->sky_fraction[columns] = v->sky;
        x->facet[i].received_column = ++columns;
    }
    TRY(device_allocate(t->dev, &x->view, columns, kept));
    TRY(device_allocate(t->dev, &x->seen, f->share_count, f->seen));
    TRY(device_allocate(t->dev, &x->fraction, f->share_count, f->fraction));
    TRY(device_allocate(t->dev, &t->exchange.received_w_m2, columns * t->step_count, NULL));
    TRY(device_allocate(t->dev, &x->before_w_m2, columns * t->step_count, NULL));
    TRY(device_allocate(t->dev, &x->sent_w_m2, x->facet_count * t->step_count, NULL));
    t->exchange.received_columns = columns;
out:
    free(kept);
    return rc;
}

static status find_views(exchange *x, const ray_scene *rays)
{
    status rc = STATUS_OK;
    const scene *s = x->s;
    hemisphere_grid *grid = NULL;
    view_factors *factors = NULL;

    TRY(hemisphere_grid_open(&grid, x->model->dev, SHAPE_FACTOR_COSINE,
                             s->hemisphere_zenith_step_deg, s->hemisphere_azimuth_step_deg));
    TRY(view_factor_trace(&factors, rays, grid, s->shape, x->facet_count));
    TRY(keep_views(x, factors));
out:
    view_factor_free(factors);
    hemisphere_grid_free(grid);
    return rc;
}

/* Launches that go through all steps of a facet or a column. */
static device_shape shape_of(const exchange *x, size_t count, double step_s)
{
    return (device_shape){{count, 1}, 64, step_s * (double)x->model->step_count};
}

/* Takes all facets through the weather with what they received so far, then lets them send anew.
 *   is_first   nothing was received yet */
static status pass(exchange *x, bool is_first)
{
    status rc = STATUS_OK;
    thermal *t = x->model;
    const thermal_span span = span_of(x, x->facet_count);
    const uint32_t n = span.facet_count;
    device_shape each_step = shape_of(x, t->exchange.received_columns, RECEIVED_S);
    exchange_tables before = t->exchange;
    layered_record_buffer facets = {0};

    each_step.size[1] = t->step_count;
    if (is_first) before.received_columns = 0;
    TRY(thermal_upload_layered(t, x->facet, x->facet_count, &facets));
    TRY(layered_run(t->dev, thermal_shape(t, n),
                    &(layered_args){.span = span,
                                    .facets = facets,
                                    .load = thermal_loads(t, x->lit),
                                    .exchange = before,
                                    .temperature_k = x->sent_w_m2}));
    TRY(radiosity_run(t->dev, shape_of(x, n, SENT_S),
                      &(radiosity_args){.facet_count = n,
                                        .step_count = span.step_count,
                                        .facet = facets,
                                        .forcing = t->forcing,
                                        .received_columns = before.received_columns,
                                        .received_w_m2 = before.received_w_m2,
                                        .rows = x->sent_w_m2}));
    const float_buffer old = t->exchange.received_w_m2;
    t->exchange.received_w_m2 = x->before_w_m2;
    x->before_w_m2 = old;
    TRY(irradiation_run(t->dev, each_step,
                        &(irradiation_args){.column_count = t->exchange.received_columns,
                                            .facet_count = n,
                                            .view = x->view,
                                            .seen = x->seen,
                                            .fraction = x->fraction,
                                            .forcing = t->forcing,
                                            .sent_w_m2 = x->sent_w_m2,
                                            .received_w_m2 = t->exchange.received_w_m2}));
out:
    device_release(facets);
    return rc;
}

/* Tells whether the last pass changed what facets receive. */
static status find_change(const exchange *x, bool *out_changes)
{
    status rc = STATUS_OK;
    const thermal *t = x->model;
    const uint32_t columns = t->exchange.received_columns;
    float_buffer most = {0};
    float *w_m2 = malloc(columns * sizeof *w_m2);

    NEED(w_m2, STATUS_MEMORY, "no memory for %u facets", columns);
    TRY(device_allocate(t->dev, &most, columns, NULL));
    TRY(largest_change_run(t->dev, shape_of(x, columns, SENT_S),
                           &(largest_change_args){.column_count = columns,
                                                  .row_count = (uint)t->step_count,
                                                  .before = x->before_w_m2,
                                                  .after = t->exchange.received_w_m2,
                                                  .out = most}));
    TRY(device_download(t->dev, most, columns, w_m2));
    *out_changes = false;
    for (uint32_t i = 0; i < columns; i++) *out_changes |= w_m2[i] > SETTLED_W_M2;
out:
    device_release(most);
    free(w_m2);
    return rc;
}

/* Passes until nothing changes. */
static status send_and_receive(exchange *x)
{
    status rc = STATUS_OK;
    bool changes = x->model->exchange.received_columns > 0;

    for (int i = 0; i < PASSES && changes; i++) {
        TRY(pass(x, i == 0));
        if (i > 0) TRY(find_change(x, &changes));
    }
out:
    return rc;
}

static void release(exchange *x)
{
    device_release(x->before_w_m2);
    device_release(x->fraction);
    device_release(x->seen);
    device_release(x->view);
    device_release(x->sent_w_m2);
    device_release(x->lit);
}

status exchange_run(const scene *s, thermal *model, const ray_scene *rays, const facet_light *sun,
                    facet_record *facet, size_t facet_count)
{
    status rc = STATUS_OK;
    exchange x = {.s = s, .model = model, .facet = facet, .facet_count = facet_count, .sun = sun};

    if (s->facet_longwave) {
        TRY(find_views(&x, rays));
        TRY(upload_lit(&x, NULL, facet_count, &x.lit));
        TRY(send_and_receive(&x));
    }
    if (s->lateral_conduction) TRY(conduct(&x));
out:
    release(&x);
    return rc;
}
