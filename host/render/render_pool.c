#include "render/render_pool.h"

#include <stdio.h>
#include <stdlib.h>

/* With several devices each gets about so many tiles, so that all end at about the same time. */
enum { TILES_EACH = 8, TILE_LEAST = 1 << 12 };

typedef struct member {
    render_pool *pool;
    device *dev;
    render *r; /* NULL: not opened yet */
    char name[300];
} member;

struct render_pool {
    const scene *s;
    member *members;
    tile_worker *workers;
    bool *failed;
    size_t count; /* of what has not failed */
    uint32_t pixel_count;
    float *const *values;
    const render_store *store;
};

/* Takes out a member. */
static void drop(render_pool *pool, size_t index)
{
    render_free(pool->members[index].r);
    pool->count--;
    for (size_t i = index; i < pool->count; i++) pool->members[i] = pool->members[i + 1];
}

/* Leaves a member out that failed, unless it is the last one or the others would fail alike. */
static status leave_out(render_pool *pool, size_t index, status rc)
{
    if (pool->count == 1 || (rc != STATUS_DEVICE && rc != STATUS_MEMORY)) return rc;
    status_warn("%s failed, the others go on without it: %s", pool->members[index].name,
                status_message());
    drop(pool, index);
    return STATUS_OK;
}

/* Opens the render of the first member that can. */
static status open_first(render_pool *pool)
{
    status rc = STATUS_OK;

    while (!pool->members[0].r) {
        rc = render_open(&pool->members[0].r, pool->s, pool->members[0].dev);
        if (rc != STATUS_OK) TRY(leave_out(pool, 0, rc));
    }
out:
    return rc;
}

status render_pool_open(render_pool **out, const scene *s, device *const *dev, size_t count)
{
    status rc = STATUS_OK;
    render_pool *pool = calloc(1, sizeof *pool);

    NEED(pool, STATUS_MEMORY, "no memory for a pool of devices");
    pool->s = s;
    pool->members = calloc(count, sizeof *pool->members);
    pool->workers = calloc(count, sizeof *pool->workers);
    pool->failed = calloc(count, sizeof *pool->failed);
    NEED(pool->members && pool->workers && pool->failed, STATUS_MEMORY,
         "no memory for a pool of devices");
    for (pool->count = 0; pool->count < count; pool->count++) {
        member *m = &pool->members[pool->count];
        const device_info *info = device_describe(dev[pool->count]);
        *m = (member){.pool = pool, .dev = dev[pool->count]};
        snprintf(m->name, sizeof m->name, "device %u (%s)", info->index, info->name);
    }
    TRY(open_first(pool));
    *out = pool;
    pool = NULL;
out:
    render_pool_free(pool);
    return rc;
}

void render_pool_free(render_pool *pool)
{
    if (!pool) return;
    for (size_t i = 0; i < pool->count; i++) render_free(pool->members[i].r);
    free(pool->failed);
    free(pool->workers);
    free(pool->members);
    free(pool);
}

status render_pool_move(render_pool *pool, const scene *s)
{
    status rc = STATUS_OK;

    pool->s = s;
    for (size_t i = pool->count; i-- > 0;) {
        rc = pool->members[i].r ? render_move(pool->members[i].r, s) : STATUS_OK;
        if (rc != STATUS_OK) TRY(leave_out(pool, i, rc));
    }
    TRY(open_first(pool));
out:
    return rc;
}

static status open_member(void *self, uint32_t *out_most)
{
    status rc = STATUS_OK;
    member *m = self;
    const render_pool *pool = m->pool;
    const uint32_t fraction = pool->pixel_count / (uint32_t)(TILES_EACH * pool->count);

    if (!m->r) TRY(render_open(&m->r, pool->s, m->dev));
    *out_most = render_tile_limit(m->r);
    if (pool->count > 1 && fraction < *out_most)
        *out_most = fraction > TILE_LEAST    ? fraction
                    : TILE_LEAST < *out_most ? TILE_LEAST
                                             : *out_most;
out:
    return rc;
}

static status compute(void *self, uint32_t first, uint32_t count)
{
    member *m = self;

    return render_tile(m->r, first, count, m->pool->values, m->pool->store);
}

status render_pool_run(render_pool *pool, float *const *values, const render_store *store,
                       void (*on_progress)(void *listener, uint32_t done), void *listener)
{
    status rc = STATUS_OK;
    const view *camera = &pool->s->camera;
    const tile_queue_job job = {.pixel_count = (uint32_t)camera->columns * (uint32_t)camera->rows,
                                .worker = pool->workers,
                                .worker_count = pool->count,
                                .on_progress = on_progress,
                                .listener = listener};

    pool->pixel_count = job.pixel_count;
    pool->values = values;
    pool->store = store;
    for (size_t i = 0; i < pool->count; i++) pool->failed[i] = false;
    for (size_t i = 0; i < pool->count; i++)
        pool->workers[i] = (tile_worker){.self = &pool->members[i],
                                         .name = pool->members[i].name,
                                         .open = open_member,
                                         .compute = compute};
    TRY(tile_queue_run(&job, pool->failed));
    for (size_t i = pool->count; i-- > 0;)
        if (pool->failed[i]) drop(pool, i);
out:
    return rc;
}

device *render_pool_device(const render_pool *pool, size_t index)
{
    return index < pool->count ? pool->members[index].dev : NULL;
}

render *render_pool_render(const render_pool *pool)
{
    return pool->members[0].r;
}
