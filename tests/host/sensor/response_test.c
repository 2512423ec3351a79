#include "../assert_near.h"
#include "../text_file.h"

#include "sensor/response.h"

static const char table[] = "# a filter\nwavelength_um, response\n8, 0\n9, 2\n11, 4\n12, 0\n";

static response *read_text(const char *text)
{
    response *r = NULL;

    if (response_read(&r, text_file(text)) != STATUS_OK) fail_msg("%s", status_message());
    return r;
}

static void a_table_is_scaled_to_a_peak_of_1(void **state)
{
    (void)state;
    response *r = read_text(table);

    assert_int_equal(r->count, 4);
    assert_near(response_at(r, 9.0), 0.5, 0.0);
    assert_near(response_at(r, 11.0), 1.0, 0.0);
    assert_near(response_at(r, 10.0), 0.75, 1e-15); /* linear between points */
    response_free(r);
}

static void a_response_is_0_outside_its_table(void **state)
{
    (void)state;
    response *r = read_text("wavelength_um,response\n8,1\n9,1\n");

    assert_near(response_at(r, 7.999), 0.0, 0.0);
    assert_near(response_at(r, 9.001), 0.0, 0.0);
    response_free(r);
}

static void the_unit_stands_in_the_first_line(void **state)
{
    (void)state;
    response *um = read_text("wavelength_um,response\n8,1\n10,3\n12.5,2\n");
    response *nm = read_text("wavelength_nm,response\n8000,1\n10000,3\n12500,2\n");
    response *cm1 = read_text("wavenumber_cm1,response\n1250,1\n1000,3\n800,2\n");

    for (int i = 0; i < 3; i++) {
        assert_near(nm->wavelength_um[i], um->wavelength_um[i], 1e-14);
        assert_near(cm1->wavelength_um[i], um->wavelength_um[i], 1e-14);
        assert_near(cm1->value[i], um->value[i], 0.0);
    }
    response_free(um);
    response_free(nm);
    response_free(cm1);
}

static void headings_are_read_as_people_write_them(void **state)
{
    static const char *const texts[] = {
        "Wavelength [nm];Response\n8000;1\n10000;3\n12500;2\n",
        "wavelength (nm)\tRelative Response\n8000\t1\n10000\t3\n12500\t2\n",
        "\"wavelength_um\", \"Transmission\"\r\"8\",\"1\"\r\"10\",\"3\"\r\"12.5\",\"2\"\r",
        "Lambda [\xc2\xb5m],RSR\n8,1,\n10,3,\n12.5,2,\n",
        "lambda [\xb5m],rsr\n8,1\n10,3\n12.5,2\n", /* Latin-1 */
        "Wavenumber [cm-1],transmittance\n1250,1\n1000,3\n800,2\n",
    };

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        response *r = read_text(texts[i]);
        assert_near(r->wavelength_um[0], 8.0, 1e-14);
        assert_near(r->wavelength_um[2], 12.5, 1e-14);
        assert_near(r->value[0], 1.0 / 3.0, 1e-16);
        response_free(r);
    }
}

static void a_table_may_fall_in_wavelength(void **state)
{
    (void)state;
    response *r = read_text("wavenumber_cm1,response\n800,2\n1000,3\n1250,1\n");

    assert_near(r->wavelength_um[0], 8.0, 0.0);
    assert_near(r->value[0], 1.0 / 3.0, 0.0);
    response_free(r);
}

/* b = (x - 8) / 4 from 8 to 12, times (12 - x) / 4: 4 / 6 by hand; times (x - 8) / 4: 4 / 3. */
static void an_integral_against_a_line_is_exact(void **state)
{
    (void)state;
    response *r = read_text("wavelength_um,response\n8,0\n9,1\n12,4\n");

    assert_near(response_integral(r, 8.0, 12.0), 4.0 / 6.0, 1e-14);
    assert_near(response_integral(r, 12.0, 8.0), 4.0 / 3.0, 1e-14);
    response_free(r);
}

