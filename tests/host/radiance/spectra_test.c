#include "../assert_near.h"

#include "radiance/spectra.h"
#include "sky/planck.h"

#include <stdlib.h>

/* Two paths and a sky of 2 x 3 directions; every value names its spectrum and its wavenumber. */
enum { POINTS = 28, PATHS = 2, ZENITHS = 2, AZIMUTHS = 3 };

static double wavenumber_cm1[POINTS], wavelength_um[POINTS];
static double table[4 + 3 * PATHS + 2 * ZENITHS * AZIMUTHS][POINTS];
static atmosphere air = {
    .point_count = POINTS,
    .wavenumber_cm1 = wavenumber_cm1,
    .wavelength_um = wavelength_um,
    .wavenumber_step_cm1 = 20.0,
    .solar_irradiance = table[0],
    .tau1 = table[1],
    .sky_emitted = table[2],
    .sky_scattered = table[3],
    .path_count = PATHS,
    .tau2 = table[4],
    .path_emitted = table[4 + PATHS],
    .path_scattered = table[4 + 2 * PATHS],
    .zenith_count = ZENITHS,
    .azimuth_count = AZIMUTHS,
    .sky_emitted_direction = table[4 + 3 * PATHS],
    .sky_scattered_direction = table[4 + 3 * PATHS + ZENITHS * AZIMUTHS],
};
static band bands[2] = {
    {.name = "long", .low_um = 8.0, .high_um = 13.3, .gain = 3.0, .offset = -1.0, .is_mean = true},
    {.name = "short", .low_um = 9.0, .high_um = 9.3, .gain = 1.0},
};

/* Linear in wavenumber, so that a look-up between points is exact. */
static double entry(size_t row, double nu)
{
    return (double)row + 1.0 + 1e-3 * nu;
}

static int make_database(void **state)
{
    (void)state;
    for (int i = 0; i < POINTS; i++) {
        wavenumber_cm1[i] = 1260.0 - 20.0 * i;
        wavelength_um[i] = 1e4 / wavenumber_cm1[i];
        for (size_t row = 0; row < sizeof table / sizeof *table; row++)
            table[row][i] = entry(row, wavenumber_cm1[i]);
    }
    return 0;
}

static spectra *build(bool thesis)
{
    spectra *s = NULL;

    if (spectra_build(&s, bands, 2, &air, thesis ? BAND_DATABASE_POINTS : BAND_FINE, thesis) !=
        STATUS_OK)
        fail_msg("%s", status_message());
    return s;
}

static double at(const spectra *s, uint32_t row, uint32_t sample)
{
    return (double)s->rows[(size_t)row * s->sample_count + sample];
}

static void bands_are_runs_of_one_row_from_edge_to_edge(void **state)
{
    (void)state;
    spectra *s = build(false);
    for (uint32_t b = 0; b < 2; b++) {
        const double *nu = s->wavenumber_cm1 + s->bands[b].first_sample;
        assert_near(nu[0], 1e4 / bands[b].low_um, 1e-9);
        assert_near(nu[s->bands[b].sample_count - 1], 1e4 / bands[b].high_um, 1e-9);
    }
    assert_int_equal(s->bands[0].first_sample, 0); /* 8 to 13.3 um holds the other band */
    assert_int_equal(s->sample_count % 16, 0);
    assert_int_equal(s->row_count, SPECTRA_PATHS + 2 * PATHS + ZENITHS * AZIMUTHS);
    spectra_free(s);
}

static void bands_that_share_an_edge_share_its_sample(void **state)
{
    const band halves[2] = {{.name = "low", .low_um = 9.0, .high_um = 9.01},
                            {.name = "high", .low_um = 9.01, .high_um = 9.02}};
    spectra *s = NULL;

    (void)state;
    assert_int_equal(spectra_build(&s, halves, 2, &air, BAND_FINE, false), STATUS_OK);
    /* Both are 1.23 cm-1 wide, a step each, and no point of the database is in them. */
    assert_int_equal(s->sample_count, 16);
    assert_near(s->wavenumber_cm1[1], 1e4 / 9.01, 1e-9);
    assert_near(s->wavenumber_cm1[2], 1e4 / 9.02, 1e-9);
    assert_near((double)s->weight_um[s->bands[0].first_weight + 1], 0.005, 1e-9);
    assert_near((double)s->weight_um[s->bands[1].first_weight + 1], 0.005, 1e-9);
    assert_near(at(s, SPECTRA_WEIGHT, 1), 0.01, 1e-9);
    spectra_free(s);
}

static void a_block_does_not_go_over_a_gap_between_bands(void **state)
{
    const band apart[2] = {{.name = "high", .low_um = 12.0, .high_um = 12.01},
                           {.name = "low", .low_um = 9.0, .high_um = 9.01}};
    spectra *s = NULL;

    (void)state;
    assert_int_equal(spectra_build(&s, apart, 2, &air, BAND_FINE, false), STATUS_OK);
    assert_int_equal(s->sample_count, 32);
    assert_int_equal(s->bands[0].first_sample, 16);
    assert_int_equal(s->bands[1].first_sample, 0);
    spectra_free(s);
}

