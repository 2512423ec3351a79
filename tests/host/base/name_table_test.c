#include "base/name_table.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdio.h>

#include <cmocka.h>

static uint32_t number_of(name_table *table, uint32_t owner, const char *name)
{
    uint32_t number = UINT32_MAX;

    assert_int_equal(name_table_number(table, owner, name, &number), STATUS_OK);
    return number;
}

static void names_are_numbered_in_the_order_of_their_first_appearance(void **state)
{
    name_table *table = NULL;

    (void)state;
    assert_int_equal(name_table_open(&table), STATUS_OK);
    assert_int_equal(number_of(table, 0, "wall"), 0);
    assert_int_equal(number_of(table, 0, "roof"), 1);
    assert_int_equal(number_of(table, 0, "wall"), 0);
    assert_int_equal(number_of(table, 0, ""), 2);
    assert_int_equal(name_table_count(table), 3);
    name_table_free(table);
}

static void one_name_of_two_owners_has_two_numbers(void **state)
{
    name_table *table = NULL;

    (void)state;
    assert_int_equal(name_table_open(&table), STATUS_OK);
    assert_int_equal(number_of(table, 1, "wall"), 0);
    assert_int_equal(number_of(table, 2, "wall"), 1);
    assert_int_equal(number_of(table, 1, "wall"), 0);
    name_table_free(table);
}

static void a_hundred_thousand_names_keep_their_numbers(void **state)
{
    enum { NAMES = 100000 };
    name_table *table = NULL;
    char name[16];

    (void)state;
    assert_int_equal(name_table_open(&table), STATUS_OK);
    for (uint32_t i = 0; i < 2 * NAMES; i++) {
        snprintf(name, sizeof name, "part_%u", i % NAMES);
        assert_int_equal(number_of(table, 0, name), i % NAMES);
    }
    name_table_free(table);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(names_are_numbered_in_the_order_of_their_first_appearance),
        cmocka_unit_test(one_name_of_two_owners_has_two_numbers),
        cmocka_unit_test(a_hundred_thousand_names_keep_their_numbers),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
