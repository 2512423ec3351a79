/* Classes of rays of the bench: what a camera, the sun and hemispheres cast over one mesh. */
#ifndef BENCH_RAYS_H
#define BENCH_RAYS_H

#include "bench_mesh.h"

enum { BENCH_CLASSES = 4 };

typedef struct bench_rays {
    const char *name;
    bool any_hit;
    uint32_t count; /* a multiple of 256 */
    float *of[6];   /* shape (count) each: origins, directions; parts of one array */
} bench_rays;

/* What the rays of the first class met: shape (count); range INFINITY for a miss. */
typedef struct bench_met {
    float *range;
    uint32_t *triangle;
} bench_met;

/* Makes the primary rays: 1024 x 768 pixels, in tiles of 16 x 16 along a Z curve. */
status bench_rays_primary(bench_rays *out, const bench_mesh *mesh);

/* Makes the other classes from what the primary rays met: towards the sun (any hit), and hemispheres
 * over 16,384 of the points: 64 directions of each point's own, and 64 that runs of 16 points share.
 * Fails with STATUS_ARGUMENT where too little was met. */
status bench_rays_secondary(bench_rays out[3], const bench_mesh *mesh, const bench_rays *primary,
                            const bench_met *met);
void bench_rays_free(bench_rays *rays);

#endif
