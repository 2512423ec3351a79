#include "tree/bvh.h"

#include "base/interrupt.h"
#include "kernels/rays/triangle.h"
#include "mesh/polygon.h"
#include "tree/bvh_wide.h"

#include <assert.h>
#include <stdlib.h>
#include <string.h>
#include <sys/mman.h>

enum { CHILDREN = BVH_CHILDREN, BLOCK_LIMIT = 1 << 27, ALIGNMENT = 64, LARGE_PAGE = 1 << 21 };

/* Products of four coordinates must stay far from overflow on the device. */
static const float coordinate_limit = 1e9f;

/* What the edge test on the device can be off by, per metre of coordinate: 8 roundings. */
static const float rounding = 4.76837158203125e-7f;

struct bvh {
    bvh_tables tables;
    bvh_node *node;
    bvh_block *block;
};

typedef struct triangle {
    uint32_t corner[3], facet;
} triangle;

/* The triangles on their way into the tree. */
typedef struct builder {
    bvh *tree;
    const float (*position)[3];
    triangle *triangle;
    bvh_item *item;
    bvh_fork *fork;
    uint32_t *plan;
    float reach_m; /* the largest coordinate */
} builder;

static bool is_usable(const float (*position)[3], const uint32_t corner[3])
{
    const float *a = position[corner[0]], *b = position[corner[1]], *c = position[corner[2]];
    double u[3], v[3];

    for (int k = 0; k < 3; k++) {
        if (!(fabs(a[k]) <= coordinate_limit && fabs(b[k]) <= coordinate_limit &&
              fabs(c[k]) <= coordinate_limit))
            return false;
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
    }
    return u[1] * v[2] != u[2] * v[1] || u[2] * v[0] != u[0] * v[2] || u[0] * v[1] != u[1] * v[0];
}

static void add_triangle(builder *b, uint32_t facet, uint32_t c0, uint32_t c1, uint32_t c2)
{
    bvh_tables *all = &b->tree->tables;
    const triangle t = {{c0, c1, c2}, facet};
    bvh_item *item = &b->item[all->triangle_count];

    if (!is_usable(b->position, t.corner)) return;
    for (int k = 0; k < 3; k++) {
        const float x = b->position[c0][k], y = b->position[c1][k], z = b->position[c2][k];
        item->low[k] = x < y ? (x < z ? x : z) : (y < z ? y : z);
        item->high[k] = x > y ? (x > z ? x : z) : (y > z ? y : z);
        if (all->triangle_count == 0 || item->low[k] < all->low[k]) all->low[k] = item->low[k];
        if (all->triangle_count == 0 || item->high[k] > all->high[k]) all->high[k] = item->high[k];
    }
    item->triangle = all->triangle_count;
    b->triangle[all->triangle_count++] = t;
}

static void add_sides(builder *b, bool two_sided, const triangle *t)
{
    const uint32_t *c = t->corner;

    add_triangle(b, t->facet, c[0], c[1], c[2]);
    if (two_sided) add_triangle(b, t->facet, c[0], c[2], c[1]);
}

static status add_facets(builder *b, const bvh_source *source)
{
    status rc = STATUS_OK;

    for (uint32_t i = 0; i < source->facet_count; i++) {
        TRY(interrupt_check());
        const uint32_t *c = source->corner[i];
        const bool two_sided = source->two_sided && source->two_sided[i];
        if (c[3] == UINT32_MAX) {
            add_sides(b, two_sided, &(triangle){{c[0], c[1], c[2]}, i});
        } else {
            const uint32_t d = polygon_diagonal(c, b->position);
            add_sides(b, two_sided, &(triangle){{c[d], c[d + 1], c[d + 2]}, i});
            add_sides(b, two_sided, &(triangle){{c[d], c[d + 2], c[(d + 3) % 4]}, i});
        }
    }
    for (int k = 0; k < 3; k++) {
        b->reach_m = fmaxf(b->reach_m, fabsf(b->tree->tables.low[k]));
        b->reach_m = fmaxf(b->reach_m, fabsf(b->tree->tables.high[k]));
    }
out:
    return rc;
}

