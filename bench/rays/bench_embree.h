/* Embree's side of the ray bench: one scene, robust or not, and seven ways to trace it. */
#ifndef BENCH_EMBREE_H
#define BENCH_EMBREE_H

#include "bench_rays.h"

typedef struct bench_embree bench_embree;

enum { EMBREE_MODES = 7, EMBREE_PREFILLED = 1 };
extern const char *const bench_embree_modes[EMBREE_MODES];

/* Builds the scene; *out_build_s is the time that took on both cores. */
status bench_embree_open(bench_embree **out, double *out_build_s, const bench_mesh *mesh,
                         bool robust);
void bench_embree_free(bench_embree *e);

/* Traces all rays on `threads` threads, chunk by chunk; results as bench_met has them, of any-hit rays
 * triangle 1 or 0. Filling in the records of the prefilled mode is left out of *out_wall_s. */
status bench_embree_trace(bench_embree *e, const bench_rays *rays, int mode, int threads,
                          const bench_met *out, double *out_wall_s, double *out_cpu_s);

/* CPU time of this process, s. */
double bench_cpu_s(void);

#endif
