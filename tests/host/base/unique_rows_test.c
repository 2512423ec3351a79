#include "base/unique_rows.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

static void equal_rows_share_a_group_in_the_order_of_their_first(void **state)
{
    const uint32_t rows[6][2] = {{7, 1}, {7, 2}, {7, 1}, {1, 7}, {7, 2}, {7, 1}};
    const uint32_t expected[6] = {0, 1, 0, 2, 1, 0};
    uint32_t group[6], first[6];
    size_t count;

    (void)state;
    assert_int_equal(unique_rows(&rows[0][0], 2, 6, group, first, &count), STATUS_OK);

    assert_int_equal(count, 3);
    assert_memory_equal(group, expected, sizeof expected);
    assert_int_equal(first[2], 3);
}

static void no_rows_have_no_group(void **state)
{
    uint32_t group[1] = {0}, first[1];
    size_t count = 9;

    (void)state;
    assert_int_equal(unique_rows(group, 4, 0, group, first, &count), STATUS_OK);

    assert_int_equal(count, 0);
}

static void a_hundred_thousand_rows_of_a_thousand_kinds_are_told_apart(void **state)
{
    enum { ROWS = 100000, KINDS = 1000 };
    uint32_t *rows = malloc(ROWS * sizeof *rows), *group = malloc(ROWS * sizeof *group);
    uint32_t *first = malloc(ROWS * sizeof *first);
    size_t count = 0;

    (void)state;
    for (uint32_t i = 0; i < ROWS; i++) rows[i] = (i * 7919u) % KINDS << 20;
    assert_int_equal(unique_rows(rows, 1, ROWS, group, first, &count), STATUS_OK);

    assert_int_equal(count, KINDS);
    for (uint32_t i = 0; i < ROWS; i++) assert_int_equal(rows[first[group[i]]], rows[i]);
    free(first);
    free(group);
    free(rows);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(equal_rows_share_a_group_in_the_order_of_their_first),
        cmocka_unit_test(no_rows_have_no_group),
        cmocka_unit_test(a_hundred_thousand_rows_of_a_thousand_kinds_are_told_apart),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
