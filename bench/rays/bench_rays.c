#include "bench_rays.h"

#include <math.h>
#include <stdlib.h>

enum { COLUMNS = 1024, ROWS = 768, POINTS = 16384, DIRECTIONS = 64, PACKET = 16 };

/* A point of the mesh and its normal, on the side that is seen. */
typedef struct point {
    float at[3], normal[3];
} point;

static float random_share(uint32_t *state)
{
    *state ^= *state << 13;
    *state ^= *state >> 17;
    *state ^= *state << 5;
    return (float)(*state >> 8) * 0x1p-24f;
}

static void cross(float out[3], const float a[3], const float b[3])
{
    for (int k = 0; k < 3; k++)
        out[k] = a[(k + 1) % 3] * b[(k + 2) % 3] - a[(k + 2) % 3] * b[(k + 1) % 3];
}

static void normalise(float v[3])
{
    const float length = sqrtf(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);

    for (int k = 0; k < 3; k++) v[k] /= length;
}

static status reserve(bench_rays *out, const char *name, bool any_hit, uint32_t count)
{
    status rc = STATUS_OK;
    float *all = aligned_alloc(64, (size_t)count * sizeof(float[6]));

    NEED(all, STATUS_MEMORY, "no memory for %u rays", count);
    *out = (bench_rays){.name = name, .any_hit = any_hit, .count = count};
    for (int k = 0; k < 6; k++) out->of[k] = all + (size_t)k * count;
out:
    return rc;
}

static void set(bench_rays *r, uint32_t i, const float origin[3], const float direction[3])
{
    for (int k = 0; k < 3; k++) {
        r->of[k][i] = origin[k];
        r->of[3 + k][i] = direction[k];
    }
}

/* Takes every second bit. */
static uint32_t along(uint32_t bits)
{
    return (bits & 1) | (bits >> 1 & 2) | (bits >> 2 & 4) | (bits >> 3 & 8);
}

status bench_rays_primary(bench_rays *out, const bench_mesh *mesh)
{
    status rc = STATUS_OK;
    const float up[3] = {0, 0, 1}, half = tanf(.3926991f);
    float forward[3], right[3], top[3], direction[3];

    TRY(reserve(out, "primary", false, COLUMNS * ROWS));
    for (int k = 0; k < 3; k++) forward[k] = mesh->target[k] - mesh->eye[k];
    normalise(forward);
    cross(right, forward, up);
    normalise(right);
    cross(top, right, forward);
    for (uint32_t i = 0; i < out->count; i++) {
        const uint32_t tile = i / 256, column = tile % 64 * 16 + along(i % 256),
                       row = tile / 64 * 16 + along(i % 256 >> 1);
        const float x = ((float)column + .5f - COLUMNS / 2) / (COLUMNS / 2) * half;
        const float y = (ROWS / 2 - (float)row - .5f) / (COLUMNS / 2) * half;
        for (int k = 0; k < 3; k++) direction[k] = forward[k] + x * right[k] + y * top[k];
        normalise(direction);
        set(out, i, mesh->eye, direction);
    }
out:
    return rc;
}

/* The point that primary ray `i` met, a little above its triangle. */
static point find_point(const bench_mesh *mesh, const bench_rays *primary, const bench_met *met,
                        uint32_t i, float offset)
{
    const uint32_t *c = mesh->triangle[met->triangle[i]];
    float u[3], v[3], towards = 0;
    point p;

    for (int k = 0; k < 3; k++) {
        u[k] = mesh->position[c[1]][k] - mesh->position[c[0]][k];
        v[k] = mesh->position[c[2]][k] - mesh->position[c[0]][k];
    }
    cross(p.normal, u, v);
    normalise(p.normal);
    for (int k = 0; k < 3; k++) towards += p.normal[k] * primary->of[3 + k][i];
    for (int k = 0; k < 3; k++) {
        p.normal[k] *= towards > 0 ? -1.0f : 1.0f;
        p.at[k] = primary->of[k][i] + met->range[i] * primary->of[3 + k][i] + offset * p.normal[k];
    }
    return p;
}

