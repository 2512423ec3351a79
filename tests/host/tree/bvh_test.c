#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#include "tree/bvh.h"

enum { SIDE = 60, FACETS = SIDE * SIDE, VERTICES = (SIDE + 1) * (SIDE + 1) };

/* A hilly terrain of quads; the caller sets the corners that should differ. */
typedef struct terrain {
    float position[VERTICES][3];
    uint32_t corner[FACETS][4];
} terrain;

static terrain *make_terrain(void)
{
    terrain *t = malloc(sizeof *t);

    assert_non_null(t);
    for (uint32_t i = 0; i < VERTICES; i++) {
        const float x = (float)(i % (SIDE + 1)), y = (float)(i / (SIDE + 1));
        t->position[i][0] = x;
        t->position[i][1] = y;
        t->position[i][2] = 3 * sinf(.3f * x) * cosf(.2f * y);
    }
    for (uint32_t i = 0; i < FACETS; i++) {
        const uint32_t a = i / SIDE * (SIDE + 1) + i % SIDE;
        const uint32_t c[4] = {a, a + 1, a + SIDE + 2, a + SIDE + 1};
        memcpy(t->corner[i], c, sizeof c);
    }
    return t;
}

static bvh *build(uint32_t count, const uint32_t (*corner)[4], const float (*position)[3])
{
    const bvh_source source = {.facet_count = count, .corner = corner, .position = position};
    bvh *tree = NULL;

    assert_int_equal(bvh_build(&tree, &source), STATUS_OK);
    return tree;
}

/* Walks the tree: counts how often a facet is met in the leaves, fails where a triangle leaves its
 * box, returns the stack entries that a ray can need. */
static uint32_t walk(const bvh_tables *t, uint32_t index, uint32_t *times)
{
    const bvh_node *node = &t->node[index];
    uint32_t deepest = 0, children = 0;

    for (int i = 0; i < 8; i++) {
        if (node->low[0][i] > node->high[0][i]) continue;
        children++;
        if (!(node->child[i] & BVH_LEAF)) {
            const uint32_t below = walk(t, node->child[i], times);
            deepest = below > deepest ? below : deepest;
            continue;
        }
        const bvh_block *block = &t->block[(node->child[i] & ~BVH_LEAF) >> 4];
        assert_int_equal(node->child[i] & 1, 1);
        for (int lane = 0; lane < 8; lane++) {
            if (block->facet[lane] == RECORD_NONE) continue;
            times[block->facet[lane]]++;
            for (int v = 0; v < 3; v++)
                for (int k = 0; k < 3; k++) {
                    assert_true(block->vertex[v][k][lane] >= node->low[k][i]);
                    assert_true(block->vertex[v][k][lane] <= node->high[k][i]);
                }
        }
    }
    return deepest + children;
}

static void both_triangles_of_every_quad_are_in_one_leaf_each(void **state)
{
    (void)state;
    terrain *t = make_terrain();
    bvh *tree = build(FACETS, t->corner, t->position);
    uint32_t times[FACETS] = {0};

    walk(bvh_look(tree), 0, times);

    for (int i = 0; i < FACETS; i++) assert_int_equal(times[i], 2);
    assert_int_equal(bvh_look(tree)->triangle_count, 2 * FACETS);
    bvh_free(tree);
    free(t);
}

