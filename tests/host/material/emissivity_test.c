#include "../assert_near.h"
#include "../text_file.h"

#include "material/emissivity.h"

enum { ROW_SIZE = 20, LINES_PER_ANGLE = 1 + WAVENUMBER_ROWS };

static char *table;

/* Thesis Appendix A item 7 (new asphalt) prints parts of the angles 0, 1 and 90. The rows and angles
 * that it leaves out are filled in: at 0 to 89 degrees 1 outside and 0.961 inside 1250..750 cm-1, at
 * 90 degrees 1 and 0. */
static int fill_table(void **state)
{
    char *to = table = malloc((size_t)EMISSIVITY_ANGLES * LINES_PER_ANGLE * ROW_SIZE);

    if (!table) return -1;
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++) {
        to += sprintf(to, "%d\n", angle);
        for (int wavenumber = 39850; wavenumber >= 350; wavenumber -= 100) {
            const double inside = angle < 90 ? 0.961 : 0.0;
            to += sprintf(to, "%d %f\n", wavenumber,
                          wavenumber <= 1250 && wavenumber >= 750 ? inside : 1.0);
        }
    }
    return text_file_setup(state);
}

static int free_table(void **state)
{
    free(table);
    return text_file_teardown(state);
}

static float value(const emissivity *e, size_t angle, size_t row)
{
    return e->value[angle * WAVENUMBER_ROWS + row];
}

static void the_printed_asphalt_is_read(void **state)
{
    emissivity *e = NULL;

    (void)state;
    assert_int_equal(emissivity_read(&e, text_file(table)), STATUS_OK);

    assert_float_equal(value(e, 0, 0), 1.0f, 0.0f);     /* 39850 cm-1 */
    assert_float_equal(value(e, 0, 385), 1.0f, 0.0f);   /* 1350 */
    assert_float_equal(value(e, 0, 386), 0.961f, 0.0f); /* 1250 */
    assert_float_equal(value(e, 0, 391), 0.961f, 0.0f); /* 750 */
    assert_float_equal(value(e, 0, 392), 1.0f, 0.0f);   /* 650 */
    assert_float_equal(value(e, 90, 388), 0.0f, 0.0f);  /* 1050 */
    assert_float_equal(value(e, 90, 395), 1.0f, 0.0f);  /* 350 */
    emissivity_free(e);
}

static void a_header_is_passed_over(void **state)
{
    emissivity *e = NULL;

    (void)state;
    assert_int_equal(emissivity_read(&e, text_file_with(table, "0\n", "# asphalt\n# new\n0\n")),
                     STATUS_OK);
    assert_float_equal(value(e, 0, 386), 0.961f, 0.0f);
    emissivity_free(e);
}

