#include "../assert_near.h"

#include "kernels/media/air_path.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

/* The integral of exp(-z / 2000 m) along the way in closed form, in double precision. */
static double level_m(double z_m, double up, double range_m)
{
    const double end_m = z_m + up * range_m;

    return 2000.0 / up * (exp(-z_m / 2000.0) - exp(-end_m / 2000.0));
}

static void a_way_down_holds_the_air_between_its_ends(void **state)
{
    (void)state;
    assert_near((double)air_level_m(10000.0f, -.5f, 20000.0f), level_m(10000.0, -.5, 20000.0),
                1e-5 * level_m(10000.0, -.5, 20000.0)); /* float32 */
}

/* exp(176000 / 2000) is beyond a float. */
static void a_fall_of_400_km_ends_in_the_air_at_its_end(void **state)
{
    (void)state;
    const double expected = level_m(400000.0, -.1, 4e6);

    assert_near((double)air_level_m(400000.0f, -.1f, 4e6f), expected, 1e-5 * expected);
    assert_true(isfinite(air_level_m(0.0f, -.1f, 4e6f)));
}

/* exp(a - b) where both are beyond a float: 20 km of the way are 1 height of 2000 m. */
static void the_share_of_a_deep_fall_is_what_lies_before_its_end(void **state)
{
    const air_way way = {.up = -.1f, .limit_m = 4e6f};

    (void)state;
    assert_near((double)air_fraction(way, 4e6f), 1.0, 1e-5);
    assert_near((double)air_fraction(way, 4e6f - 20000.0f), exp(-1.0),
                1e-4); /* 4e6 in float32: 1e-5 */
    assert_near((double)air_fraction(way, 1000.0f), 0.0, 1e-30);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_way_down_holds_the_air_between_its_ends),
        cmocka_unit_test(a_fall_of_400_km_ends_in_the_air_at_its_end),
        cmocka_unit_test(the_share_of_a_deep_fall_is_what_lies_before_its_end),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