/* Sorts the children by their centres along the diagonal of an octant. */
static uint32_t octant_order(const bvh_node *node, uint32_t count, uint32_t octant)
{
    float distance[CHILDREN];
    uint32_t sorted[CHILDREN], order = 0;

    for (uint32_t i = 0; i < CHILDREN; i++) {
        uint32_t place = i;
        distance[i] = i < count ? 0 : 1e30f;
        for (int k = 0; k < 3 && i < count; k++) {
            const float c = node->low[k][i] + node->high[k][i];
            distance[i] += octant >> k & 1 ? -c : c;
        }
        for (; place > 0 && distance[sorted[place - 1]] > distance[i]; place--)
            sorted[place] = sorted[place - 1];
        sorted[place] = i;
    }
    for (uint32_t i = 0; i < CHILDREN; i++) order |= sorted[i] << (4 * i);
    return order;
}

static bool is_long(const builder *b, const triangle *t)
{
    float vertex[3][3];

    for (int v = 0; v < 3; v++) memcpy(vertex[v], b->position[t->corner[v]], sizeof vertex[v]);
    return triangle_is_long((const float(*)[3])vertex);
}

/* Puts a leaf's long triangles first; returns how many they are. */
static uint32_t long_first(const builder *b, const bvh_fork *leaf, triangle out[BVH_BLOCK_SIZE])
{
    uint32_t count = 0, long_count = 0;

    for (int pass = 0; pass < 2; pass++)
        for (uint32_t i = 0; i < leaf->count; i++) {
            const triangle *t = &b->triangle[b->item[leaf->first + i].triangle];
            if (is_long(b, t) == (pass == 0)) out[count++] = *t;
            if (pass == 0) long_count = count;
        }
    return long_count;
}

static uint32_t add_leaf(builder *b, const bvh_fork *leaf)
{
    const uint32_t index = b->tree->tables.block_count++;
    bvh_block *block = &b->tree->block[index];
    triangle own[BVH_BLOCK_SIZE];
    const uint32_t long_count = long_first(b, leaf, own);

    for (uint32_t lane = 0; lane < BVH_BLOCK_SIZE; lane++) {
        block->facet[lane] = RECORD_NONE;
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++) block->vertex[v][k][lane] = NAN;
        if (lane >= leaf->count) continue;
        block->facet[lane] = own[lane].facet;
        for (int v = 0; v < 3; v++)
            for (int k = 0; k < 3; k++)
                block->vertex[v][k][lane] = b->position[own[lane].corner[v]][k];
    }
    return BVH_LEAF | index << 4 |
           (long_count < BVH_LONG_LIMIT ? long_count : BVH_LONG_LIMIT) << 1 | 1;
}

static void set_box(bvh_node *node, uint32_t child, const bvh_fork *fork, float pad_m)
{
    for (int k = 0; k < 3; k++) {
        node->low[k][child] = fork ? fork->low[k] - pad_m : 1e30f;
        node->high[k][child] = fork ? fork->high[k] + pad_m : -1e30f;
    }
}

/* Adds the node over `top`, after an interrupt without children; returns the stack entries that a ray below
 * it can need. */
static uint32_t add_node(builder *b, uint32_t top)
{
    const uint32_t index = b->tree->tables.node_count++;
    bvh_node *node = &b->tree->node[index];
    uint32_t child[CHILDREN], count = 0, deepest = 0;

    if (b->fork && !interrupt_is_set()) count = bvh_wide_children(b->plan, b->fork, top, child);
    for (uint32_t i = 0; i < CHILDREN; i++) {
        set_box(node, i, i < count ? &b->fork[child[i]] : NULL, rounding * b->reach_m);
        node->child[i] = BVH_LEAF;
    }
    for (uint32_t octant = 0; octant < 8; octant++)
        node->order[octant] = octant_order(node, count, octant);
    for (uint32_t i = 0; i < count; i++) {
        if (b->fork[child[i]].right == 0) {
            node->child[i] = add_leaf(b, &b->fork[child[i]]);
        } else {
            node->child[i] = b->tree->tables.node_count;
            const uint32_t below = add_node(b, child[i]);
            deepest = below > deepest ? below : deepest;
        }
    }
    return deepest + count;
}

/* Allocates an array; large ones on large pages, where the system has them, so that rays seldom wait
 * for the addresses of what they visit. */
