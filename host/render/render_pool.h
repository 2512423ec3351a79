/* Render pool: the pixels of one scene on several devices, each with a render of its own. */
#ifndef RENDER_POOL_H
#define RENDER_POOL_H

#include "render/render.h"
#include "render/tile_queue.h"

typedef struct render_pool render_pool;

/* Opens the render of the first device that can; those of the others are opened when they compute.
 * A device that fails is left out with a warning; where none is left its failure is returned. The
 * scene and the devices must outlive the pool.
 *   dev   shape (count) */
status render_pool_open(render_pool **out, const scene *s, device *const *dev, size_t count);
void render_pool_free(render_pool *pool);

/* Goes on with the same scene at another time, as render_move does. A device that fails is left out as in
 * render_pool_open. */
status render_pool_move(render_pool *pool, const scene *s);

/* Computes all pixels as render_tile does: tiles go to whichever device is free, those of one that
 * fails to the others. Once for each time. Listener and interrupts: tile_queue.h. */
status render_pool_run(render_pool *pool, float *const *values, const render_store *store,
                       void (*on_progress)(void *listener, uint32_t done), void *listener);

/* Those devices that have not failed, at least one, NULL past their end; and the render of the
 * first of them, with the same planes as all others. Both belong to the pool. */
device *render_pool_device(const render_pool *pool, size_t index);
render *render_pool_render(const render_pool *pool);

#endif
