#include "bench_embree.h"

#include "base/clock.h"

#include <embree3/rtcore.h>
#include <math.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdlib.h>
#include <string.h>
#include <sys/resource.h>
#include <time.h>
#include <xmmintrin.h>

enum { CHUNK = 4096, STREAM = 256, THREADS = 8 };

const char *const bench_embree_modes[EMBREE_MODES] = {
    "single", "single prefilled", "8 coherent", "16 coherent", "16", "stream coherent", "stream"};

struct bench_embree {
    RTCDevice device;
    RTCScene scene;
    struct RTCRayHit *filled;
    uint32_t filled_count;
};

typedef struct job {
    const bench_embree *e;
    const bench_rays *rays;
    const bench_met *out;
    int mode;
    atomic_uint next;
} job;

double bench_cpu_s(void)
{
    struct timespec t;

    clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
    return (double)t.tv_sec + 1e-9 * (double)t.tv_nsec;
}

status bench_embree_open(bench_embree **out, double *out_build_s, const bench_mesh *mesh,
                         bool robust)
{
    status rc = STATUS_OK;
    bench_embree *e = calloc(1, sizeof *e);
    RTCGeometry shape;

    NEED(e, STATUS_MEMORY, "no memory for Embree");
    e->device = rtcNewDevice("threads=2");
    NEED(e->device, STATUS_DEVICE, "Embree: no device");
    e->scene = rtcNewScene(e->device);
    if (robust) rtcSetSceneFlags(e->scene, RTC_SCENE_FLAG_ROBUST);
    shape = rtcNewGeometry(e->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    memcpy(rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_VERTEX, 0, RTC_FORMAT_FLOAT3, 12,
                                   mesh->vertex_count),
           mesh->position, mesh->vertex_count * sizeof *mesh->position);
    memcpy(rtcSetNewGeometryBuffer(shape, RTC_BUFFER_TYPE_INDEX, 0, RTC_FORMAT_UINT3, 12,
                                   mesh->triangle_count),
           mesh->triangle, mesh->triangle_count * sizeof *mesh->triangle);
    rtcCommitGeometry(shape);
    rtcAttachGeometry(e->scene, shape);
    rtcReleaseGeometry(shape);
    *out_build_s = clock_now_s();
    rtcCommitScene(e->scene);
    *out_build_s = clock_now_s() - *out_build_s;
    NEED(rtcGetDeviceError(e->device) == RTC_ERROR_NONE, STATUS_DEVICE,
         "Embree: no scene of %u triangles", mesh->triangle_count);
    *out = e;
    e = NULL;
out:
    bench_embree_free(e);
    return rc;
}

void bench_embree_free(bench_embree *e)
{
    if (!e) return;
    free(e->filled);
    if (e->scene) rtcReleaseScene(e->scene);
    if (e->device) rtcReleaseDevice(e->device);
    free(e);
}

static struct RTCRay make_ray(const bench_rays *r, uint32_t i)
{
    return (struct RTCRay){.org_x = r->of[0][i],
                           .org_y = r->of[1][i],
                           .org_z = r->of[2][i],
                           .dir_x = r->of[3][i],
                           .dir_y = r->of[4][i],
                           .dir_z = r->of[5][i],
                           .tfar = INFINITY,
                           .mask = UINT32_MAX};
}

static void make_hit(struct RTCHit *hit)
{
    hit->geomID = hit->primID = hit->instID[0] = RTC_INVALID_GEOMETRY_ID;
}

static void keep(const job *j, uint32_t i, const struct RTCRayHit *h)
{
    j->out->range[i] = h->hit.primID == RTC_INVALID_GEOMETRY_ID ? INFINITY : h->ray.tfar;
    j->out->triangle[i] = h->hit.primID;
}

static void trace_single(const job *j, uint32_t i)
{
    struct RTCIntersectContext context;
    struct RTCRayHit h;

    rtcInitIntersectContext(&context);
    h.ray = make_ray(j->rays, i);
    if (j->rays->any_hit) {
        rtcOccluded1(j->e->scene, &context, &h.ray);
        j->out->triangle[i] = h.ray.tfar < 0;
    } else {
        make_hit(&h.hit);
        rtcIntersect1(j->e->scene, &context, &h);
        keep(j, i, &h);
    }
}

static void trace_filled(const job *j, uint32_t i)
{
    struct RTCIntersectContext context;

    rtcInitIntersectContext(&context);
    if (j->rays->any_hit)
        rtcOccluded1(j->e->scene, &context, &j->e->filled[i].ray);
    else
        rtcIntersect1(j->e->scene, &context, &j->e->filled[i]);
}

