#include "../assert_near.h"
#include "../text_file.h"

#include "material/extinction.h"

/* The printed rows of thesis Appendix A item 8 (cumulus cloud). */
static const double first_rows[] = {20.470046, 20.381773, 20.427239, 20.519245, 20.506844,
                                    20.530237, 20.608827, 20.519522, 20.642167, 20.752690,
                                    20.759873, 20.828176, 20.725438};
static const double last_rows[] = {32.444673, 33.563504, 33.793211, 31.616106, 25.977480, 22.136326,
                                   24.989100, 26.290338, 30.210459, 6.919597,  0.000000};

enum {
    FIRST = sizeof first_rows / sizeof first_rows[0],
    LAST = WAVENUMBER_ROWS - sizeof last_rows / sizeof last_rows[0]
};

static char table[WAVENUMBER_ROWS * 24];

/* The rows that the thesis leaves out repeat its thirteenth. */
static int fill_table(void **state)
{
    char *to = table + sprintf(table, "25.8\n");

    for (int i = 0; i < WAVENUMBER_ROWS; i++) {
        const double value =
            i >= LAST ? last_rows[i - LAST] : first_rows[i < FIRST ? i : FIRST - 1];
        to += sprintf(to, "%d %f\n", 39850 - 100 * i, value);
    }
    return text_file_setup(state);
}

static void the_printed_cloud_is_read_per_metre(void **state)
{
    extinction *e = NULL;

    (void)state;
    assert_int_equal(extinction_read(&e, text_file(table)), STATUS_OK);

    assert_near(e->broad_band_per_m, 0.0258, 1e-15); /* 25.8 per km; double */
    assert_near(e->per_m[0], 0.020470046, 1e-15);    /* 39850 cm-1 */
    assert_near(e->per_m[12], 0.020725438, 1e-15);   /* 38650 */
    assert_near(e->per_m[389], 0.025977480, 1e-15);  /* 950 */
    assert_near(e->per_m[395], 0.0, 0.0);            /* 350 */
    extinction_free(e);
}

static void extinction_is_linear_between_rows_and_constant_beyond_them(void **state)
{
    extinction *e = NULL;

    (void)state;
    assert_int_equal(extinction_read(&e, text_file_with(table, "", "")), STATUS_OK);
    assert_near(wavelength_grid_value(&e->grid, e->per_m, 950.0), 0.025977480, 1e-12);
    assert_near(wavelength_grid_value(&e->grid, e->per_m, 900.0),
                .5 * (e->per_m[389] + e->per_m[390]), 1e-12);
    assert_near(wavelength_grid_value(&e->grid, e->per_m, 5e4), 0.020470046, 1e-12);
    assert_near(wavelength_grid_value(&e->grid, e->per_m, 100.0), e->per_m[395], 1e-12);
    extinction_free(e);
}

static void a_csv_keeps_its_own_wavelengths(void **state)
{
    extinction *e = NULL;

    (void)state;
    assert_int_equal(
        extinction_read(
            &e, text_file("# smoke\nwavelength_um,extinction_per_km\n0.4,30\n0.5,20\n12,10\n")),
        STATUS_OK);
    assert_true(isnan(e->broad_band_per_m));
    assert_near(wavelength_grid_value(&e->grid, e->per_m, 1e4 / .45), .025, 1e-12);
    assert_near(wavelength_grid_value(&e->grid, e->per_m, 1e4 / 6.25), .015, 1e-12);
    extinction_free(e);
    e = NULL;
    assert_refused(
        extinction_read(&e, text_file("wavelength_um,extinction_per_km\n0.4,30\n0.5,-1\n12,10\n")),
        3, "extinction_per_km from 0 to");
    assert_refused(extinction_read(&e, text_file("wavelength,extinction_per_km\n0.4,30\n")), 1,
                   "wavelength_um, wavelength_nm or wavenumber_cm1, extinction_per_km");
    assert_null(e);
}

static void a_wrong_row_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"25.8\n", "", 1, "the broad-band extinction per km"},
        {"39750 20", "39740 20", 3, "39750 and an extinction per km from 0"},
        {"39750 20", "39750 -20", 3, "39750 and an extinction per km from 0"},
        {"39750 20", "39750 x20", 3, "a wavenumber and an extinction per km"},
        {"\n350 0.000000", "", 397, "the file ends"},
        {"\n350 0.000000", "\n350 0.000000\n250 0.0", 398, "the end of the file"},
    };
    extinction *e = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(extinction_read(&e, text_file_with(table, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
    assert_null(e);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_cloud_is_read_per_metre),
        cmocka_unit_test(extinction_is_linear_between_rows_and_constant_beyond_them),
        cmocka_unit_test(a_csv_keeps_its_own_wavelengths),
        cmocka_unit_test(a_wrong_row_is_refused_at_its_line),
    };

    return cmocka_run_group_tests_name("extinction", tests, fill_table, text_file_teardown);
}
