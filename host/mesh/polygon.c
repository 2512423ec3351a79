#include "mesh/polygon.h"

#include "mesh/corner_tree.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

/* A corner of the ring of those that are left. One that is blocked, as another one lies in the
 * triangle that would be cut with it, stays so until the other is cut or a neighbour of its own
 * changes. UINT32_MAX: none. */
typedef struct ring_corner {
    uint32_t next, previous;
    uint32_t blocks;         /* the first of the corners that it blocks */
    uint32_t later, earlier; /* those beside it in the list of what blocks it */
    uint32_t blocked_by;
} ring_corner;

/* One bit a corner. */
typedef struct corner_set {
    uint64_t *word;
    uint32_t words;
} corner_set;

/* The face in the plane where its area is largest, turned so that it runs counter-clockwise. */
typedef struct outline {
    double (*at)[2];
    ring_corner *ring;
    corner_set possible; /* ears, and what was not looked at since it could have become one */
    corner_set flat;     /* in line with their neighbours */
    corner_tree *tree;   /* over those that are left */
} outline;

static void set_bit(corner_set *set, uint32_t corner, bool on)
{
    const uint64_t bit = 1ull << (corner & 63);

    set->word[corner >> 6] = on ? set->word[corner >> 6] | bit : set->word[corner >> 6] & ~bit;
}

/* Finds the first corner of a set from `start` on, round the face; UINT32_MAX if it is empty. */
static uint32_t first_from(const corner_set *set, uint32_t start)
{
    uint32_t w = start >> 6;
    uint64_t word = set->word[w] & ~0ull << (start & 63);

    for (uint32_t tries = 0; !word && tries < set->words; tries++) {
        w = w + 1 < set->words ? w + 1 : 0;
        word = set->word[w];
    }
    return word ? 64 * w + (uint32_t)__builtin_ctzll(word) : UINT32_MAX;
}

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
    }
}

static double turn_of(const outline *o, uint32_t corner)
{
    const ring_corner *r = &o->ring[corner];

    return corner_tree_turn(o->at[r->previous], o->at[corner], o->at[r->next]);
}

/* Takes a corner out of the list of what blocks it. */
static void unblock(outline *o, uint32_t corner)
{
    ring_corner *r = &o->ring[corner];

    if (r->blocked_by == UINT32_MAX) return;
    if (r->later != UINT32_MAX) o->ring[r->later].earlier = r->earlier;
    if (r->earlier != UINT32_MAX)
        o->ring[r->earlier].later = r->later;
    else
        o->ring[r->blocked_by].blocks = r->later;
    r->blocked_by = UINT32_MAX;
}

static void block(outline *o, uint32_t corner, uint32_t blocker)
{
    ring_corner *r = &o->ring[corner];

    r->blocked_by = blocker;
    r->earlier = UINT32_MAX;
    r->later = o->ring[blocker].blocks;
    if (r->later != UINT32_MAX) o->ring[r->later].earlier = corner;
    o->ring[blocker].blocks = corner;
}

/* True where a corner sticks out and no other corner lies in the triangle that would be cut. */
static bool is_ear(outline *o, uint32_t corner)
{
    const uint32_t triangle[3] = {o->ring[corner].previous, corner, o->ring[corner].next};

    if (turn_of(o, corner) <= 0) return false;
    const uint32_t blocker = corner_tree_find(o->tree, triangle);
    if (blocker == UINT32_MAX) return true;
    block(o, corner, blocker);
    return false;
}

/* Finds a corner to cut, from `start` on; where there is no ear, one without area, else any. */
static uint32_t find_ear(outline *o, uint32_t start)
{
    uint32_t i;

    for (; (i = first_from(&o->possible, start)) != UINT32_MAX; set_bit(&o->possible, i, false))
        if (is_ear(o, i)) return i;
    i = first_from(&o->flat, start);
    return i != UINT32_MAX ? i : start;
}

/* After a neighbour of a corner changed. */
static void look_again(outline *o, uint32_t corner)
{
    unblock(o, corner);
    set_bit(&o->possible, corner, true);
    set_bit(&o->flat, corner, turn_of(o, corner) == 0);
}

static void cut(outline *o, uint32_t corner)
{
    const uint32_t a = o->ring[corner].previous, c = o->ring[corner].next;

    unblock(o, corner);
    set_bit(&o->possible, corner, false);
    set_bit(&o->flat, corner, false);
    corner_tree_remove(o->tree, corner);
    for (uint32_t i; (i = o->ring[corner].blocks) != UINT32_MAX; unblock(o, i))
        set_bit(&o->possible, i, true);
    o->ring[a].next = c;
    o->ring[c].previous = a;
    look_again(o, a);
    look_again(o, c);
}

static status open_outline(outline *o, uint32_t count, const uint32_t *corner,
                           const double (*position)[3])
{
    status rc = STATUS_OK;
    const uint32_t words = (count + 63) / 64;

    *o = (outline){.at = malloc(count * sizeof *o->at),
                   .ring = malloc(count * sizeof *o->ring),
                   .possible = {calloc(words, sizeof(uint64_t)), words},
                   .flat = {calloc(words, sizeof(uint64_t)), words}};
    NEED(o->at && o->ring && o->possible.word && o->flat.word, STATUS_MEMORY,
         "no memory for a face of %u corners", count);
    lay_flat(o, count, corner, position);
    for (uint32_t i = 0; i < count; i++)
        o->ring[i] = (ring_corner){i + 1 < count ? i + 1 : 0,
                                   i ? i - 1 : count - 1,
                                   UINT32_MAX,
                                   UINT32_MAX,
                                   UINT32_MAX,
                                   UINT32_MAX};
    for (uint32_t i = 0; i < count; i++) look_again(o, i);
    TRY(corner_tree_build(&o->tree, (const double(*)[2])o->at, count));
out:
    return rc;
}

static void close_outline(outline *o)
{
    corner_tree_free(o->tree);
    free(o->flat.word);
    free(o->possible.word);
    free(o->ring);
    free(o->at);
}

status polygon_split(uint32_t count, const uint32_t *corner, const double (*position)[3],
                     uint32_t (*out_triangle)[3])
{
    status rc = STATUS_OK;
    outline o = {0};

    TRY(open_outline(&o, count, corner, position));
    for (uint32_t i = 0, start = 1; i < count - 2; i++) {
        const uint32_t ear = find_ear(&o, start);
        out_triangle[i][0] = corner[o.ring[ear].previous];
        out_triangle[i][1] = corner[ear];
        out_triangle[i][2] = corner[o.ring[ear].next];
        start = o.ring[o.ring[ear].next].next;
        cut(&o, ear);
    }
out:
    close_outline(&o);
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
