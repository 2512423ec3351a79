#include "bench_mesh.h"

#include "mesh/geometry.h"
#include "mesh/polygon.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static status reserve(bench_mesh *m, size_t vertices, size_t facets)
{
    status rc = STATUS_OK;

    m->position = malloc(vertices * sizeof *m->position);
    m->corner = malloc(facets * sizeof *m->corner);
    NEED(m->position && m->corner, STATUS_MEMORY, "no memory for a mesh of %zu facets", facets);
out:
    return rc;
}

static void look(bench_mesh *m, const float eye[3], const float target[3])
{
    memcpy(m->eye, eye, sizeof m->eye);
    memcpy(m->target, target, sizeof m->target);
}

static status read_airport(bench_mesh *m)
{
    static const float eye[3] = {-260, -40, 90}, target[3] = {-100, 100, 0};
    status rc = STATUS_OK;
    geometry *g = NULL;
    const geometry_instance instance = {
        .path = "scenes/airport/airport.gdb", .scale = 1, .material = "none"};

    TRY(geometry_read(&g, &instance, 1));
    TRY(reserve(m, g->vertex_count, g->facet_count));
    memcpy(m->position, g->position, g->vertex_count * sizeof *m->position);
    memcpy(m->corner, g->corner, g->facet_count * sizeof *m->corner);
    m->vertex_count = (uint32_t)g->vertex_count;
    m->facet_count = (uint32_t)g->facet_count;
    look(m, eye, target);
    for (int k = 0; k < 3; k++) {
        m->eye[k] -= (float)g->origin_m[k];
        m->target[k] -= (float)g->origin_m[k];
    }
out:
    geometry_free(g);
    return rc;
}

static float scatter(int x, int y)
{
    uint32_t h = (uint32_t)x * 374761393u + (uint32_t)y * 668265263u;

    h = (h ^ (h >> 13)) * 1274126177u;
    return (float)((h ^ h >> 16) >> 8) * 0x1p-24f;
}

/* Smooth noise of cell size 1. */
static float noise(float x, float y)
{
    const int i = (int)floorf(x), j = (int)floorf(y);
    const float u = x - (float)i, v = y - (float)j;
    const float a = u * u * (3 - 2 * u), b = v * v * (3 - 2 * v);
    const float south = scatter(i, j) + (scatter(i + 1, j) - scatter(i, j)) * a;
    const float north = scatter(i, j + 1) + (scatter(i + 1, j + 1) - scatter(i, j + 1)) * a;

    return south + (north - south) * b;
}

/* Ridges of 10 km by 10 km. */
static float height(float x, float y)
{
    float h = 0, share = 600, size = 6e-4f;

    for (int octave = 0; octave < 9; octave++, share *= .48f, size *= 2)
        h += share * (1 - fabsf(2 * noise(x * size + 17 * (float)octave, y * size) - 1));
    return h;
}

static status make_terrain(bench_mesh *m, size_t triangles)
{
    static const float eye[3] = {-500, -800, 3500}, target[3] = {5000, 5000, 300};
    status rc = STATUS_OK;
    const uint32_t n = (uint32_t)lround(sqrt((double)triangles / 2)), row = n + 1;

    TRY(reserve(m, (size_t)row * row, 2 * (size_t)n * n));
    for (uint32_t j = 0; j < row; j++)
        for (uint32_t i = 0; i < row; i++) {
            float *p = m->position[m->vertex_count++];
            p[0] = 10000.0f * (float)i / (float)n;
            p[1] = 10000.0f * (float)j / (float)n;
            p[2] = height(p[0], p[1]);
        }
    for (uint32_t j = 0; j < n; j++)
        for (uint32_t i = 0; i < n; i++) {
            const uint32_t a = j * row + i;
            const uint32_t two[2][4] = {{a, a + 1, a + row + 1, UINT32_MAX},
                                        {a, a + row + 1, a + row, UINT32_MAX}};
            memcpy(m->corner[m->facet_count], two, sizeof two);
            m->facet_count += 2;
        }
    look(m, eye, target);
out:
    return rc;
}

/* Adds a box of quads that face outwards, or inwards. */
static void add_box(bench_mesh *m, const float low[3], const float high[3], bool inwards)
{
    static const uint32_t face[6][4] = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 1, 5, 4},
                                        {2, 6, 7, 3}, {0, 4, 6, 2}, {1, 3, 7, 5}};
    const uint32_t first = m->vertex_count;

    for (uint32_t v = 0; v < 8; v++, m->vertex_count++)
        for (int k = 0; k < 3; k++) m->position[m->vertex_count][k] = v >> k & 1 ? high[k] : low[k];
    for (int f = 0; f < 6; f++, m->facet_count++)
        for (int c = 0; c < 4; c++)
            m->corner[m->facet_count][c] = first + face[f][inwards ? 3 - c : c];
}

