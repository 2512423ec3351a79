/* radsig's side of the ray bench: its kernels over its tree, on one core (a sub-device) and on all. */
#ifndef BENCH_OPENCL_H
#define BENCH_OPENCL_H

#include "bench_rays.h"
#include "tree/bvh.h"

typedef struct bench_opencl bench_opencl;

enum { OPENCL_MODES = 2, OPENCL_PACKETS = 0 };
extern const char *const bench_opencl_modes[OPENCL_MODES];

/* Opens the first CPU and hands it the tree, which must outlive it. */
status bench_opencl_open(bench_opencl **out, const bvh *tree);
void bench_opencl_free(bench_opencl *c);

/* Traces all rays on one core or (2) all of them; results as bench_embree_trace gives them, facets in
 * place of triangles. */
status bench_opencl_trace(bench_opencl *c, const bench_rays *rays, int mode, int cores,
                          const bench_met *out, double *out_wall_s, double *out_cpu_s);

#endif