/* Traces N rays from `i` on as one packet. */
#define TRACE_PACKET(N)                                                                            \
    static void trace_##N(const job *j, uint32_t i, struct RTCIntersectContext *context)           \
    {                                                                                              \
        const bench_rays *r = j->rays;                                                             \
        struct RTCRayHit##N h;                                                                     \
        int valid[N] __attribute__((aligned(64)));                                                 \
        for (uint32_t k = 0; k < N; k++) {                                                         \
            valid[k] = -1;                                                                         \
            h.ray.org_x[k] = r->of[0][i + k];                                                      \
            h.ray.org_y[k] = r->of[1][i + k];                                                      \
            h.ray.org_z[k] = r->of[2][i + k];                                                      \
            h.ray.dir_x[k] = r->of[3][i + k];                                                      \
            h.ray.dir_y[k] = r->of[4][i + k];                                                      \
            h.ray.dir_z[k] = r->of[5][i + k];                                                      \
            h.ray.tnear[k] = h.ray.time[k] = 0;                                                    \
            h.ray.tfar[k] = INFINITY;                                                              \
            h.ray.mask[k] = UINT32_MAX;                                                            \
            h.ray.id[k] = h.ray.flags[k] = 0;                                                      \
            h.hit.geomID[k] = h.hit.primID[k] = h.hit.instID[0][k] = RTC_INVALID_GEOMETRY_ID;      \
        }                                                                                          \
        if (r->any_hit) {                                                                          \
            rtcOccluded##N(valid, j->e->scene, context, &h.ray);                                   \
            for (uint32_t k = 0; k < N; k++) j->out->triangle[i + k] = h.ray.tfar[k] < 0;          \
            return;                                                                                \
        }                                                                                          \
        rtcIntersect##N(valid, j->e->scene, context, &h);                                          \
        for (uint32_t k = 0; k < N; k++) {                                                         \
            const uint32_t met = h.hit.primID[k];                                                  \
            j->out->range[i + k] = met == RTC_INVALID_GEOMETRY_ID ? INFINITY : h.ray.tfar[k];      \
            j->out->triangle[i + k] = met;                                                         \
        }                                                                                          \
    }
TRACE_PACKET(8)
TRACE_PACKET(16)

static void trace_stream(const job *j, uint32_t first, struct RTCIntersectContext *context)
{
    struct RTCRayHit h[STREAM];
    struct RTCRay ray[STREAM];

    for (uint32_t k = 0; k < STREAM; k++) {
        if (j->rays->any_hit) {
            ray[k] = make_ray(j->rays, first + k);
        } else {
            h[k].ray = make_ray(j->rays, first + k);
            make_hit(&h[k].hit);
        }
    }
    if (j->rays->any_hit) {
        rtcOccluded1M(j->e->scene, context, ray, STREAM, sizeof *ray);
        for (uint32_t k = 0; k < STREAM; k++) j->out->triangle[first + k] = ray[k].tfar < 0;
    } else {
        rtcIntersect1M(j->e->scene, context, h, STREAM, sizeof *h);
        for (uint32_t k = 0; k < STREAM; k++) keep(j, first + k, &h[k]);
    }
}

static void trace_chunk(const job *j, uint32_t first, uint32_t end)
{
    static const uint32_t width[EMBREE_MODES] = {1, 1, 8, 16, 16, STREAM, STREAM};
    struct RTCIntersectContext context;

    rtcInitIntersectContext(&context);
    if (j->mode == 2 || j->mode == 3 || j->mode == 5)
        context.flags = RTC_INTERSECT_CONTEXT_FLAG_COHERENT;
    for (uint32_t i = first; i < end; i += width[j->mode]) {
        if (j->mode == 0) trace_single(j, i);
        if (j->mode == 1) trace_filled(j, i);
        if (j->mode == 2) trace_8(j, i, &context);
        if (j->mode == 3 || j->mode == 4) trace_16(j, i, &context);
        if (j->mode >= 5) trace_stream(j, i, &context);
    }
}

static void *work(void *argument)
{
    job *j = argument;
    uint32_t first;

    _mm_setcsr(_mm_getcsr() | 0x8040); /* denormals are zero, as Embree advises */
    while ((first = atomic_fetch_add(&j->next, CHUNK)) < j->rays->count)
        trace_chunk(j, first, first + CHUNK < j->rays->count ? first + CHUNK : j->rays->count);
    return NULL;
}

static status fill(bench_embree *e, const bench_rays *rays)
{
    status rc = STATUS_OK;

    if (e->filled_count < rays->count) {
        free(e->filled);
        e->filled_count = rays->count;
        e->filled = aligned_alloc(64, rays->count * sizeof *e->filled);
        NEED(e->filled, STATUS_MEMORY, "no memory for %u rays", rays->count);
    }
    for (uint32_t i = 0; i < rays->count; i++) {
        e->filled[i].ray = make_ray(rays, i);
        make_hit(&e->filled[i].hit);
    }
out:
    return rc;
}

status bench_embree_trace(bench_embree *e, const bench_rays *rays, int mode, int threads,
                          const bench_met *out, double *out_wall_s, double *out_cpu_s)
{
    status rc = STATUS_OK;
    job j = {.e = e, .rays = rays, .out = out, .mode = mode};
    pthread_t thread[THREADS];

    if (mode == EMBREE_PREFILLED) TRY(fill(e, rays));
    *out_cpu_s = bench_cpu_s();
    *out_wall_s = clock_now_s();
    for (int i = 1; i < threads; i++) pthread_create(&thread[i], NULL, work, &j);
    work(&j);
    for (int i = 1; i < threads; i++) pthread_join(thread[i], NULL);
    *out_wall_s = clock_now_s() - *out_wall_s;
    *out_cpu_s = bench_cpu_s() - *out_cpu_s;
    for (uint32_t i = 0; mode == EMBREE_PREFILLED && i < rays->count; i++) {
        if (rays->any_hit)
            out->triangle[i] = e->filled[i].ray.tfar < 0;
        else
            keep(&j, i, &e->filled[i]);
    }
out:
    return rc;
}
