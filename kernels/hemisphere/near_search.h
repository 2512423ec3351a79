/* Near search: facets that take much of a point's hemisphere, found by geometry alone. What rays bring of them is put
 * right by their form factors: a control variate, whose mean over all sets of directions is 0 whatever facets are
 * taken. Device only. */
#ifndef NEAR_SEARCH_H
#define NEAR_SEARCH_H

#include "kernels/hemisphere/form_factor.h"
#include "kernels/hemisphere/hemisphere_result.h"

/* Triangles are near that take so much of a hemisphere or more, seen alone. */
#define NEAR_LEAST 0.01f

/* Points side by side, and the near triangles of each: the largest, in an order of the tree's. */
typedef struct near_list {
    const hemisphere_points *points;
    lanes fraction[NEAR_FACETS], towards[NEAR_FACETS][3];
    uint triangle[NEAR_FACETS][LANES_WIDTH]; /* block * 8 + lane */
    uint count[LANES_WIDTH];
} near_list;

/* Points of a list that stand together and face one way. */
typedef struct near_points {
    uint lanes; /* a bit each */
    float normal[3], low[3], high[3];
    float lowest; /* along the normal */
} near_points;

/* Those of some lanes that stand by the first of them and face as it does.
 *   within_m   how far they may be */
static inline near_points near_points_of(const hemisphere_points *points, const uint lanes_left,
                                         const float within_m)
{
    const uint first = 31 - clz(lanes_left & -lanes_left);
    lanes_mask differs = (lanes)0.0f > (lanes)0.0f;
    near_points all;

    for (int k = 0; k < 3; k++) {
        const float at = ((const float *)&points->origin[k])[first];
        all.normal[k] = ((const float *)&points->normal[k])[first];
        differs |= (points->normal[k] != all.normal[k]) | (fabs(points->origin[k] - at) > within_m);
        all.low[k] = all.high[k] = at;
    }
    all.lanes = lanes_left & (~lanes_bits_of(differs) | 1u << first);
    all.lowest = MAXFLOAT;
    for (uint left = all.lanes; left; left &= left - 1) {
        float up = 0.0f;
        for (int k = 0; k < 3; k++) {
            const float at = ((const float *)&points->origin[k])[31 - clz(left & -left)];
            all.low[k] = fmin(all.low[k], at);
            all.high[k] = fmax(all.high[k], at);
            up += all.normal[k] * at;
        }
        all.lowest = fmin(all.lowest, up);
    }
    return all;
}

/* Which of eight things in boxes may take NEAR_LEAST of a point's hemisphere: a bit each. What lies within a ball seen under
 * the half angle a takes 2 (1 - cos a) at most, 1.2 sin^2 a or less below 45 degrees, times the largest cosine.
 *   rises   how far each comes above the lowest horizon at most */
static inline uint near_reach(const near_points *p, const float8 *low, const float8 *high,
                              const float8 rises)
{
    float8 square = 0.0f, away = 0.0f;

    for (int k = 0; k < 3; k++) {
        const float8 least = low[k] - p->high[k], most = high[k] - p->low[k];
        const float8 half_width = 0.5f * (high[k] - low[k]);
        const float8 apart = fmax(fmax(least, -most) + half_width, 0.0f);
        square += half_width * half_width;
        away += apart * apart;
    }
    const float8 least = sqrt(away) - sqrt(square);
    const float8 cosine = fmin(rises, least) * 1.2f * square;
    return mask_of_8((low[0] <= high[0]) & (rises > 0.0f) &
                     ((square >= 0.5f * away) | (cosine >= NEAR_LEAST * away * least)));
}

/* Puts a triangle into the list of a lane: behind the others, or where the list is full in the place of the smallest
 * if that is smaller. */
static inline void near_put(near_list *near, const uint lane, const form_factor_view *view,
                            const uint triangle)
{
    const float fraction = ((const float *)&view->fraction)[lane];
    uint place = near->count[lane];

    if (place == NEAR_FACETS) {
        place = 0;
        for (uint i = 1; i < NEAR_FACETS; i++)
            if (((const float *)&near->fraction[i])[lane] <
                ((const float *)&near->fraction[place])[lane])
                place = i;
        if (!(fraction > ((const float *)&near->fraction[place])[lane])) return;
    } else {
        near->count[lane]++;
    }
    LANES_SET(near->fraction[place], lane, fraction);
    near->triangle[place][lane] = triangle;
    for (int k = 0; k < 3; k++)
        LANES_SET(near->towards[place][k], lane, ((const float *)&view->towards[k])[lane]);
}

/* A triangle from the points. */
static inline form_factor_triangle near_triangle(const hemisphere_points *points,
                                                 const float corner[3][3])
{
    form_factor_triangle t;

    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++) t.corner[v][k] = corner[v][k] - points->origin[k];
    return t;
}

/* Eight triangles of a block. */
typedef struct near_triangles {
    float8 corner[3][3], low[3], high[3];
    float8 rises; /* above the lowest horizon, at most */
} near_triangles;