static void the_weights_of_a_band_sum_up_to_its_width(void **state)
{
    (void)state;
    spectra *s = build(false);

    for (uint32_t b = 0; b < 2; b++) {
        const double width = bands[b].high_um - bands[b].low_um;
        double sum = 0.0;
        for (uint32_t i = 0; i < s->bands[b].sample_count; i++)
            sum += (double)s->weight_um[s->bands[b].first_weight + i];
        assert_near(sum, width, 1e-7 * width); /* weights are rounded to float */
        assert_near(s->width_um[b], width, 1e-12);
        assert_near((double)s->bands[b].width_um, width, 1e-7 * width);
    }
    spectra_free(s);
}

static void padding_has_weight_0_and_finite_spectra(void **state)
{
    (void)state;
    spectra *s = build(true); /* the database's points 1240, 1220 .. 760 cm-1 */

    assert_int_equal(s->bands[0].sample_count, 25);
    assert_int_equal(s->sample_count, 32);
    for (uint32_t i = 25; i < s->sample_count; i++) {
        assert_near(at(s, SPECTRA_WEIGHT, i), 0.0, 0.0);
        for (uint32_t row = 1; row < s->row_count; row++)
            assert_near(at(s, row, i), at(s, row, 24), 0.0);
    }
    spectra_free(s);
}

static void what_the_kernel_multiplies_is_multiplied_and_added_here(void **state)
{
    const size_t directions = ZENITHS * AZIMUTHS;

    (void)state;
    spectra *s = build(false);
    for (uint32_t i = 0; i < s->sample_count; i += 7) {
        const double nu = s->wavenumber_cm1[i], rounding = 1e-5; /* floats up to 60 */
        assert_near(at(s, SPECTRA_SUN, i), entry(0, nu) * entry(1, nu), rounding);
        assert_near(at(s, SPECTRA_SKY, i), entry(2, nu) + entry(3, nu), rounding);
        for (uint32_t p = 0; p < PATHS; p++) {
            assert_near(at(s, SPECTRA_PATHS + p, i), entry(4 + p, nu), rounding);
            assert_near(at(s, SPECTRA_PATHS + PATHS + p, i),
                        entry(4 + PATHS + p, nu) + entry(4 + 2 * PATHS + p, nu), rounding);
        }
        for (uint32_t d = 0; d < directions; d++)
            assert_near(at(s, SPECTRA_PATHS + 2 * PATHS + d, i),
                        entry(4 + 3 * PATHS + d, nu) + entry(4 + 3 * PATHS + directions + d, nu),
                        rounding);
    }
    spectra_free(s);
}

static void planck_s_terms_are_those_of_each_sample(void **state)
{
    (void)state;
    for (int thesis = 0; thesis < 2; thesis++) {
        spectra *s = build(thesis);
        for (uint32_t i = 0; i < s->sample_count; i++) {
            const planck_terms terms = planck_at(1e4 / s->wavenumber_cm1[i], thesis);
            assert_near(at(s, SPECTRA_PLANCK_FIRST, i), terms.first, 6e-8 * terms.first);
            assert_near(at(s, SPECTRA_PLANCK_SECOND, i), terms.second, 6e-8 * terms.second);
        }
        spectra_free(s);
    }
}

static void gain_offset_and_mean_go_to_the_kernel(void **state)
{
    (void)state;
    spectra *s = build(false);

    assert_near((double)s->bands[0].gain, 3.0, 0.0);
    assert_near((double)s->bands[0].offset, -1.0, 0.0);
    assert_int_equal(s->bands[0].is_mean, 1);
    assert_int_equal(s->bands[1].is_mean, 0);
    assert_near(s->centre_um[1], 9.15, 1e-5); /* trapezoids of 2 cm-1 */
    spectra_free(s);
}

static void a_band_beyond_the_database_fails(void **state)
{
    const band beyond = {.name = "mwir", .low_um = 3.0, .high_um = 5.0};
    spectra *s = NULL;

    (void)state;
    assert_int_equal(spectra_build(&s, &beyond, 1, &air, BAND_FINE, false), STATUS_ARGUMENT);
    assert_null(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(bands_are_runs_of_one_row_from_edge_to_edge),
        cmocka_unit_test(bands_that_share_an_edge_share_its_sample),
        cmocka_unit_test(a_block_does_not_go_over_a_gap_between_bands),
        cmocka_unit_test(the_weights_of_a_band_sum_up_to_its_width),
        cmocka_unit_test(padding_has_weight_0_and_finite_spectra),
        cmocka_unit_test(what_the_kernel_multiplies_is_multiplied_and_added_here),
        cmocka_unit_test(planck_s_terms_are_those_of_each_sample),
        cmocka_unit_test(gain_offset_and_mean_go_to_the_kernel),
        cmocka_unit_test(a_band_beyond_the_database_fails),
    };

    return cmocka_run_group_tests(tests, make_database, NULL);
}
