#include "mesh/corner_tree.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

enum { LEAF_POINTS = 16, CELLS = 1 << 16 };

/* Bounds along x and y; low above high: empty. */
typedef struct box {
    double low[2], high[2];
} box;

typedef struct place {
    uint32_t code, point;
} place;

/* Node 1 is the root, 2 i and 2 i + 1 are below node i; the last leaf_count nodes are leaves, each
 * over LEAF_POINTS places. */
struct corner_tree {
    const double (*at)[2];
    uint32_t count, leaf_count;
    box *boxes;         /* shape (2 leaf_count) */
    uint32_t *in_order; /* shape (count): points, UINT32_MAX where one was taken out */
    uint32_t *place_of; /* shape (count) */
};

static const box nothing = {{INFINITY, INFINITY}, {-INFINITY, -INFINITY}};

/* Not-a-number widens nothing. */
static void widen(box *b, const box *by)
{
    for (int k = 0; k < 2; k++) {
        if (by->low[k] < b->low[k]) b->low[k] = by->low[k];
        if (by->high[k] > b->high[k]) b->high[k] = by->high[k];
    }
}

static box box_of_point(const double at[2])
{
    return (box){{at[0], at[1]}, {at[0], at[1]}};
}

/* Every second bit, the lowest first. */
static uint32_t spread_bits(uint32_t x)
{
    x = (x | x << 8) & 0x00ff00ffu;
    x = (x | x << 4) & 0x0f0f0f0fu;
    x = (x | x << 2) & 0x33333333u;
    return (x | x << 1) & 0x55555555u;
}

static uint32_t z_order(const box *all, const double at[2])
{
    uint32_t cell[2];

    for (int k = 0; k < 2; k++) {
        const double fraction = (at[k] - all->low[k]) / (all->high[k] - all->low[k]);
        cell[k] = (uint32_t)fmax(0.0, fmin(CELLS - 1, fraction * CELLS));
    }
    return spread_bits(cell[0]) | spread_bits(cell[1]) << 1;
}

static int by_code(const void *a, const void *b)
{
    const place *p = a, *q = b;

    if (p->code != q->code) return p->code < q->code ? -1 : 1;
    return p->point < q->point ? -1 : p->point > q->point;
}

static void put_in_order(corner_tree *tree, place *places)
{
    box all = nothing;

    for (uint32_t i = 0; i < tree->count; i++) {
        const box one = box_of_point(tree->at[i]);
        widen(&all, &one);
    }
    for (uint32_t i = 0; i < tree->count; i++) places[i] = (place){z_order(&all, tree->at[i]), i};
    if (tree->leaf_count > 1) qsort(places, tree->count, sizeof *places, by_code);
    for (uint32_t i = 0; i < tree->count; i++) {
        tree->in_order[i] = places[i].point;
        tree->place_of[places[i].point] = i;
    }
}

static void set_leaf(corner_tree *tree, uint32_t leaf)
{
    box *b = &tree->boxes[tree->leaf_count + leaf];

    *b = nothing;
    for (uint32_t i = leaf * LEAF_POINTS; i < (leaf + 1) * LEAF_POINTS && i < tree->count; i++) {
        if (tree->in_order[i] == UINT32_MAX) continue;
        const box one = box_of_point(tree->at[tree->in_order[i]]);
        widen(b, &one);
    }
}

static void set_node(corner_tree *tree, uint32_t node)
{
    tree->boxes[node] = tree->boxes[2 * node];
    widen(&tree->boxes[node], &tree->boxes[2 * node + 1]);
}

status corner_tree_build(corner_tree **out, const double (*at)[2], uint32_t count)
{
    status rc = STATUS_OK;
    corner_tree *tree = calloc(1, sizeof *tree);
    place *places = malloc(count * sizeof *places);

    NEED(tree && places, STATUS_MEMORY, "no memory for %u corners", count);
    *tree = (corner_tree){.at = at, .count = count, .leaf_count = 1};
    while ((uint64_t)tree->leaf_count * LEAF_POINTS < count) tree->leaf_count *= 2;
    tree->boxes = malloc(2 * (size_t)tree->leaf_count * sizeof *tree->boxes);
    tree->in_order = malloc(count * sizeof *tree->in_order);
    tree->place_of = malloc(count * sizeof *tree->place_of);
    NEED(tree->boxes && tree->in_order && tree->place_of, STATUS_MEMORY, "no memory for %u corners",
         count);
    put_in_order(tree, places);
    for (uint32_t leaf = 0; leaf < tree->leaf_count; leaf++) set_leaf(tree, leaf);
    for (uint32_t node = tree->leaf_count - 1; node > 0; node--) set_node(tree, node);
    *out = tree;
    tree = NULL;
out:
    free(places);
    corner_tree_free(tree);
    return rc;
}

