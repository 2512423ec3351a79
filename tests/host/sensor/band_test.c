#include "../assert_near.h"

#include "sensor/band.h"
#include "sky/planck.h"

#include <stdlib.h>
#include <string.h>

/* A database of 1800 .. 700 cm-1 by 20. */
enum { POINTS = 56, TRIALS = 200, DENSE = 20000 };

static double wavelength_um[POINTS], wavenumber_cm1[POINTS], value[POINTS];
static double low_um, high_um; /* of the database */
static atmosphere air = {.point_count = POINTS,
                         .wavelength_um = wavelength_um,
                         .wavenumber_cm1 = wavenumber_cm1,
                         .wavenumber_step_cm1 = 20.0};

static double uniform(double low, double high)
{
    return low + (high - low) * rand() / RAND_MAX;
}

static int make_database(void **state)
{
    (void)state;
    srand(1994);
    for (int i = 0; i < POINTS; i++) {
        wavenumber_cm1[i] = 1800.0 - 20.0 * i;
        wavelength_um[i] = 1e4 / wavenumber_cm1[i];
        value[i] = uniform(0.0, 10.0);
    }
    low_um = wavelength_um[0];
    high_um = wavelength_um[POINTS - 1];
    return 0;
}

static band_samples sample(band b, band_quadrature rule)
{
    band_samples samples;

    if (band_sample(&samples, &b, &air, rule) != STATUS_OK) fail_msg("%s", status_message());
    return samples;
}

/* A band of at least 0.05 um with its edges anywhere in the database. */
static band random_band(void)
{
    const double low = uniform(low_um, high_um - .05);

    return (band){.name = "random", .low_um = low, .high_um = uniform(low + .05, high_um)};
}

static double sum_of(const band_samples *s, double (*spectrum)(double wavenumber_cm1))
{
    double sum = 0.0;

    for (int i = 0; i < s->count; i++) sum += s->weight_um[i] * spectrum(s->wavenumber_cm1[i]);
    return sum;
}

/* Midpoints in wavelength. */
static double dense(double low, double high, double (*spectrum)(double wavenumber_cm1))
{
    const double step = (high - low) / DENSE;
    double sum = 0.0;

    for (int i = 0; i < DENSE; i++) sum += step * spectrum(1e4 / (low + (i + .5) * step));
    return sum;
}

static double one(double wavenumber)
{
    (void)wavenumber;
    return 1.0;
}

static double black_body(double wavenumber)
{
    return planck_spectral(planck_at(1e4 / wavenumber, false), 300.0);
}

/* Linear in wavenumber between the points, by its own search. */
static double tabulated(double wavenumber)
{
    int i = 0;

    while (i + 2 < POINTS && wavenumber_cm1[i + 1] > wavenumber) i++;
    return value[i] + (value[i + 1] - value[i]) * (wavenumber_cm1[i] - wavenumber) / 20.0;
}

static void the_weights_of_any_band_sum_up_to_its_width(void **state)
{
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        const band b = random_band();
        band_samples s = sample(b, BAND_FINE);
        const double width = b.high_um - b.low_um;
        assert_near(sum_of(&s, one), width, 1e-12 * width); /* double */
        assert_near(s.width_um, width, 1e-12 * width);
        band_samples_free(&s);
    }
}

static void samples_run_from_edge_to_edge_without_gaps(void **state)
{
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        const band b = random_band();
        band_samples s = sample(b, BAND_FINE);
        assert_near(1e4 / s.wavenumber_cm1[0], b.low_um, 1e-12);
        assert_near(1e4 / s.wavenumber_cm1[s.count - 1], b.high_um, 1e-12);
        for (int k = 1; k < s.count; k++) {
            const double step = s.wavenumber_cm1[k - 1] - s.wavenumber_cm1[k];
            assert_true(step > 0.0 && step < 2.0 + 1e-9);
        }
        band_samples_free(&s);
    }
}

static void a_smooth_spectrum_is_integrated_to_2e_6(void **state)
{
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        const band b = random_band();
        band_samples s = sample(b, BAND_FINE);
        const double expected = dense(b.low_um, b.high_um, black_body);
        /* Trapezoids of 2 cm-1, at most 0.04 um: step^2 / 12 x B'' / B of about 0.2 um-2. */
        assert_near(sum_of(&s, black_body), expected, 2e-6 * expected);
        band_samples_free(&s);
    }
}

static void a_tabulated_spectrum_is_integrated_to_2e_4(void **state)
{
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        const band b = random_band();
        band_samples s = sample(b, BAND_FINE);
        const double expected = dense(b.low_um, b.high_um, tabulated);
        assert_near(sum_of(&s, tabulated), expected, 2e-4 * expected); /* notes: 1.6e-4 */
        band_samples_free(&s);
    }
}

static void a_look_up_is_linear_in_wavenumber(void **state)
{
    (void)state;
    for (int i = 0; i < TRIALS; i++) {
        const double nu = uniform(1e4 / high_um, 1e4 / low_um);
        assert_near(band_look_up(&air, value, nu), tabulated(nu), 1e-12);
    }
    assert_near(band_look_up(&air, value, 1800.0), value[0], 0.0);
    assert_near(band_look_up(&air, value, 700.0), value[POINTS - 1], 0.0);
}

static void a_band_beyond_the_database_is_refused(void **state)
{
    band_samples s;

    (void)state;
    const band below = {.name = "mwir", .low_um = 5.0, .high_um = 8.0};
    const band above = {.name = "far", .low_um = 10.0, .high_um = 14.4};
    assert_int_equal(band_sample(&s, &below, &air, BAND_FINE), STATUS_ARGUMENT);
    assert_non_null(strstr(status_message(), "band mwir: 5 to 8 um is not within"));
    assert_non_null(strstr(status_message(), "5.556 to 14.29 um"));
    assert_int_equal(band_sample(&s, &above, &air, BAND_DATABASE_POINTS), STATUS_ARGUMENT);
}

