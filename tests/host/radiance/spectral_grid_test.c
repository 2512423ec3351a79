#include "../assert_near.h"

#include "radiance/spectral_grid.h"
#include "sky/planck.h"

#include <stdlib.h>

/* A database of 20 cm-1 steps, whose points are none of the emissivities'. */
enum { POINTS = 28 };

static double wavenumber_cm1[POINTS], wavelength_um[POINTS], even[POINTS], zigzag[POINTS];
static atmosphere air = {
    .point_count = POINTS,
    .wavenumber_cm1 = wavenumber_cm1,
    .wavelength_um = wavelength_um,
    .wavenumber_step_cm1 = 20.0,
    .solar_irradiance = zigzag,
    .tau1 = even,
    .sky_emitted = zigzag,
    .sky_scattered = even,
    .path_count = 1,
    .tau2 = even,
    .path_emitted = even,
    .path_scattered = even,
    .zenith_count = 1,
    .azimuth_count = 1,
    .sky_emitted_direction = zigzag,
    .sky_scattered_direction = even,
};
static band bands[2] = {{.name = "long", .low_um = 8.0, .high_um = 9.0, .gain = 1.0},
                        {.name = "longer", .low_um = 10.0, .high_um = 13.0, .gain = 1.0}};

static int make_database(void **state)
{
    (void)state;
    for (int i = 0; i < POINTS; i++) {
        wavenumber_cm1[i] = 1267.0 - 20.0 * i;
        wavelength_um[i] = 1e4 / wavenumber_cm1[i];
        even[i] = 1.0;
        zigzag[i] = 2.0 + i % 2;
    }
    return 0;
}

static spectral_grid *find(spectra **out_spectra, bool all)
{
    spectral_grid *k = NULL;

    assert_int_equal(spectra_build(out_spectra, bands, 2, &air, BAND_FINE, false), STATUS_OK);
    assert_int_equal(spectral_grid_find(&k, *out_spectra, &air, all), STATUS_OK);
    return k;
}

/* What stands at a sample when a row at the knots is drawn straight between them. */
static double between(const spectral_grid *k, const float *at_knots, uint32_t sample)
{
    const uint32_t block = sample / SPECTRA_BLOCK;
    double sum = 0.0;

    for (uint32_t i = 0; i < k->span; i++) {
        const size_t place = ((size_t)block * k->span + i) * SPECTRA_BLOCK + sample % SPECTRA_BLOCK;
        sum += (double)at_knots[k->first[block] + i] * (double)k->fraction[place];
    }
    return sum;
}

static void rows_that_bend_at_points_of_tables_are_kept(void **state)
{
    spectra *s = NULL;
    spectral_grid *k = find(&s, false);
    const float *whole = s->rows + (size_t)SPECTRA_SUN * s->sample_count;
    const float *picked = k->spectra->rows + (size_t)SPECTRA_SUN * k->spectra->sample_count;

    (void)state;
    assert_true(3 * k->spectra->sample_count < s->sample_count);
    for (uint32_t i = 0; i < s->sample_count; i++)
        assert_near(between(k, picked, i), (double)whole[i], 1e-6);
    spectral_grid_free(k);
    spectra_free(s);
}

/* Its bend over 10 cm-1 is h^2 / 8 times (5 / nu - c2 / T)^2 - 5 / nu^2, 7e-5 at 13 um. */
static void planck_is_nearly_straight_between_knots(void **state)
{
    spectra *s = NULL;
    spectral_grid *k = find(&s, false);
    float *at_knots = malloc(k->spectra->sample_count * sizeof *at_knots);

    (void)state;
    for (uint32_t i = 0; i < k->spectra->sample_count; i++)
        at_knots[i] =
            (float)planck_spectral(planck_at(1e4 / k->spectra->wavenumber_cm1[i], false), 300.0);
    for (uint32_t i = 0; i < s->sample_count; i++) {
        const double exact = planck_spectral(planck_at(1e4 / s->wavenumber_cm1[i], false), 300.0);
        assert_near(between(k, at_knots, i), exact, 8e-5 * exact);
    }
    free(at_knots);
    spectral_grid_free(k);
    spectra_free(s);
}

static void weights_go_to_the_knots(void **state)
{
    spectra *s = NULL;
    spectral_grid *k = find(&s, false);
    double sum = 0.0;

    (void)state;
    for (uint32_t i = 0; i < k->spectra->sample_count; i++) sum += (double)k->spectra->rows[i];
    assert_near(sum, 1.0 + 3.0, 1e-5); /* um */
    spectral_grid_free(k);
    spectra_free(s);
}

/* Samples that pad a run have its last knot. */
static void no_knot_lies_between_two_runs(void **state)
{
    spectra *s = NULL;
    spectral_grid *k = find(&s, false);
    const double from_cm1 = 1e4 / 10.0, to_cm1 = 1e4 / 9.0;

    (void)state;
    for (uint32_t i = 0; i < k->spectra->sample_count; i++)
        assert_true(k->spectra->wavenumber_cm1[i] >= to_cm1 - 1e-9 ||
                    k->spectra->wavenumber_cm1[i] <= from_cm1 + 1e-9);
    for (uint32_t b = 0; b < s->sample_count / SPECTRA_BLOCK; b++)
        assert_true(k->first[b] + k->span <= k->spectra->sample_count);
    spectral_grid_free(k);
    spectra_free(s);
}

static void every_sample_is_one_where_that_is_asked_for(void **state)
{
    spectra *s = NULL;
    spectral_grid *k = find(&s, true);

    (void)state;
    assert_int_equal(k->span, 0);
    assert_int_equal(k->spectra->sample_count, s->sample_count);
    for (uint32_t i = 0; i < s->sample_count; i++) assert_int_equal(k->sample[i], i);
    spectral_grid_free(k);
    spectra_free(s);
}

/* Of emissivities every 100 cm-1, as of the database, one in the middle between its points: they are no knots. */
static void a_coarse_database_alone_has_knots(void **state)
{
    band visible = {
        .name = "visible", .low_um = 1e4 / 17300.0, .high_um = 1e4 / 14700.0, .gain = 1.0};
    spectra *s = NULL;
    spectral_grid *k = NULL;

    (void)state;
    for (int i = 0; i < POINTS; i++) wavenumber_cm1[i] = 17400.0 - 100.0 * i;
    air.wavenumber_step_cm1 = 100.0;
    assert_int_equal(spectra_build(&s, &visible, 1, &air, BAND_FINE, false), STATUS_OK);
    assert_int_equal(spectral_grid_find(&k, s, &air, false), STATUS_OK);
    for (uint32_t i = 0; i < k->spectra->sample_count; i++)
        assert_near(fmod(k->spectra->wavenumber_cm1[i] + 50.0, 100.0), 50.0, 1e-6);
    spectral_grid_free(k);
    spectra_free(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(rows_that_bend_at_points_of_tables_are_kept),
        cmocka_unit_test(planck_is_nearly_straight_between_knots),
        cmocka_unit_test(weights_go_to_the_knots),
        cmocka_unit_test(no_knot_lies_between_two_runs),
        cmocka_unit_test(every_sample_is_one_where_that_is_asked_for),
        cmocka_unit_test(a_coarse_database_alone_has_knots), /* the last: it changes the database */
    };

    return cmocka_run_group_tests(tests, make_database, NULL);
}