static void a_wrong_row_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"39750 1.000000", "39750 1.100000", 3, "39750 and an emissivity from 0 to 1"},
        {"39750 1.000000", "39750 -.1", 3, "39750 and an emissivity from 0 to 1"},
        {"39750 1.000000", "39650 1.000000", 3, "39750 and an emissivity from 0 to 1"},
        {"39750 1.000000", "39750", 3, "a wavenumber and an emissivity"},
        {"\n1\n", "\n2\n", 398, "an angle in degrees from 1 to 1"},
        {"\n90\n", "\n", 90 * LINES_PER_ANGLE + 1, "an angle in degrees"},
    };
    emissivity *e = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(emissivity_read(&e, text_file_with(table, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
    assert_null(e);
}

static void noise_beyond_0_and_1_is_cut_and_told(void **state)
{
    emissivity *e = NULL;

    (void)state;
    assert_int_equal(emissivity_read(&e, text_file_with(table, "39750 1.000000\n39650 1.000000",
                                                        "39750 1.019\n39650 -.02")),
                     STATUS_OK);
    assert_float_equal(value(e, 0, 1), 1.0f, 0.0f);
    assert_float_equal(value(e, 0, 2), 0.0f, 0.0f);
    assert_non_null(strstr(status_warnings(), "2 emissivities lie beyond 0 and 1 by up to 0.02"));
    emissivity_free(e);
}

static void a_table_that_ends_early_is_refused(void **state)
{
    emissivity *e = NULL;
    char *end = strrchr(table, '3'); /* the last row's 350 */
    const char kept = *end;

    (void)state;
    *end = '\0';
    assert_refused(emissivity_read(&e, text_file(table)), EMISSIVITY_ANGLES * LINES_PER_ANGLE,
                   "the file ends");
    *end = kept;
}

/* Rows stand at 39850, 39750 ...: 1250 and 1050 cm-1 are even ones. */
static void a_table_is_linear_in_wavenumber_at_every_angle(void **state)
{
    static const double wavenumber_cm1[] = {1250.0, 1237.5, 1150.0, 1101.0, 900.0, 751.25};
    enum { COUNT = sizeof wavenumber_cm1 / sizeof *wavenumber_cm1 };
    static float out[EMISSIVITY_ANGLES * COUNT];
    emissivity *e = NULL;

    (void)state;
    assert_int_equal(emissivity_read(&e, text_file(table)), STATUS_OK);
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++)
        for (int i = 0; i < WAVENUMBER_ROWS; i++)
            e->value[angle * WAVENUMBER_ROWS + i] =
                (float)(i % 2 ? .9 - .001 * angle : .3 + .001 * angle);
    assert_int_equal(emissivity_rows(e), EMISSIVITY_ANGLES);
    emissivity_sample(e, wavenumber_cm1, COUNT, out);
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle += 15)
        for (int i = 0; i < COUNT; i++) {
            const double place = fabs(fmod((1250.0 - wavenumber_cm1[i]) / 100.0, 2.0));
            const double odd = place > 1.0 ? 2.0 - place : place;
            assert_near((double)out[angle * COUNT + i],
                        odd * (.9 - .001 * angle) + (1.0 - odd) * (.3 + .001 * angle), 2e-7);
        }
    emissivity_free(e);
}

/* The curve 0.9 at 8 um, 0.95 at 10, 0.97 at 12: 1.85 + 1.92 over 4 um. */
static void the_integral_of_a_curve_is_that_of_its_pieces(void **state)
{
    const spectral_source source = {
        .path = text_file("wavelength_um,emissivity\n8,0.9\n10,0.95\n12,0.97\n")};
    spectral_curve *c = NULL;
    emissivity *e = NULL;

    (void)state;
    assert_int_equal(spectral_curve_read(&c, &source), STATUS_OK);
    assert_int_equal(emissivity_make(&e, &c, NULL, 1, EMISSIVITY_CONSTANT), STATUS_OK);
    assert_int_equal(emissivity_rows(e), 1);
    assert_near(emissivity_integral(e, 8.0, 12.0), 3.77, 1e-6);
    assert_near(emissivity_integral(e, 9.0, 11.0), .9375 + .955, 1e-6);
    assert_near(emissivity_at(e, 1e4 / 7.5, 0.0), .9, 1e-6);
    e->outside = .5;
    assert_near(emissivity_at(e, 1e4 / 7.5, 0.0), .9, 1e-6); /* within a tenth */
    assert_near(emissivity_at(e, 1e4 / 7.0, 0.0), .5, 0.0);
    emissivity_free(e);
    spectral_curve_free(c);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_asphalt_is_read),
        cmocka_unit_test(a_header_is_passed_over),
        cmocka_unit_test(a_table_is_linear_in_wavenumber_at_every_angle),
        cmocka_unit_test(the_integral_of_a_curve_is_that_of_its_pieces),
        cmocka_unit_test(a_wrong_row_is_refused_at_its_line),
        cmocka_unit_test(noise_beyond_0_and_1_is_cut_and_told),
        cmocka_unit_test(a_table_that_ends_early_is_refused),
    };

    return cmocka_run_group_tests_name("emissivity", tests, fill_table, free_table);
}
