#include "polygon.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* The face in the plane where its area is largest, turned so that it runs counter-clockwise. */
typedef struct outline {
    double (*at)[2];
    uint32_t *next, *previous;
} outline;

/* Newell's normal: its length is twice the area. */
static void find_normal(double out[3], uint32_t count, const uint32_t *corner,
                        const double (*position)[3])
{
    out[0] = out[1] = out[2] = 0;
    for (uint32_t i = 0; i < count; i++) {
        const double *origin = position[corner[0]];
        const double *a = position[corner[i]], *b = position[corner[(i + 1) % count]];
        for (int k = 0; k < 3; k++) {
            const int x = (k + 1) % 3, y = (k + 2) % 3;
            out[k] +=
                (a[x] - origin[x]) * (b[y] - origin[y]) - (a[y] - origin[y]) * (b[x] - origin[x]);
        }
    }
}

static void lay_flat(outline *o, uint32_t count, const uint32_t *corner,
                     const double (*position)[3])
{
    double normal[3];
    int axis;

    find_normal(normal, count, corner, position);
    axis = fabs(normal[1]) > fabs(normal[0]) ? 1 : 0;
    axis = fabs(normal[2]) > fabs(normal[axis]) ? 2 : axis;
    for (uint32_t i = 0; i < count; i++) {
        const double *origin = position[corner[0]], *p = position[corner[i]];
        const int x = (axis + 1) % 3, y = (axis + 2) % 3;
        o->at[i][0] = p[x] - origin[x];
        o->at[i][1] = normal[axis] < 0 ? origin[y] - p[y] : p[y] - origin[y];
        o->next[i] = (i + 1) % count;
        o->previous[i] = (i + count - 1) % count;
    }
}

/* Twice the signed area of a triangle; positive to the left of a-b. */
static double turn(const outline *o, uint32_t a, uint32_t b, uint32_t c)
{
    return (o->at[b][0] - o->at[a][0]) * (o->at[c][1] - o->at[a][1]) -
           (o->at[b][1] - o->at[a][1]) * (o->at[c][0] - o->at[a][0]);
}

static bool is_same_place(const outline *o, uint32_t a, uint32_t b)
{
    return o->at[a][0] == o->at[b][0] && o->at[a][1] == o->at[b][1];
}

/* True where corner i sticks out and no other corner lies in the triangle that would be cut. */
static bool is_ear(const outline *o, uint32_t i)
{
    const uint32_t a = o->previous[i], c = o->next[i];

    if (turn(o, a, i, c) <= 0) return false;
    for (uint32_t j = o->next[c]; j != a; j = o->next[j])
        if (!is_same_place(o, j, a) && !is_same_place(o, j, i) && !is_same_place(o, j, c) &&
            turn(o, a, i, j) >= 0 && turn(o, i, c, j) >= 0 && turn(o, c, a, j) >= 0)
            return false;
    return true;
}

/* Finds a corner to cut, from `start` on; where there is no ear, one without area, else any. */
static uint32_t find_ear(const outline *o, uint32_t start, uint32_t left)
{
    uint32_t i = start;

    for (uint32_t tries = 0; tries < left; tries++, i = o->next[i])
        if (is_ear(o, i)) return i;
    for (uint32_t tries = 0; tries < left; tries++, i = o->next[i])
        if (turn(o, o->previous[i], i, o->next[i]) == 0) return i;
    return start;
}

status polygon_split(uint32_t count, const uint32_t *corner, const double (*position)[3],
                     uint32_t (*out_triangle)[3])
{
    status rc = STATUS_OK;
    outline o = {malloc(count * sizeof *o.at), malloc(count * sizeof *o.next),
                 malloc(count * sizeof *o.previous)};
    uint32_t start = 1;

    NEED(o.at && o.next && o.previous, STATUS_MEMORY, "no memory for a face of %u corners", count);
    lay_flat(&o, count, corner, position);
    for (uint32_t left = count, cut = 0; left >= 3; left--, cut++) {
        const uint32_t i = find_ear(&o, start, left), a = o.previous[i], c = o.next[i];
        out_triangle[cut][0] = corner[a];
        out_triangle[cut][1] = corner[i];
        out_triangle[cut][2] = corner[c];
        o.next[a] = c;
        o.previous[c] = a;
        start = o.next[c];
    }
out:
    free(o.previous);
    free(o.next);
    free(o.at);
    return rc;
}

/* Whether the triangles (d, d + 1, d + 2) and (d, d + 2, d + 3) look to the same side. */
static bool agrees(uint32_t d, const uint32_t corner[4], const float (*position)[3])
{
    double side[3][3], first[3], second[3], product = 0;

    for (uint32_t i = 0; i < 3; i++)
        for (int k = 0; k < 3; k++)
            side[i][k] =
                (double)position[corner[(d + i + 1) % 4]][k] - (double)position[corner[d]][k];
    for (int k = 0; k < 3; k++) {
        const int x = (k + 1) % 3, y = (k + 2) % 3;
        first[k] = side[0][x] * side[1][y] - side[0][y] * side[1][x];
        second[k] = side[1][x] * side[2][y] - side[1][y] * side[2][x];
        product += first[k] * second[k];
    }
    return product > 0;
}

uint32_t polygon_diagonal(const uint32_t corner[4], const float (*position)[3])
{
    return !agrees(0, corner, position) && agrees(1, corner, position);
}