void corner_tree_free(corner_tree *tree)
{
    if (!tree) return;
    free(tree->boxes);
    free(tree->in_order);
    free(tree->place_of);
    free(tree);
}

void corner_tree_remove(corner_tree *tree, uint32_t point)
{
    const uint32_t leaf = tree->place_of[point] / LEAF_POINTS;

    tree->in_order[tree->place_of[point]] = UINT32_MAX;
    set_leaf(tree, leaf);
    for (uint32_t node = (tree->leaf_count + leaf) / 2; node > 0; node /= 2) set_node(tree, node);
}

/* What is sought, and from where: the sides of a box that lie farthest to the left of each edge. */
typedef struct search {
    const corner_tree *tree;
    const double *corner[3];
    bool takes_high[3][2]; /* of the box, along x and y */
    uint32_t near;         /* the place around which to look first */
} search;

static search search_of(const corner_tree *tree, const uint32_t triangle[3])
{
    search s = {.tree = tree, .near = tree->place_of[triangle[1]] / LEAF_POINTS};

    for (int k = 0; k < 3; k++) s.corner[k] = tree->at[triangle[k]];
    for (int k = 0; k < 3; k++) {
        const double *a = s.corner[k], *b = s.corner[(k + 1) % 3];
        s.takes_high[k][0] = !(b[1] - a[1] >= 0);
        s.takes_high[k][1] = b[0] - a[0] >= 0;
    }
    return s;
}

/* Whether a whole box lies to the right of an edge. A turn never falls as its third point moves
 * left, rounded or not, so no point of the box is then found to lie to its left. */
static bool is_beyond(const search *s, const box *b)
{
    for (int k = 0; k < 3; k++) {
        const double best[2] = {s->takes_high[k][0] ? b->high[0] : b->low[0],
                                s->takes_high[k][1] ? b->high[1] : b->low[1]};
        if (corner_tree_turn(s->corner[k], s->corner[(k + 1) % 3], best) < 0) return true;
    }
    return b->low[0] > b->high[0];
}

static bool is_inside(const search *s, const double at[2])
{
    for (int k = 0; k < 3; k++) {
        const double *a = s->corner[k];
        if (a[0] == at[0] && a[1] == at[1]) return false;
        if (!(corner_tree_turn(a, s->corner[(k + 1) % 3], at) >= 0)) return false;
    }
    return true;
}

static uint32_t find_in_leaf(const search *s, uint32_t leaf)
{
    const corner_tree *tree = s->tree;

    for (uint32_t i = leaf * LEAF_POINTS; i < (leaf + 1) * LEAF_POINTS && i < tree->count; i++) {
        const uint32_t point = tree->in_order[i];
        if (point != UINT32_MAX && is_inside(s, tree->at[point])) return point;
    }
    return UINT32_MAX;
}

/* Looks below a node over the leaves from `first` on, `leaves` of them. */
static uint32_t find_below(const search *s, uint32_t node, uint32_t first, uint32_t leaves)
{
    if (is_beyond(s, &s->tree->boxes[node])) return UINT32_MAX;
    if (leaves == 1) return find_in_leaf(s, first);
    const uint32_t half = leaves / 2, turned = s->near >= first + half;
    const uint32_t found = find_below(s, 2 * node + turned, first + turned * half, half);
    if (found != UINT32_MAX) return found;
    return find_below(s, 2 * node + !turned, first + !turned * half, half);
}

uint32_t corner_tree_find(const corner_tree *tree, const uint32_t triangle[3])
{
    const search s = search_of(tree, triangle);

    return find_below(&s, 1, 0, tree->leaf_count);
}