static void a_band_that_fills_the_database_is_taken(void **state)
{
    (void)state;
    band_samples s = sample((band){.name = "all", .low_um = low_um, .high_um = high_um}, BAND_FINE);

    assert_near(s.width_um, high_um - low_um, 1e-12);
    band_samples_free(&s);
}

static void the_centre_is_the_mean_wavelength(void **state)
{
    (void)state;
    band_samples s = sample((band){.name = "b", .low_um = 8.0, .high_um = 12.0}, BAND_FINE);

    assert_near(s.centre_um, 10.0, 1e-5); /* trapezoids of l dl: exact but for rounding of sums */
    band_samples_free(&s);
}

/* A response of 1 at every point is a band without edges. */
static void a_flat_response_equals_the_whole_database(void **state)
{
    response_file flat = {.count = POINTS, .response = malloc(POINTS * sizeof(double))};

    (void)state;
    for (int i = 0; i < POINTS; i++) flat.response[i] = 1.0;
    band_samples with = sample((band){.name = "flat", .sensor = &flat}, BAND_FINE);
    band_samples without =
        sample((band){.name = "all", .low_um = low_um, .high_um = high_um}, BAND_FINE);
    assert_int_equal(with.count, without.count);
    for (int i = 0; i < with.count; i++)
        assert_near(with.weight_um[i], without.weight_um[i], 1e-15);
    band_samples_free(&with);
    band_samples_free(&without);
    free(flat.response);
}

static double respond(double wavenumber)
{
    return tabulated(wavenumber) / 10.0;
}

static double respond_to_black_body(double wavenumber)
{
    return respond(wavenumber) * black_body(wavenumber);
}

static void a_sensor_s_response_is_linear_between_its_points(void **state)
{
    response_file s = {.count = POINTS, .response = malloc(POINTS * sizeof(double))};

    (void)state;
    for (int i = 0; i < POINTS; i++) s.response[i] = value[i] / 10.0;
    band_samples samples = sample((band){.name = "sen", .sensor = &s}, BAND_FINE);
    const double width = dense(low_um, high_um, respond);
    const double radiance = dense(low_um, high_um, respond_to_black_body);
    assert_near(samples.width_um, width, 2e-4 * width);
    assert_near(sum_of(&samples, black_body), radiance, 2e-4 * radiance);
    band_samples_free(&samples);
    free(s.response);
}

static void a_response_that_does_not_fit_the_database_is_refused(void **state)
{
    double values[POINTS] = {0};
    response_file s = {.count = POINTS - 1, .response = values};
    const band b = {.name = "sen", .sensor = &s};
    band_samples samples;

    (void)state;
    assert_int_equal(band_sample(&samples, &b, &air, BAND_FINE), STATUS_ARGUMENT);
    assert_non_null(strstr(status_message(), "55 responses, the radiance database 56 points"));
    s.count = POINTS;
    assert_int_equal(band_sample(&samples, &b, &air, BAND_FINE), STATUS_ARGUMENT);
    assert_non_null(strstr(status_message(), "its response is 0 everywhere"));
}

static void thesis_mode_samples_the_points_inside_and_no_others(void **state)
{
    (void)state;
    /* 1250 and 750 cm-1 are no points; 1240 .. 760 are. */
    band_samples s =
        sample((band){.name = "b", .low_um = 8.0, .high_um = 1e4 / 750.0}, BAND_DATABASE_POINTS);

    assert_int_equal(s.count, 25);
    for (int i = 0; i < s.count; i++) assert_near(s.wavenumber_cm1[i], 1240.0 - 20.0 * i, 0.0);
    band_samples_free(&s);
    s = sample((band){.name = "edges", .low_um = 1e4 / 1240.0, .high_um = 1e4 / 760.0},
               BAND_DATABASE_POINTS);
    assert_int_equal(s.count, 25);
    band_samples_free(&s);
}

static void thesis_mode_needs_two_points(void **state)
{
    const band b = {.name = "narrow", .low_um = 9.95, .high_um = 10.05};
    band_samples s;

    (void)state;
    assert_int_equal(band_sample(&s, &b, &air, BAND_DATABASE_POINTS), STATUS_ARGUMENT);
    assert_non_null(strstr(status_message(), "band narrow: 1 points"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_weights_of_any_band_sum_up_to_its_width),
        cmocka_unit_test(samples_run_from_edge_to_edge_without_gaps),
        cmocka_unit_test(a_smooth_spectrum_is_integrated_to_2e_6),
        cmocka_unit_test(a_tabulated_spectrum_is_integrated_to_2e_4),
        cmocka_unit_test(a_look_up_is_linear_in_wavenumber),
        cmocka_unit_test(a_band_beyond_the_database_is_refused),
        cmocka_unit_test(a_band_that_fills_the_database_is_taken),
        cmocka_unit_test(the_centre_is_the_mean_wavelength),
        cmocka_unit_test(a_flat_response_equals_the_whole_database),
        cmocka_unit_test(a_sensor_s_response_is_linear_between_its_points),
        cmocka_unit_test(a_response_that_does_not_fit_the_database_is_refused),
        cmocka_unit_test(thesis_mode_samples_the_points_inside_and_no_others),
        cmocka_unit_test(thesis_mode_needs_two_points),
    };

    return cmocka_run_group_tests(tests, make_database, NULL);
}
