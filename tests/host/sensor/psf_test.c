#include "../assert_near.h"
#include "../text_file.h"

#include "sensor/psf.h"

static psf *point(void)
{
    psf *p = NULL;

    assert_int_equal(psf_detector(&p, 1), STATUS_OK);
    return p;
}

static double weight_at(const psf *p, int column, int row)
{
    const int i = column - p->first_column, k = row - p->first_row;

    if (i < 0 || i >= p->columns || k < 0 || k >= p->rows) return 0.0;
    return p->weight[k * p->columns + i];
}

static double sum_of(const psf *p)
{
    double sum = 0.0;

    for (int i = 0; i < p->columns * p->rows; i++) sum += p->weight[i];
    return sum;
}

/* Response to a wave along the columns, cycles a pixel; the spread is symmetric. */
static double transfer(const psf *p, double frequency)
{
    double sum = 0.0;

    for (int row = 0; row < p->rows; row++)
        for (int column = 0; column < p->columns; column++)
            sum += p->weight[row * p->columns + column] *
                   cos(2.0 * M_PI * frequency * (column + p->first_column));
    return sum;
}

static double sinc(double x)
{
    return x == 0.0 ? 1.0 : sin(M_PI * x) / (M_PI * x);
}

static void every_spread_keeps_the_energy(void **state)
{
    psf *p = point();

    (void)state;
    assert_int_equal(psf_add_gaussian(p, 2.3), STATUS_OK);
    assert_int_equal(psf_add_box(p, 1.7), STATUS_OK);
    assert_int_equal(psf_add_motion(p, 4.2, 33.0), STATUS_OK);
    assert_int_equal(psf_add_airy(p, 0.8), STATUS_OK);
    assert_near(sum_of(p), 1.0, 1e-12);
    psf_free(p);
}

/* The Gaussian's own transfer times a pixel's, with the copies that sampling makes (Poisson). */
static void a_gaussian_has_the_transfer_of_its_closed_form(void **state)
{
    const double fwhm = 2.0, sigma = fwhm / 2.354820045;
    psf *p = point();

    (void)state;
    assert_int_equal(psf_add_gaussian(p, fwhm), STATUS_OK);
    for (double f = 0.0; f <= 0.5; f += 0.05) {
        double expected = 0.0;
        for (int m = -3; m <= 3; m++)
            expected += exp(-2.0 * pow(M_PI * sigma * (f + m), 2.0)) * sinc(f + m);
        assert_near(transfer(p, f), expected, 2e-4); /* 1.3e-4 are cut off on two axes */
    }
    psf_free(p);
}

/* Two arcs over pi, of a round aperture without obstruction; nothing is left at f scale = 1. */
static void diffraction_has_the_transfer_of_its_closed_form(void **state)
{
    const double scale = 2.0;
    psf *p = point();

    (void)state;
    assert_int_equal(psf_add_airy(p, scale), STATUS_OK);
    for (double f = 0.05; f < 0.5; f += 0.05) {
        const double r = f * scale;
        const double expected = 2.0 / M_PI * (acos(r) - r * sqrt(1.0 - r * r)) * sinc(f);
        assert_near(transfer(p, f), expected, 0.02); /* 2 % lie beyond 10 scales */
    }
    psf_free(p);
}

static void a_box_of_one_pixel_changes_nothing(void **state)
{
    psf *p = point();

    (void)state;
    assert_int_equal(psf_add_box(p, 1.0), STATUS_OK);
    assert_near(weight_at(p, 0, 0), 1.0, 1e-15);
    psf_free(p);
}

static void a_box_of_two_pixels_takes_half_of_both_neighbours(void **state)
{
    psf *p = point();

    (void)state;
    assert_int_equal(psf_add_box(p, 2.0), STATUS_OK);
    assert_near(weight_at(p, 0, 0), 0.25, 1e-15);
    assert_near(weight_at(p, -1, 0), 0.125, 1e-15);
    assert_near(weight_at(p, 1, 1), 0.0625, 1e-15);
    psf_free(p);
}

static void motion_smears_along_its_angle(void **state)
{
    psf *p = point();

    (void)state;
    assert_int_equal(psf_add_motion(p, 3.0, 0.0), STATUS_OK);
    for (int i = -1; i <= 1; i++) assert_near(weight_at(p, i, 0), 1.0 / 3.0, 1e-12);
    psf_free(p);
    p = point();
    assert_int_equal(psf_add_motion(p, 3.0, 90.0), STATUS_OK);
    for (int i = -1; i <= 1; i++) assert_near(weight_at(p, 0, i), 1.0 / 3.0, 1e-12);
    psf_free(p);
    p = point();
    assert_int_equal(psf_add_motion(p, 3.0 * M_SQRT2, 45.0), STATUS_OK);
    for (int i = -1; i <= 1; i++) assert_near(weight_at(p, i, -i), 1.0 / 3.0, 1e-12);
    psf_free(p);
}

static void a_detector_of_two_pixels_takes_the_mean_of_four(void **state)
{
    psf *p = NULL;

    (void)state;
    assert_int_equal(psf_detector(&p, 2), STATUS_OK);
    for (int i = 0; i < 4; i++) assert_near(weight_at(p, i % 2, i / 2), 0.25, 0.0);
    psf_free(p);
}

static void a_table_is_the_picture_of_a_point(void **state)
{
    psf *p = NULL;

    (void)state;
    assert_int_equal(psf_read(&p, text_file("# of a lens\n0, 0, 3\n0, 5, 0\n2, 0, 0\n")),
                     STATUS_OK);
    assert_near(weight_at(p, -1, 1), 0.3, 1e-15); /* what goes up and right comes from there */
    assert_near(weight_at(p, 0, 0), 0.5, 1e-15);
    assert_near(weight_at(p, 1, -1), 0.2, 1e-15);
    psf_free(p);
}

static void a_wrong_table_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *text;
        int line;
        const char *expected;
    } wrong[] = {
        {"1,2\n", 1, "an odd number of weights"},
        {"1,x,1\n", 1, "an odd number of weights"},
        {"1,2,1\n1\n1,2,1\n", 2, "3 weights as in the lines above"},
        {"1,2,1\n1,-2,1\n1,2,1\n", 2, "weights of 0 or more"},
        {"1,2,1\n1,2,1\n", 2, "the last of an odd number of lines"},
        {"0,0,0\n", 1, "some weight above 0"},
    };
    psf *p = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(psf_read(&p, text_file(wrong[i].text)), wrong[i].line, wrong[i].expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_spread_keeps_the_energy),
        cmocka_unit_test(a_gaussian_has_the_transfer_of_its_closed_form),
        cmocka_unit_test(diffraction_has_the_transfer_of_its_closed_form),
        cmocka_unit_test(a_box_of_one_pixel_changes_nothing),
        cmocka_unit_test(a_box_of_two_pixels_takes_half_of_both_neighbours),
        cmocka_unit_test(motion_smears_along_its_angle),
        cmocka_unit_test(a_detector_of_two_pixels_takes_the_mean_of_four),
        cmocka_unit_test(a_table_is_the_picture_of_a_point),
        cmocka_unit_test(a_wrong_table_is_refused_at_its_line),
    };

    return cmocka_run_group_tests_name("psf", tests, text_file_setup, text_file_teardown);
}