/* Racks of four shelves with goods on them, and columns up to the roof. */
static status make_hall(bench_mesh *m)
{
    static const float eye[3] = {3, 4, 7}, target[3] = {60, 35, 2};
    static const float hall[3] = {100, 60, 9};
    enum { RACKS = 18, BAYS = 60, SHELVES = 4 };
    status rc = STATUS_OK;
    const size_t boxes = 1 + RACKS * (1 + BAYS * SHELVES * 3);

    TRY(reserve(m, 8 * boxes, 6 * boxes));
    add_box(m, (float[3]){0, 0, 0}, hall, true);
    for (int r = 0; r < RACKS; r++) {
        const float y = 3 + 3.1f * (float)r;
        add_box(m, (float[3]){50, y - 1, 0}, (float[3]){50.4f, y - .6f, 9}, false);
        for (int b = 0; b < BAYS; b++)
            for (int s = 0; s < SHELVES; s++) {
                const float x = 8 + 1.4f * (float)b, z = .2f + 1.6f * (float)s;
                const float a = scatter(b + 100 * r, s), c = scatter(b + 100 * r, s + 9);
                add_box(m, (float[3]){x, y, z}, (float[3]){x + 1.35f, y + 1.1f, z + .05f}, false);
                add_box(m, (float[3]){x + .1f, y + .1f, z + .05f},
                        (float[3]){x + .2f + .4f * a, y + .9f, z + .3f + c}, false);
                add_box(m, (float[3]){x + .7f, y + .2f, z + .05f},
                        (float[3]){x + .9f + .3f * c, y + 1, z + .3f + a}, false);
            }
    }
    look(m, eye, target);
out:
    return rc;
}

/* Walls of 20 km side by side, each with boards a centimetre thick on both sides. */
static status make_walls(bench_mesh *m)
{
    static const float eye[3] = {-20, -200, 12}, target[3] = {30, 100, 0};
    enum { WALLS = 40, BOARDS = 100 };
    status rc = STATUS_OK;

    TRY(reserve(m, 8 * WALLS * (1 + BOARDS), 6 * WALLS * (1 + BOARDS)));
    m->reach_m = 20;
    for (int w = 0; w < WALLS; w++) {
        const float x = 2.5f * (float)w;
        add_box(m, (float[3]){x, -10000, 0}, (float[3]){x + .2f, 10000, 3}, false);
        for (int i = 0; i < BOARDS; i++) {
            const float y = 200 * ((float)i - .5f * BOARDS + scatter(i, w));
            add_box(m, (float[3]){x - .01f, y, .5f}, (float[3]){x + .21f, y + 20, 2.5f}, false);
        }
    }
    look(m, eye, target);
out:
    return rc;
}

/* Cuts the quads as the tree's builder does. */
static status cut(bench_mesh *m)
{
    status rc = STATUS_OK;
    const float(*position)[3] = (const float(*)[3])m->position;

    m->triangle = malloc(2 * (size_t)m->facet_count * sizeof *m->triangle);
    m->facet = malloc(2 * (size_t)m->facet_count * sizeof *m->facet);
    NEED(m->triangle && m->facet, STATUS_MEMORY, "no memory for %u facets", m->facet_count);
    for (uint32_t i = 0; i < m->facet_count; i++) {
        const uint32_t *c = m->corner[i], quad = c[3] != UINT32_MAX;
        const uint32_t d = quad ? polygon_diagonal(c, position) : 0;
        for (uint32_t t = 0; t <= quad; t++, m->triangle_count++) {
            const uint32_t three[3] = {c[d], c[d + 1 + t], c[(d + 2 + t) % 4]};
            memcpy(m->triangle[m->triangle_count], three, sizeof three);
            m->facet[m->triangle_count] = i;
        }
    }
out:
    return rc;
}

status bench_mesh_make(bench_mesh **out, const char *name)
{
    static const char terrain[] = "terrain-";
    status rc = STATUS_OK;
    bench_mesh *m = calloc(1, sizeof *m);

    NEED(m, STATUS_MEMORY, "no memory for a mesh");
    snprintf(m->name, sizeof m->name, "%s", name);
    if (!strcmp(name, "airport"))
        TRY(read_airport(m));
    else if (!strcmp(name, "hall"))
        TRY(make_hall(m));
    else if (!strcmp(name, "walls"))
        TRY(make_walls(m));
    else if (!strncmp(name, terrain, sizeof terrain - 1))
        TRY(make_terrain(m, strtoul(name + sizeof terrain - 1, NULL, 10)));
    else
        NEED(false, STATUS_ARGUMENT, "mesh '%s': expected airport, hall, walls or terrain-N", name);
    TRY(cut(m));
    *out = m;
    m = NULL;
out:
    bench_mesh_free(m);
    return rc;
}

void bench_mesh_free(bench_mesh *m)
{
    if (!m) return;
    free(m->facet);
    free(m->triangle);
    free(m->corner);
    free(m->position);
    free(m);
}
