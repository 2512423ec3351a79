#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdlib.h>

#include "tree/bvh_binary.h"

enum { COUNT = 3000 };

/* Boxes in a row, each a little larger than the one before it. */
static bvh_item *make_row(void)
{
    bvh_item *item = calloc(COUNT, sizeof *item);

    assert_non_null(item);
    for (uint32_t i = 0; i < COUNT; i++) {
        item[i].low[0] = (float)(i * i);
        item[i].high[0] = (float)(i * i + i);
        item[i].high[1] = item[i].high[2] = (float)i;
        item[i].triangle = i;
    }
    return item;
}

/* Returns the longest path below a fork; fails where a leaf is too large or a child's box is not
 * inside. Leaves must come in the order of the items. */
static uint32_t walk(const bvh_fork *fork, uint32_t index, uint32_t *next_item)
{
    const bvh_fork *f = &fork[index];
    uint32_t left, right;

    if (f->right == 0) {
        assert_in_range(f->count, 1, BVH_BLOCK_SIZE);
        assert_int_equal(f->first, *next_item);
        *next_item += f->count;
        return 1;
    }
    for (int k = 0; k < 3; k++) {
        assert_true(fork[index + 1].low[k] >= f->low[k] && fork[f->right].low[k] >= f->low[k]);
        assert_true(fork[index + 1].high[k] <= f->high[k] && fork[f->right].high[k] <= f->high[k]);
    }
    left = walk(fork, index + 1, next_item);
    right = walk(fork, f->right, next_item);
    return 1 + (left > right ? left : right);
}

static uint32_t longest_path(bool even)
{
    bvh_item *item = make_row();
    bvh_fork *fork = NULL;
    uint32_t fork_count, next_item = 0, path;

    assert_int_equal(bvh_binary_build(&fork, &fork_count, item, COUNT, even), STATUS_OK);
    path = walk(fork, 0, &next_item);
    assert_int_equal(next_item, COUNT);
    free(fork);
    free(item);
    return path;
}

static void every_item_is_in_one_leaf(void **state)
{
    (void)state;
    assert_in_range(longest_path(false), 10, 92); /* 64 by the heuristic, then at most 28 */
}

static void an_even_tree_has_no_longer_path_than_halving_needs(void **state)
{
    (void)state;
    assert_int_equal(longest_path(true), 10); /* 3000 / 2^9 < 8 */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_item_is_in_one_leaf),
        cmocka_unit_test(an_even_tree_has_no_longer_path_than_halving_needs),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
