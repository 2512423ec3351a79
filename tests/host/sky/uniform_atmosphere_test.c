#include "../assert_near.h"

#include "sky/planck.h"
#include "sky/uniform_atmosphere.h"

static const uniform_sky stated = {.sky_temperature_k = 260.0,
                                   .sky_radiance_w_m2_sr_um = 1.5,
                                   .sun_irradiance_w_m2_um = 7.0,
                                   .transmission = 0.8,
                                   .path_temperature_k = 290.0};

static atmosphere *make(double low_um, double high_um, bool thesis)
{
    atmosphere *a = NULL;

    if (uniform_atmosphere_make(&a, &stated, low_um, high_um, thesis) != STATUS_OK)
        fail_msg("%s", status_message());
    return a;
}

static double black_body(double wavelength_um, double temperature_k, bool thesis)
{
    return planck_spectral(planck_at(wavelength_um, thesis), temperature_k);
}

static void the_grid_runs_over_the_range_by_2_cm1_at_most(void **state)
{
    (void)state;
    atmosphere *a = make(8.0, 13.3, false);
    const int last = a->point_count - 1;

    assert_near(a->wavenumber_cm1[0], 1250.0, 1e-9);
    assert_near(a->wavenumber_cm1[last], 1e4 / 13.3, 1e-9);
    assert_true(a->wavenumber_step_cm1 <= 2.0);
    for (int i = 0; i < last; i++) {
        assert_near(a->wavenumber_cm1[i] - a->wavenumber_cm1[i + 1], a->wavenumber_step_cm1, 1e-9);
        assert_near(a->wavelength_um[i], 1e4 / a->wavenumber_cm1[i], 1e-12);
    }
    assert_near(a->wavelength_min_um, 8.0, 0.0);
    assert_near(a->wavelength_max_um, 13.3, 0.0);
    atmosphere_free(a);
}

static void the_sky_is_a_black_body_and_a_radiance_in_its_one_direction(void **state)
{
    (void)state;
    atmosphere *a = make(8.0, 13.3, false);

    assert_int_equal(a->zenith_count, 1);
    assert_int_equal(a->azimuth_count, 1);
    for (int i = 0; i < a->point_count; i += 50) {
        const double sky = black_body(a->wavelength_um[i], 260.0, false) + 1.5;
        assert_near(a->sky_emitted[i] + a->sky_scattered[i], sky, 1e-12);
        assert_near(a->sky_emitted_direction[i] + a->sky_scattered_direction[i], sky, 1e-12);
    }
    atmosphere_free(a);
}

static void the_path_dims_and_radiates_the_rest_of_its_own_temperature(void **state)
{
    (void)state;
    atmosphere *a = make(8.0, 13.3, false);

    assert_int_equal(a->path_count, 1);
    for (int i = 0; i < a->point_count; i += 50) {
        assert_near(a->tau2[i], 0.8, 0.0);
        assert_near(a->path_emitted[i] + a->path_scattered[i],
                    0.2 * black_body(a->wavelength_um[i], 290.0, false), 1e-12);
    }
    atmosphere_free(a);
}

static void the_sun_reaches_the_ground_as_stated(void **state)
{
    (void)state;
    atmosphere *a = make(0.4, 0.7, false);

    for (int i = 0; i < a->point_count; i += 500)
        assert_near(a->solar_irradiance[i] * a->tau1[i], 7.0, 1e-12);
    atmosphere_free(a);
}

static void thesis_mode_takes_its_own_constants(void **state)
{
    (void)state;
    atmosphere *a = make(3.0, 5.0, true);

    assert_near(a->sky_emitted[0], black_body(a->wavelength_um[0], 260.0, true), 1e-15);
    atmosphere_free(a);
}

static void a_narrow_range_has_its_two_ends(void **state)
{
    (void)state;
    atmosphere *a = make(10.0, 10.001, false);

    assert_int_equal(a->point_count, 2);
    assert_near(a->wavelength_um[1], 10.001, 1e-9);
    atmosphere_free(a);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grid_runs_over_the_range_by_2_cm1_at_most),
        cmocka_unit_test(the_sky_is_a_black_body_and_a_radiance_in_its_one_direction),
        cmocka_unit_test(the_path_dims_and_radiates_the_rest_of_its_own_temperature),
        cmocka_unit_test(the_sun_reaches_the_ground_as_stated),
        cmocka_unit_test(thesis_mode_takes_its_own_constants),
        cmocka_unit_test(a_narrow_range_has_its_two_ends),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