static status find_points(point **out, uint32_t *out_count, const bench_mesh *mesh,
                          const bench_rays *primary, const bench_met *met)
{
    status rc = STATUS_OK;
    point *points = malloc(primary->count * sizeof *points);
    float reach = 0;
    uint32_t n = 0;

    NEED(points, STATUS_MEMORY, "no memory for %u points", primary->count);
    for (uint32_t i = 0; i < mesh->vertex_count; i++)
        for (int k = 0; k < 3; k++) reach = fmaxf(reach, fabsf(mesh->position[i][k]));
    for (uint32_t i = 0; i < primary->count; i++)
        if (isfinite(met->range[i])) points[n++] = find_point(mesh, primary, met, i, 2e-5f * reach);
    NEED(n >= POINTS, STATUS_ARGUMENT, "mesh %s: only %u primary rays meet it", mesh->name, n);
    *out = points;
    *out_count = n / 256 * 256;
    points = NULL;
out:
    free(points);
    return rc;
}

/* A direction above the point by a cosine law, in cell `q` of 8 x 8. */
static void own_direction(const point *p, uint32_t q, uint32_t *state, float out[3])
{
    const float sign = p->normal[2] >= 0 ? 1.0f : -1.0f, s = -1 / (sign + p->normal[2]);
    const float xy = p->normal[0] * p->normal[1] * s;
    const float u[3] = {1 + sign * p->normal[0] * p->normal[0] * s, sign * xy,
                        -sign * p->normal[0]};
    const float v[3] = {xy, sign + p->normal[1] * p->normal[1] * s, -p->normal[1]};
    const float turn = 6.2831853f * ((float)(q % 8) + random_share(state)) / 8;
    const float share = ((float)(q / 8) + random_share(state)) / 8;

    for (int k = 0; k < 3; k++)
        out[k] = sqrtf(share) * (cosf(turn) * u[k] + sinf(turn) * v[k]) +
                 sqrtf(1 - share) * p->normal[k];
}

/* One of 64 directions even on the sphere, turned up above the point. */
static void shared_direction(const point *p, uint32_t q, float out[3])
{
    const float z = 1 - 2 * ((float)q + .5f) / DIRECTIONS, level = sqrtf(1 - z * z);
    const float turn = 2.39996323f * (float)q, d[3] = {level * cosf(turn), level * sinf(turn), z};
    const float up = d[0] * p->normal[0] + d[1] * p->normal[1] + d[2] * p->normal[2];

    for (int k = 0; k < 3; k++) out[k] = up < 0 ? -d[k] : d[k];
}

status bench_rays_secondary(bench_rays out[3], const bench_mesh *mesh, const bench_rays *primary,
                            const bench_met *met)
{
    status rc = STATUS_OK;
    float sun[3] = {.45f, .35f, .6f}, direction[3];
    uint32_t n = 0, state = 12345;
    point *points = NULL;

    normalise(sun);
    TRY(find_points(&points, &n, mesh, primary, met));
    TRY(reserve(&out[0], "shadow", true, n));
    TRY(reserve(&out[1], "random hemisphere", false, POINTS * DIRECTIONS));
    TRY(reserve(&out[2], "shared hemisphere", false, POINTS * DIRECTIONS));
    for (uint32_t i = 0; i < n; i++) set(&out[0], i, points[i].at, sun);
    for (uint32_t i = 0; i < POINTS; i++) {
        const uint32_t run = i / PACKET, lane = i % PACKET;
        const point *p = &points[(size_t)run * PACKET * (n / POINTS) + lane];
        for (uint32_t q = 0; q < DIRECTIONS; q++) {
            own_direction(p, q, &state, direction);
            set(&out[1], i * DIRECTIONS + q, p->at, direction);
            shared_direction(p, q, direction);
            set(&out[2], (run * DIRECTIONS + q) * PACKET + lane, p->at, direction);
        }
    }
out:
    free(points);
    return rc;
}

void bench_rays_free(bench_rays *rays)
{
    free(rays->of[0]);
    rays->of[0] = NULL;
}
