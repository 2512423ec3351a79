/* The span of a colour bar and its ticks. */
#include "image/value_range.h"

#include "../assert_near.h"

#include <stdlib.h>

static void percentiles_are_values_of_the_nearest_rank(void **state)
{
    float value[1001];
    value_range range;
    (void)state;

    for (int i = 0; i < 1001; i++) value[i] = (float)((i * 8) % 1001 - 500); /* each of -500..500 */

    assert_int_equal(value_range_find(&range, value, 1001, -9999.0f), STATUS_OK);
    assert_near(range.min, -495.0, 0.0); /* rank 5 of 0..1000 */
    assert_near(range.max, 495.0, 0.0);
    assert_int_equal(range.valid_count, 1001);
}

static void missing_values_do_not_count(void **state)
{
    const float value[] = {3.0f, -9999.0f, NAN, INFINITY, 5.0f};
    value_range range;
    (void)state;

    assert_int_equal(value_range_find(&range, value, 5, -9999.0f), STATUS_OK);
    assert_near(range.min, 3.0, 0.0);
    assert_near(range.max, 5.0, 0.0);
    assert_int_equal(range.valid_count, 2);
    assert_int_equal(range.missing_count, 3);
}

static void a_constant_plane_lies_in_the_middle_of_its_range(void **state)
{
    const float value[] = {300.0f, 300.0f}, zero[] = {0.0f};
    value_range range;
    (void)state;

    assert_int_equal(value_range_find(&range, value, 2, -9999.0f), STATUS_OK);
    assert_near(range.min, 297.0, 1e-12);
    assert_near(range.max, 303.0, 1e-12);
    assert_int_equal(value_range_find(&range, zero, 1, -9999.0f), STATUS_OK);
    assert_near(range.min, -0.5, 0.0);
}

static void steps_are_one_two_five_times_a_power_of_ten(void **state)
{
    (void)state;
    assert_near(value_range_step(0.7), 1.0, 1e-12);
    assert_near(value_range_step(1.0), 1.0, 1e-12);
    assert_near(value_range_step(13.0), 20.0, 1e-12);
    assert_near(value_range_step(0.021), 0.05, 1e-12);
    assert_near(value_range_step(0.2), 0.2, 1e-12);
}

static void assert_label(double value, double step, const char *expected)
{
    char text[64];

    value_range_label(text, sizeof text, value, step);
    assert_string_equal(text, expected);
}

static void labels_have_the_digits_of_their_step(void **state)
{
    (void)state;
    assert_label(40.0, 5.0, "40");
    assert_label(0.2, 0.2, "0.2");
    assert_label(0.30000000000000004, 0.05, "0.30");
    assert_label(-1e-17, 0.1, "0.0");
    assert_label(2e9, 1e9, "2e+09");
}

static void ticks_are_the_multiples_of_the_step_in_the_range(void **state)
{
    const value_range range = {.min = -0.5, .max = 1.0};
    double tick[VALUE_RANGE_TICKS];
    (void)state;

    assert_int_equal(value_range_ticks(&range, 0.5, tick), 4);
    for (int i = 0; i < 4; i++) assert_true(tick[i] == -0.5 + 0.5 * i);
}

/* Above 2^53 the next multiple of 1 may be the same double. */
static void ticks_end_where_numbers_are_too_coarse_for_the_step(void **state)
{
    const value_range coarse = {.min = 9007199254740992.0, .max = 9007199254740994.0};
    const value_range point = {.min = 3.0, .max = 3.0};
    double tick[VALUE_RANGE_TICKS];
    (void)state;

    assert_in_range(value_range_ticks(&coarse, 0.2, tick), 1, VALUE_RANGE_TICKS);
    assert_in_range(value_range_ticks(&point, 0.0, tick), 0, VALUE_RANGE_TICKS);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(percentiles_are_values_of_the_nearest_rank),
        cmocka_unit_test(missing_values_do_not_count),
        cmocka_unit_test(a_constant_plane_lies_in_the_middle_of_its_range),
        cmocka_unit_test(steps_are_one_two_five_times_a_power_of_ten),
        cmocka_unit_test(labels_have_the_digits_of_their_step),
        cmocka_unit_test(ticks_are_the_multiples_of_the_step_in_the_range),
        cmocka_unit_test(ticks_end_where_numbers_are_too_coarse_for_the_step),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
