/* Tile queue: the pixels of an image, dealt out in tiles to several workers, to whichever is free. */
#ifndef TILE_QUEUE_H
#define TILE_QUEUE_H

#include "base/status.h"

#include <stdbool.h>
#include <stddef.h>
#include <stdint.h>

/* A worker: computes tiles, in a thread of its own if there are several. */
typedef struct tile_worker {
    void *self;
    const char *name; /* for warnings */
    /* Called once, first. Sets the most pixels of a tile. */
    status (*open)(void *self, uint32_t *out_most);
    /* Computes pixels first .. first + count - 1. After STATUS_MEMORY tiles are halved. */
    status (*compute)(void *self, uint32_t first, uint32_t count);
} tile_worker;

typedef struct tile_queue_job {
    uint32_t pixel_count;
    const tile_worker *worker; /* shape (worker_count) */
    size_t worker_count;
    /* Told after every tile how many pixels are done, by one thread at a time. */
    void (*on_progress)(void *listener, uint32_t done);
    void *listener;
} tile_queue_job;

/* Computes all pixels, the first worker in the calling thread. A worker that fails gives its tile to the
 * others, with a warning, and gets no more; where it is the last one its failure is returned. One for
 * which no thread can be started is done without, with a warning. Warnings of the workers become those of
 * the calling thread. The threads obey its interrupt, which ends the work with STATUS_INTERRUPTED.
 *   out_failed   shape (worker_count): whether a worker failed */
status tile_queue_run(const tile_queue_job *job, bool *out_failed);

#endif