/* The line falls from 1 at 7 to 0 at 9; the table ends at 8: (1/2)(1/2) / 2. */
static void an_integral_ends_with_the_table(void **state)
{
    (void)state;
    response *r = read_text("wavelength_um,response\n8,1\n12,1\n");

    assert_near(response_integral(r, 7.0, 9.0), 0.25, 1e-14);
    assert_near(response_integral(r, 5.0, 6.0), 0.0, 0.0);
    response_free(r);
}

static void a_gaussian_has_half_its_peak_at_half_its_width(void **state)
{
    response *r = NULL;

    (void)state;
    assert_int_equal(response_gaussian(&r, 10.0, 0.5), STATUS_OK);
    assert_near(response_at(r, 10.0), 1.0, 0.0);
    assert_near(response_at(r, 9.75), 0.5, 1e-12);
    assert_near(response_at(r, 10.25), 0.5, 1e-12);
    response_free(r);
}

static void a_gaussian_has_the_area_of_its_closed_form(void **state)
{
    response *r = NULL;

    (void)state;
    assert_int_equal(response_gaussian(&r, 10.0, 0.5), STATUS_OK);
    const double area = response_integral(r, 8.0, 12.0) + response_integral(r, 12.0, 8.0);
    /* 2.5e-6 of a Gaussian lie beyond 2 widths */
    assert_near(area, 0.5 * sqrt(M_PI / (4.0 * M_LN2)), 2e-6);
    response_free(r);
}

static void a_wavelength_that_comes_twice_is_a_step(void **state)
{
    response *r = NULL;

    (void)state;
    assert_int_equal(
        response_read(&r, text_file("wavelength_um,response\n8,0\n8,1\n9,1\n9,.5\n9,0\n")),
        STATUS_OK);
    assert_int_equal(r->count, 4);
    assert_near(response_at(r, 8.0), 1.0, 0.0);
    assert_near(response_at(r, 8.999), 1.0, 0.0);
    assert_near(response_at(r, 9.0), 0.0, 0.0);
    assert_near(response_integral(r, 8.0, 9.0), 0.5, 1e-15);
    response_free(r);
}

static void a_wrong_table_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *text;
        int line;
        const char *expected;
    } wrong[] = {
        {"wavelength,response\n8,1\n9,1\n", 1, "wavelength_um,response or wavelength_nm"},
        {"8,1\n9,1\n", 1, "wavelength_um,response"},
        {"wavelength_um,response\n8,1\n9\n", 3, "a wavelength and a response"},
        {"wavelength_um,response\n8,1\n9,x\n", 3, "a wavelength and a response"},
        {"wavelength_um,response\n8,1\n9,-1\n", 3, "a response of -1, expected 0 or more"},
        {"wavelength_um,response\n8,1\n900,1\n", 3, "a wavelength of 0.2 to 50 um"},
        {"wavenumber_cm1,response\n0,1\n900,1\n", 2, "a wavelength of 0.2 to 50 um"},
        {"wavelength_um,response\n9,1\n9,1\n", 3, "only rise or only fall"},
        {"wavelength_um,response\n8,1\n9,1\n8.5,1\n", 4, "only rise or only fall"},
        {"wavelength_um,response\n8,0\n9,0\n", 3, "a response above 0"},
    };
    response *r = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(response_read(&r, text_file(wrong[i].text)), wrong[i].line,
                       wrong[i].expected);
    assert_int_equal(response_read(&r, text_file("wavelength_um,response\n8,1\n")), STATUS_FORMAT);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_table_is_scaled_to_a_peak_of_1),
        cmocka_unit_test(a_response_is_0_outside_its_table),
        cmocka_unit_test(the_unit_stands_in_the_first_line),
        cmocka_unit_test(headings_are_read_as_people_write_them),
        cmocka_unit_test(a_table_may_fall_in_wavelength),
        cmocka_unit_test(an_integral_against_a_line_is_exact),
        cmocka_unit_test(an_integral_ends_with_the_table),
        cmocka_unit_test(a_gaussian_has_half_its_peak_at_half_its_width),
        cmocka_unit_test(a_gaussian_has_the_area_of_its_closed_form),
        cmocka_unit_test(a_wavelength_that_comes_twice_is_a_step),
        cmocka_unit_test(a_wrong_table_is_refused_at_its_line),
    };

    return cmocka_run_group_tests_name("response", tests, text_file_setup, text_file_teardown);
}
