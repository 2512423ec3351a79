#include "thermal/value_check.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

static void surfaces_have_1_to_6000_k(void **state)
{
    (void)state;
    assert_true(value_check_kelvin(1.0f));
    assert_true(value_check_kelvin(6000.0f));
    assert_false(value_check_kelvin(.9f));
    assert_false(value_check_kelvin(6001.0f));
    assert_false(value_check_kelvin(-1838.0f));
    assert_false(value_check_kelvin(NAN));
    assert_false(value_check_kelvin(INFINITY));
}

static void the_first_value_that_is_not_finite_is_found(void **state)
{
    const float good[] = {-9999.0f, 0.0f, 3e38f}, bad[] = {1.0f, 2.0f, NAN, INFINITY};

    (void)state;
    assert_int_equal(value_check_finite(good, 3), 3);
    assert_int_equal(value_check_finite(bad, 4), 2);
    assert_int_equal(value_check_finite(bad + 3, 1), 0);
}

/* A surface of 1 K is at -272.15 C in single precision, 0.0000153 K beside it. */
static void no_value_is_no_temperature_and_1_k_is_one(void **state)
{
    const float good[] = {-9999.0f, -272.15f, 26.85f, 5726.85f}, bad[] = {20.0f, -273.15f};

    (void)state;
    assert_int_equal(value_check_celsius(good, 4), 4);
    assert_int_equal(value_check_celsius(bad, 2), 1);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(surfaces_have_1_to_6000_k),
        cmocka_unit_test(the_first_value_that_is_not_finite_is_found),
        cmocka_unit_test(no_value_is_no_temperature_and_1_k_is_one),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
