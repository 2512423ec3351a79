/* Ray stream: rays read from a stream a batch at a time, so that any number passes. */
#ifndef RAY_STREAM_H
#define RAY_STREAM_H

#include "base/status.h"

#include <stdbool.h>
#include <stdint.h>
#include <stdio.h>

enum { RAY_BATCH_SIZE = 1 << 16 };

typedef struct ray_batch {
    uint32_t count;
    float ray[6][RAY_BATCH_SIZE];    /* origins, directions; these are scaled by a power of two, so
                                      that they turn by nothing and overflow nowhere */
    double length[RAY_BATCH_SIZE];   /* m per length of the scaled direction */
    double exact[RAY_BATCH_SIZE][6]; /* origins, unit directions, before they are rounded */
} ray_batch;

typedef struct ray_stream {
    FILE *file;
    bool binary;            /* 6 float32 a ray; else a line of 6 numbers, `ox oy oz dx dy dz` */
    const double *origin_m; /* subtracted from the rays' origins before they are rounded */
    uint64_t ray_count;     /* taken so far */
} ray_stream;

/* Reads up to RAY_BATCH_SIZE rays; none at the end. Fails with STATUS_FORMAT and `line N: ...` or
 * `ray N: ...`, counted from 1, for what is no ray (not six numbers, not finite, no direction), and with
 * STATUS_FILE. */
status ray_stream_read(ray_stream *stream, ray_batch *out);

#endif
