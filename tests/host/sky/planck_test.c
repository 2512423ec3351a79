#include "../assert_near.h"

#include "sky/planck.h"

static const double SIGMA = 5.670374419e-8; /* CODATA 2018, W m-2 K-4 */

static void a_black_body_at_300_k_radiates_9_924_at_10_um(void **state)
{
    (void)state;
    /* h c / k stands in constants.h with ten digits. */
    assert_near(planck_spectral(planck_at(10.0, false), 300.0), 9.92403333, 2e-8);
}

static void all_wavelengths_together_give_stefan_and_boltzmann(void **state)
{
    double sum = 0.0;

    (void)state;
    for (int i = 0; i < 200000; i++) { /* in ln of the wavelength, 0.3 to 3000 um */
        const double step = log(1e4) / 200000, l = .3 * exp((i + .5) * step);
        sum += planck_spectral(planck_at(l, false), 1000.0) * l * step;
    }
    /* Beyond 3000 um 15 (lT/c2)^-3 / 3 pi^4 = 6e-10 of all is left; CODATA's sigma has ten digits. */
    assert_near(sum * M_PI / (SIGMA * 1e12), 1.0, 1e-8);
}

static void the_peak_lies_where_wien_says(void **state)
{
    (void)state;
    const double peak_um = 2897.771955 / 300.0; /* Wien's constant, um K */
    const double there = planck_spectral(planck_at(peak_um, false), 300.0);

    assert_true(there > planck_spectral(planck_at(peak_um * 1.001, false), 300.0));
    assert_true(there > planck_spectral(planck_at(peak_um / 1.001, false), 300.0));
}

static void a_cold_body_radiates_nothing_in_the_visible(void **state)
{
    (void)state;
    assert_near(planck_spectral(planck_at(.4, false), 1.0), 0.0, 0.0); /* e^-36000 */
}

static void long_waves_follow_rayleigh_and_jeans(void **state)
{
    (void)state;
    const planck_terms far = planck_at(1e9, false); /* 2 c k T / l^4, off by half the exponent */

    assert_near(planck_spectral(far, 300.0) * far.second / (far.first * 300.0), 1.0, 1e-7);
}

static void thesis_mode_takes_the_constants_printed_there(void **state)
{
    (void)state;
    const double c = 2.99792458e8, h = 6.626176e-34, k = 1.380662e-23; /* below eq. 2.4-5 */
    const planck_terms terms = planck_at(4.0, true);

    assert_near(terms.first / (2e24 * h * c * c / 1024.0), 1.0, 1e-14);
    assert_near(terms.second / (1e6 * h * c / (k * 4.0)), 1.0, 1e-14);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_black_body_at_300_k_radiates_9_924_at_10_um),
        cmocka_unit_test(all_wavelengths_together_give_stefan_and_boltzmann),
        cmocka_unit_test(the_peak_lies_where_wien_says),
        cmocka_unit_test(a_cold_body_radiates_nothing_in_the_visible),
        cmocka_unit_test(long_waves_follow_rayleigh_and_jeans),
        cmocka_unit_test(thesis_mode_takes_the_constants_printed_there),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
