#include "tree/bvh_wide.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>

#include <cmocka.h>

enum { PLACES = 200 };

/* Builds forks over leaves first .. first + count - 1, unit cubes at x of their own, halves of equal
 * count; returns how many places they took. */
static uint32_t fork_line(bvh_fork *fork, uint32_t place, const float *x, uint32_t first,
                          uint32_t count)
{
    uint32_t used = 1;

    fork[place] = (bvh_fork){{x[first], 0, 0}, {x[first + count - 1] + 1, 1, 1}, 0, first, count};
    if (count == 1) return 1;
    used += fork_line(fork, place + used, x, first, count / 2);
    fork[place].right = place + used;
    return used + fork_line(fork, place + used, x, first + count / 2, count - count / 2);
}

static uint32_t children_of_line(const float *x, uint32_t count, bvh_fork fork[PLACES],
                                 uint32_t child[BVH_CHILDREN])
{
    uint32_t *plan = NULL;

    const uint32_t places = fork_line(fork, 0, x, 0, count);
    assert_int_equal(bvh_wide_plan(&plan, fork, places), STATUS_OK);
    const uint32_t found = bvh_wide_children(plan, fork, 0, child);
    free(plan);
    return found;
}

static void eight_leaves_hang_in_one_node(void **state)
{
    const float x[8] = {0, 2, 4, 6, 8, 10, 12, 14};
    uint32_t child[BVH_CHILDREN];
    bvh_fork fork[PLACES];

    assert_int_equal(children_of_line(x, 8, fork, child), 8);
    for (uint32_t i = 0; i < 8; i++) {
        assert_int_equal(fork[child[i]].count, 1);
        assert_int_equal(fork[child[i]].first, i);
    }
    (void)state;
}

/* One pair needs a node of its own: the one with the least area. */
static void of_nine_leaves_the_two_nearest_stay_together(void **state)
{
    const float x[9] = {0, 2, 4, 5.5f, 8, 10, 12, 14, 16};
    uint32_t child[BVH_CHILDREN];
    bvh_fork fork[PLACES];

    assert_int_equal(children_of_line(x, 9, fork, child), 8);
    for (uint32_t i = 0; i < 8; i++)
        assert_int_equal(fork[child[i]].count, fork[child[i]].first == 2 ? 2 : 1);
    (void)state;
}

static void sixty_four_leaves_have_nodes_of_eight(void **state)
{
    float x[64];
    uint32_t child[BVH_CHILDREN];
    bvh_fork fork[PLACES];

    for (uint32_t i = 0; i < 64; i++) x[i] = 2.0f * (float)i;
    assert_int_equal(children_of_line(x, 64, fork, child), 8);
    for (uint32_t i = 0; i < 8; i++) assert_int_equal(fork[child[i]].count, 8);
    (void)state;
}

static void a_tree_of_one_leaf_has_one_child(void **state)
{
    const float x[1] = {3};
    uint32_t child[BVH_CHILDREN];
    bvh_fork fork[PLACES];

    assert_int_equal(children_of_line(x, 1, fork, child), 1);
    assert_int_equal(child[0], 0);
    (void)state;
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(eight_leaves_hang_in_one_node),
        cmocka_unit_test(of_nine_leaves_the_two_nearest_stay_together),
        cmocka_unit_test(sixty_four_leaves_have_nodes_of_eight),
        cmocka_unit_test(a_tree_of_one_leaf_has_one_child),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
