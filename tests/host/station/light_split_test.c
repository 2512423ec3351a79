#include "../assert_near.h"

#include "station/light_split.h"

/* Noon of a June day at 43 N. */
static const sun_span noon = {850.0, 110.0, 1240.0, 0.94};

static void the_diffuse_fraction_is_erbs(void **state)
{
    (void)state;
    assert_near(light_split_diffuse_fraction(0.0), 1.0, 0.0);
    assert_near(light_split_diffuse_fraction(0.2), 0.982, 1e-12);   /* 1 - 0.09 k */
    assert_near(light_split_diffuse_fraction(0.5), 0.65915, 1e-12); /* by hand */
    assert_near(light_split_diffuse_fraction(0.9), 0.165, 0.0);
    /* The pieces of the fit meet to its three digits. */
    assert_near(light_split_diffuse_fraction(0.22), light_split_diffuse_fraction(0.2201), 2e-3);
    assert_near(light_split_diffuse_fraction(0.8), light_split_diffuse_fraction(0.8001), 2e-3);
}

static void both_parts_make_the_global_irradiance_again(void **state)
{
    (void)state;
    for (double global = 50.0; global <= 1200.0; global += 50.0) {
        double direct = NAN, diffuse = NAN;
        assert_true(light_split_complete(&noon, global, &direct, &diffuse));
        assert_near(direct * noon.cos_zenith + diffuse, global, 1e-9);
        assert_true(direct >= 0.0 && diffuse >= 0.0 && direct <= 1.1 * noon.direct_w_m2 + 1e-9);
    }
}

static void one_part_follows_from_the_other(void **state)
{
    double direct = 500.0, diffuse = NAN;

    (void)state;
    assert_false(light_split_complete(&noon, 600.0, &direct, &diffuse));
    assert_near(diffuse, 600.0 - 500.0 * 0.94, 1e-9);
    direct = NAN;
    assert_false(light_split_complete(&noon, 600.0, &direct, &diffuse));
    assert_near(direct, 500.0, 1e-9);
}

static void nothing_is_made_of_nothing(void **state)
{
    const sun_span night = {0};
    double direct = NAN, diffuse = NAN;

    (void)state;
    assert_false(light_split_complete(&noon, NAN, &direct, &diffuse));
    assert_true(isnan(direct) && isnan(diffuse));
    assert_true(light_split_complete(&night, 30.0, &direct, &diffuse));
    assert_near(direct, 0.0, 0.0);
    assert_near(diffuse, 30.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_diffuse_fraction_is_erbs),
        cmocka_unit_test(both_parts_make_the_global_irradiance_again),
        cmocka_unit_test(one_part_follows_from_the_other),
        cmocka_unit_test(nothing_is_made_of_nothing),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