static void two_sided_facets_are_there_twice(void **state)
{
    (void)state;
    const float position[][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const uint32_t corner[][4] = {{0, 1, 2, UINT32_MAX}, {0, 1, 2, 3}, {0, 1, 2, UINT32_MAX}};
    const uint8_t two_sided[] = {1, 1, 0};
    const bvh_source source = {.facet_count = 3,
                               .vertex_count = 4,
                               .corner = corner,
                               .position = position,
                               .two_sided = two_sided};
    uint32_t times[3] = {0};
    bvh *tree = NULL;

    assert_int_equal(bvh_build(&tree, &source), STATUS_OK);
    walk(bvh_look(tree), 0, times);

    assert_int_equal(times[0], 2);
    assert_int_equal(times[1], 4);
    assert_int_equal(times[2], 1);
    bvh_free(tree);
}

static void the_box_is_that_of_all_vertices(void **state)
{
    (void)state;
    terrain *t = make_terrain();
    bvh *tree = build(FACETS, t->corner, t->position);
    const bvh_tables *tables = bvh_look(tree);

    assert_true(tables->low[0] == 0 && tables->high[0] == SIDE);
    assert_true(tables->low[1] == 0 && tables->high[1] == SIDE);
    assert_true(tables->low[2] > -3 && tables->low[2] < -2.9f);
    bvh_free(tree);
    free(t);
}

static void the_same_facets_give_the_same_bytes(void **state)
{
    (void)state;
    terrain *t = make_terrain();
    bvh *first = build(FACETS, t->corner, t->position);
    bvh *second = build(FACETS, t->corner, t->position);
    const bvh_tables *a = bvh_look(first), *b = bvh_look(second);

    assert_int_equal(a->node_count, b->node_count);
    assert_int_equal(a->block_count, b->block_count);
    assert_memory_equal(a->node, b->node, a->node_count * sizeof *a->node);
    assert_memory_equal(a->block, b->block, a->block_count * sizeof *a->block);
    bvh_free(second);
    bvh_free(first);
    free(t);
}

static void nodes_and_blocks_start_on_64_bytes(void **state)
{
    (void)state;
    terrain *t = make_terrain();
    bvh *tree = build(FACETS, t->corner, t->position);

    assert_int_equal((uintptr_t)bvh_look(tree)->node % 64, 0);
    assert_int_equal((uintptr_t)bvh_look(tree)->block % 64, 0);
    bvh_free(tree);
    free(t);
}

static void every_order_names_every_child_once(void **state)
{
    (void)state;
    terrain *t = make_terrain();
    bvh *tree = build(FACETS, t->corner, t->position);
    const bvh_tables *tables = bvh_look(tree);

    for (uint32_t i = 0; i < tables->node_count; i++)
        for (int octant = 0; octant < 8; octant++) {
            uint32_t seen = 0;
            for (int k = 0; k < 8; k++)
                seen |= 1u << (tables->node[i].order[octant] >> (4 * k) & 15);
            assert_int_equal(seen, 255);
        }
    bvh_free(tree);
    free(t);
}

static void no_facets_make_a_tree_with_nothing_in_it(void **state)
{
    (void)state;
    bvh *tree = build(0, NULL, NULL);
    uint32_t times[1] = {0};

    assert_int_equal(bvh_look(tree)->triangle_count, 0);
    assert_int_equal(bvh_look(tree)->node_count, 1);
    assert_int_equal(bvh_look(tree)->block_count, 1);
    assert_int_equal(walk(bvh_look(tree), 0, times), 0);
    bvh_free(tree);
}

static void facets_without_area_or_with_nan_are_left_out(void **state)
{
    (void)state;
    const float position[][3] = {{0, 0, 0}, {1, 0, 0},   {2, 0, 0},        {0, 1, 0},
                                 {1, 1, 0}, {NAN, 0, 0}, {0, INFINITY, 0}, {1e30f, 0, 0}};
    const uint32_t none = UINT32_MAX;
    const uint32_t corner[][4] = {{0, 1, 2, none}, {0, 0, 1, none}, {0, 1, 5, none},
                                  {0, 1, 6, none}, {0, 1, 7, none}, {0, 1, 3, none},
                                  {0, 1, 4, 4}};
    bvh *tree = build(7, corner, position);
    uint32_t times[7] = {0};

    walk(bvh_look(tree), 0, times);

    assert_int_equal(bvh_look(tree)->triangle_count, 2);
    assert_int_equal(times[5], 1);
    assert_int_equal(times[6], 1);
    bvh_free(tree);
}

/* The triangles of facet 0 as twice their area, which must add up to that of the quad. */
static double twice_the_area(const bvh_tables *t)
{
    double sum = 0;

    for (int lane = 0; lane < 8; lane++) {
        const bvh_block *b = t->block;
        if (b->facet[lane] != 0) continue;
        const float ux = b->vertex[1][0][lane] - b->vertex[0][0][lane];
        const float uy = b->vertex[1][1][lane] - b->vertex[0][1][lane];
        const float vx = b->vertex[2][0][lane] - b->vertex[0][0][lane];
        const float vy = b->vertex[2][1][lane] - b->vertex[0][1][lane];
        sum += fabs((double)(ux * vy - uy * vx));
    }
    return sum;
}

static void a_concave_quad_is_cut_inside_wherever_its_corner_count_begins(void **state)
{
    (void)state;
    const float position[][3] = {{0, 0, 0}, {4, 2, 0}, {0, 4, 0}, {1, 2, 0}};

    for (uint32_t first = 0; first < 4; first++) {
        const uint32_t corner[1][4] = {{first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4}};
        bvh *tree = build(1, corner, position);

        assert_true(twice_the_area(bvh_look(tree)) == 12); /* 16 less the notch of 4 */
        bvh_free(tree);
    }
}

static void ten_thousand_facets_in_one_place_fit_the_stack(void **state)
{
    (void)state;
    enum { COUNT = 10000 };
    const float position[][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    uint32_t(*corner)[4] = malloc(COUNT * sizeof *corner);
    uint32_t *times = calloc(COUNT, sizeof *times);

    for (uint32_t i = 0; i < COUNT; i++)
        for (uint32_t k = 0; k < 4; k++) corner[i][k] = k < 3 ? k : UINT32_MAX;
    bvh *tree = build(COUNT, corner, position);

    assert_true(walk(bvh_look(tree), 0, times) <= RAY_STACK_SIZE);
    for (uint32_t i = 0; i < COUNT; i++) assert_int_equal(times[i], 1);
    bvh_free(tree);
    free(times);
    free(corner);
}

/* Each facet is a third larger and farther than the one before it, so that every split would cut off
 * the last few. */
static void facets_that_grow_without_end_fit_the_stack(void **state)
{
    (void)state;
    enum { COUNT = 240 };
    float position[3 * COUNT][3];
    uint32_t corner[COUNT][4], times[COUNT] = {0};
    float size = 1e-20f;

    for (uint32_t i = 0; i < COUNT; i++, size *= 1.3f)
        for (uint32_t k = 0; k < 3; k++) {
            position[3 * i + k][0] = size * (k == 1 ? 1.3f : 1);
            position[3 * i + k][1] = size * (k == 2 ? 1.3f : 1);
            position[3 * i + k][2] = size;
            corner[i][k] = 3 * i + k;
            corner[i][3] = UINT32_MAX;
        }
    bvh *tree = build(COUNT, corner, position);

    assert_true(walk(bvh_look(tree), 0, times) <= RAY_STACK_SIZE);
    for (uint32_t i = 0; i < COUNT; i++) assert_int_equal(times[i], 1);
    bvh_free(tree);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(both_triangles_of_every_quad_are_in_one_leaf_each),
        cmocka_unit_test(two_sided_facets_are_there_twice),
        cmocka_unit_test(the_box_is_that_of_all_vertices),
        cmocka_unit_test(the_same_facets_give_the_same_bytes),
        cmocka_unit_test(nodes_and_blocks_start_on_64_bytes),
        cmocka_unit_test(every_order_names_every_child_once),
        cmocka_unit_test(no_facets_make_a_tree_with_nothing_in_it),
        cmocka_unit_test(facets_without_area_or_with_nan_are_left_out),
        cmocka_unit_test(a_concave_quad_is_cut_inside_wherever_its_corner_count_begins),
        cmocka_unit_test(ten_thousand_facets_in_one_place_fit_the_stack),
        cmocka_unit_test(facets_that_grow_without_end_fit_the_stack),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
