#include "brute_force.h"

#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

enum { LANES = 8, THREAD_LIMIT = 64, BATCH = 64 };

typedef double lanes __attribute__((vector_size(LANES * sizeof(double))));
typedef int64_t flags __attribute__((vector_size(LANES * sizeof(int64_t))));

/* A triangle as its first vertex and the two edges from there. */
typedef struct triangle {
    double a[3], u[3], v[3];
} triangle;

typedef struct work {
    const triangle *triangle;
    uint32_t triangle_count, ray_count;
    const float *rays;
    double *range;
    uint32_t *met;
    atomic_uint next;
} work;

static double dot(const double a[3], const double b[3])
{
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

static void cross(double out[3], const double a[3], const double b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

/* Eight rays, which stand side by side, against all triangles. */
/* Sanitizers are not ready yet when the variant is chosen. */
#if defined(__x86_64__) && !defined(__SANITIZE_ADDRESS__)
__attribute__((target_clones("avx512f", "avx2", "default")))
#endif
static void
trace_eight(const triangle *t, uint32_t count, const lanes o[3], const lanes d[3],
            double out_range[LANES], uint32_t out_met[LANES])
{
    lanes best;

    for (int i = 0; i < LANES; i++) {
        best[i] = INFINITY;
        out_met[i] = UINT32_MAX;
    }
    for (uint32_t k = 0; k < count; k++, t++) {
        const lanes px = d[1] * t->v[2] - d[2] * t->v[1], py = d[2] * t->v[0] - d[0] * t->v[2],
                    pz = d[0] * t->v[1] - d[1] * t->v[0];
        const lanes det = t->u[0] * px + t->u[1] * py + t->u[2] * pz, square = det * det;
        const lanes sx = o[0] - t->a[0], sy = o[1] - t->a[1], sz = o[2] - t->a[2];
        const lanes first = (sx * px + sy * py + sz * pz) * det;
        const lanes qx = sy * t->u[2] - sz * t->u[1], qy = sz * t->u[0] - sx * t->u[2],
                    qz = sx * t->u[1] - sy * t->u[0];
        const lanes second = (d[0] * qx + d[1] * qy + d[2] * qz) * det;
        const lanes range = (t->v[0] * qx + t->v[1] * qy + t->v[2] * qz) * det;
        const flags met = (first >= 0) & (second >= 0) & (first + second <= square) & (range > 0) &
                          (range < best * square);
        int64_t any = 0;
        for (int i = 0; i < LANES; i++) any |= met[i];
        for (int i = 0; any && i < LANES; i++)
            if (met[i]) {
                best[i] = range[i] / square[i];
                out_met[i] = k;
            }
    }
    memcpy(out_range, &best, sizeof best);
}

static void trace_from(work *w, uint32_t first)
{
    double range[LANES];
    uint32_t met[LANES];
    lanes ray[6];

    for (uint32_t i = 0; i < LANES; i++) {
        const uint32_t at = first + i < w->ray_count ? first + i : w->ray_count - 1;
        for (int k = 0; k < 6; k++) ray[k][i] = (double)w->rays[(size_t)k * w->ray_count + at];
    }
    trace_eight(w->triangle, w->triangle_count, ray, ray + 3, range, met);
    for (uint32_t i = 0; i < LANES && first + i < w->ray_count; i++) {
        w->range[first + i] = range[i];
        w->met[first + i] = met[i];
    }
}

static void *run(void *argument)
{
    work *w = argument;
    uint32_t first;

    while ((first = atomic_fetch_add(&w->next, BATCH)) < w->ray_count)
        for (uint32_t i = first; i < first + BATCH && i < w->ray_count; i += LANES)
            trace_from(w, i);
    return NULL;
}

static triangle make_triangle(const bench_mesh *mesh, uint32_t index)
{
    const uint32_t *corner = mesh->triangle[index];
    triangle t;

    for (int k = 0; k < 3; k++) {
        t.a[k] = (double)mesh->position[corner[0]][k];
        t.u[k] = (double)mesh->position[corner[1]][k] - t.a[k];
        t.v[k] = (double)mesh->position[corner[2]][k] - t.a[k];
    }
    return t;
}

status brute_force_trace(const bench_mesh *mesh, const float *rays, uint32_t count,
                         double *out_range, uint32_t *out_triangle)
{
    status rc = STATUS_OK;
    const long processors = sysconf(_SC_NPROCESSORS_ONLN);
    triangle *list = malloc(mesh->triangle_count * sizeof *list);
    work w = {.triangle = list,
              .triangle_count = mesh->triangle_count,
              .ray_count = count,
              .rays = rays,
              .range = out_range,
              .met = out_triangle};
    pthread_t thread[THREAD_LIMIT];
    long others = 0;

    NEED(list, STATUS_MEMORY, "no memory for %u triangles", mesh->triangle_count);
    for (uint32_t i = 0; i < mesh->triangle_count; i++) list[i] = make_triangle(mesh, i);
    while (others + 1 < processors && others < THREAD_LIMIT &&
           pthread_create(&thread[others], NULL, run, &w) == 0)
        others++;
    run(&w);
    for (long i = 0; i < others; i++) pthread_join(thread[i], NULL);
out:
    free(list);
    return rc;
}

/* Metres from a point to the segment from a along u. */
static double to_segment(const double point[3], const double a[3], const double u[3])
{
    double from[3], share;

    for (int k = 0; k < 3; k++) from[k] = point[k] - a[k];
    share = fmin(fmax(dot(from, u) / dot(u, u), 0), 1);
    for (int k = 0; k < 3; k++) from[k] -= share * u[k];
    return sqrt(dot(from, from));
}

double brute_force_distance(const bench_mesh *mesh, uint32_t index, const double ray[6],
                            double *out_range)
{
    const triangle t = make_triangle(mesh, index);
    double p[3], q[3], s[3], point[3], b[3], edge[3];

    cross(p, ray + 3, t.v);
    for (int k = 0; k < 3; k++) s[k] = ray[k] - t.a[k];
    cross(q, s, t.u);
    const double det = dot(t.u, p), first = dot(s, p) / det, second = dot(ray + 3, q) / det;
    *out_range = dot(t.v, q) / det;
    if (det == 0 || !(*out_range > 0)) return INFINITY;
    if (first >= 0 && second >= 0 && first + second <= 1) return 0;
    for (int k = 0; k < 3; k++) {
        point[k] = ray[k] + *out_range * ray[3 + k];
        b[k] = t.a[k] + t.u[k];
        edge[k] = t.v[k] - t.u[k];
    }
    return fmin(fmin(to_segment(point, t.a, t.u), to_segment(point, t.a, t.v)),
                to_segment(point, b, edge));
}