static inline near_triangles near_triangles_of(const near_points *p, global const bvh_block *block)
{
    near_triangles t;

    t.rises = -MAXFLOAT;
    for (int k = 0; k < 3; k++) {
        for (int v = 0; v < 3; v++) t.corner[v][k] = vload8(0, block->vertex[v][k]);
        t.low[k] = fmin(fmin(t.corner[0][k], t.corner[1][k]), t.corner[2][k]);
        t.high[k] = fmax(fmax(t.corner[0][k], t.corner[1][k]), t.corner[2][k]);
    }
    for (int v = 0; v < 3; v++)
        t.rises = fmax(t.rises, (t.corner[v][0] * p->normal[0] + t.corner[v][1] * p->normal[1]) +
                                    t.corner[v][2] * p->normal[2]);
    t.rises -= p->lowest;
    return t;
}

/* Which of eight triangles may take NEAR_LEAST of a point's hemisphere, seen aslant as they are: a bit each. Every
 * part dA of one takes cos h dA / (pi d^3), h its plane's distance; cos is at most its rise over d. */
static inline uint near_reach_aslant(const near_points *p, const near_triangles *t)
{
    float8 away = 0.0f, volume = 0.0f, about = 0.0f;

    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        const float8 across =
            (t->corner[1][a] - t->corner[0][a]) * (t->corner[2][b] - t->corner[0][b]) -
            (t->corner[1][b] - t->corner[0][b]) * (t->corner[2][a] - t->corner[0][a]);
        const float8 apart = fmax(fmax(t->low[k] - p->high[k], p->low[k] - t->high[k]), 0.0f);
        volume += across * (t->corner[0][k] - 0.5f * (p->low[k] + p->high[k]));
        about += fabs(across) * (0.5f * (p->high[k] - p->low[k]));
        away += apart * apart;
    }
    return mask_of_8((fabs(volume) + about) * t->rises >= 2.0f * PI_F * NEAR_LEAST * away * away);
}

/* The same for one triangle and each of some points. */
static inline uint near_may_be(const near_points *p, const lanes *normal,
                               const form_factor_triangle *t)
{
    lanes away = (lanes)0.0f, across[3], edge[2][3], rises = form_factor_dot(normal, t->corner[0]);

    for (int k = 0; k < 3; k++) {
        const lanes low = fmin(fmin(t->corner[0][k], t->corner[1][k]), t->corner[2][k]);
        const lanes high = fmax(fmax(t->corner[0][k], t->corner[1][k]), t->corner[2][k]);
        const lanes apart = fmax(fmax(low, -high), (lanes)0.0f);
        away += apart * apart;
        edge[0][k] = t->corner[1][k] - t->corner[0][k];
        edge[1][k] = t->corner[2][k] - t->corner[0][k];
    }
    for (int v = 1; v < 3; v++) rises = fmax(rises, form_factor_dot(normal, t->corner[v]));
    form_factor_cross(edge[0], edge[1], across);
    const lanes volume = fabs(form_factor_dot(across, t->corner[0]));
    return p->lanes & lanes_bits_of((rises > 0.0f) &
                                    (volume * rises >= 2.0f * PI_F * NEAR_LEAST * away * away));
}

/* Looks at the triangles of a block. */
static inline void near_look(near_list *near, const near_points *all, global const bvh_block *block,
                             const uint first)
{
    const near_triangles t8 = near_triangles_of(all, block);
    const uint few = near_reach(all, t8.low, t8.high, t8.rises) & near_reach_aslant(all, &t8);

    for (uint left = few; left; left &= left - 1) {
        const uint i = 31 - clz(left & -left);
        float corner[3][3];
        if (block->facet[i] == RECORD_NONE) continue;
        ray_triangle(block, i, corner);
        const form_factor_triangle t = near_triangle(near->points, corner);
        if (!near_may_be(all, near->points->normal, &t)) continue;
        const form_factor_view view = form_factor_of(near->points->normal, &t);
        uint large = all->lanes & lanes_bits_of(view.fraction >= NEAR_LEAST);
        for (; large; large &= large - 1)
            near_put(near, 31 - clz(large & -large), &view, first + i);
    }
}

/* Finds the triangles that are near to some points. */
static inline void near_find_some(near_list *near, const near_points *some, const tree_tables *tree)
{
    uint stack[RAY_STACK_SIZE], depth = 1;

    stack[0] = 0;
    while (depth > 0) {
        const uint word = stack[--depth];
        if (word & BVH_LEAF) {
            near_look(near, some, tree->blocks + ray_block_of(word), 8 * ray_block_of(word));
            continue;
        }
        global const bvh_node *node = tree->nodes + word;
        float8 low[3], high[3], rises = -some->lowest;
        for (int k = 0; k < 3; k++) {
            low[k] = vload8(0, node->low[k]);
            high[k] = vload8(0, node->high[k]);
            rises += fmax(some->normal[k] * low[k], some->normal[k] * high[k]);
        }
        for (uint left = near_reach(some, low, high, rises); left; left &= left - 1)
            stack[depth++] = node->child[31 - clz(left & -left)];
    }
}

/* Finds the near triangles of points.
 *   within_m   how far apart those may stand that are looked at together */
static inline void near_find(near_list *near, const tree_tables *tree, const float within_m)
{
    for (uint i = 0; i < LANES_WIDTH; i++) near->count[i] = 0;
    for (uint left = near->points->alive; left;) {
        const near_points some = near_points_of(near->points, left, within_m);
        near_find_some(near, &some, tree);
        left &= ~some.lanes;
    }
}

#endif