static void *allocate(size_t bytes)
{
    const size_t alignment = bytes < LARGE_PAGE ? ALIGNMENT : LARGE_PAGE;
    const size_t whole = (bytes + alignment - 1) / alignment * alignment;
    void *memory = aligned_alloc(alignment, whole);

    if (memory && alignment == LARGE_PAGE) madvise(memory, whole, MADV_HUGEPAGE);
    return memory;
}

static status reserve(bvh *tree, size_t nodes, size_t blocks)
{
    status rc = STATUS_OK;

    tree->node = allocate(nodes * sizeof *tree->node);
    tree->block = allocate(blocks * sizeof *tree->block);
    NEED(tree->node && tree->block, STATUS_MEMORY, "no memory for a tree over %u triangles",
         tree->tables.triangle_count);
out:
    return rc;
}

/* Makes the flat tree; fails where it has more blocks than a child word can name. */
static status flatten(builder *b, bool even, uint32_t *out_stack)
{
    status rc = STATUS_OK;
    bvh *tree = b->tree;
    const uint32_t count = tree->tables.triangle_count;
    uint32_t fork_count = 1;

    if (count) TRY(bvh_binary_build(&b->fork, &fork_count, b->item, count, even));
    if (count) TRY(bvh_wide_plan(&b->plan, b->fork, 2 * (size_t)count - 1));
    const size_t leaf_count = (fork_count + 1) / 2;
    NEED(leaf_count <= BLOCK_LIMIT, STATUS_ARGUMENT,
         "a tree over %u triangles would have %zu blocks, at most %d are possible", count,
         leaf_count, BLOCK_LIMIT);
    TRY(reserve(tree, leaf_count, leaf_count));
    *out_stack = add_node(b, 0);
    if (count == 0) add_leaf(b, &(bvh_fork){.count = 0});
    TRY(interrupt_check());
out:
    return rc;
}

static void drop_flat(builder *b)
{
    free(b->plan);
    free(b->fork);
    free(b->tree->node);
    free(b->tree->block);
    b->plan = NULL;
    b->fork = NULL;
    b->tree->node = NULL;
    b->tree->block = NULL;
    b->tree->tables.node_count = b->tree->tables.block_count = 0;
}

status bvh_build(bvh **out, const bvh_source *source)
{
    status rc = STATUS_OK;
    builder b = {.position = source->position};
    const uint32_t facet_count = source->facet_count;
    const size_t most = (source->two_sided ? 4 : 2) * (size_t)facet_count + 1;
    uint32_t stack = 0;

    b.tree = calloc(1, sizeof *b.tree);
    b.triangle = malloc(most * sizeof *b.triangle);
    b.item = malloc(most * sizeof *b.item);
    NEED(b.tree && b.triangle && b.item, STATUS_MEMORY, "no memory for a tree over %u facets",
         facet_count);
    NEED(most < UINT32_MAX / 2, STATUS_ARGUMENT, "a tree over %u facets is too large", facet_count);
    TRY(add_facets(&b, source));
    TRY(flatten(&b, false, &stack));
    if (stack > RAY_STACK_SIZE) {
        drop_flat(&b);
        TRY(flatten(&b, true, &stack));
    }
    assert(stack <= RAY_STACK_SIZE);
    b.tree->tables.node = b.tree->node;
    b.tree->tables.block = b.tree->block;
    *out = b.tree;
    b.tree = NULL;
out:
    free(b.plan);
    free(b.fork);
    free(b.item);
    free(b.triangle);
    bvh_free(b.tree);
    return rc;
}

status bvh_restore(bvh **out, const bvh_tables *tables, bvh_node **out_node, bvh_block **out_block)
{
    status rc = STATUS_OK;
    bvh *tree = calloc(1, sizeof *tree);

    NEED(tree, STATUS_MEMORY, "no memory for a tree");
    tree->tables = *tables;
    TRY(reserve(tree, tables->node_count, tables->block_count));
    tree->tables.node = *out_node = tree->node;
    tree->tables.block = *out_block = tree->block;
    *out = tree;
    tree = NULL;
out:
    bvh_free(tree);
    return rc;
}

void bvh_free(bvh *tree)
{
    if (!tree) return;
    free(tree->node);
    free(tree->block);
    free(tree);
}

const bvh_tables *bvh_look(const bvh *tree)
{
    return &tree->tables;
}
