#include "../assert_near.h"
#include "../text_file.h"

#include "spectrum/spectral_curve.h"

#include <stdbool.h>

static const char ecostress[] =
    "Name: Construction Asphalt\nType:  manmade\nDescription:  Gray and black construction "
    "asphalt.  The "
    "sample was\nsoiled and weathered.\n\nMeasurement:  Directional (10 Degree) Hemispherical "
    "Reflectance\nFirst Column:  X\nSecond Column: Y\nX Units:  Wavelength (micrometers)\nY Units: "
    " "
    "Reflectance (percent)\nFirst X Value: 12.5\nLast X Value: 0.42\nNumber of X Values: "
    "4\nAdditional "
    "Information:\n\n12.5\t6.0\n10.0 \t5.0\n 0.5\t8.25\n0.42 \t7.5\n";

static const char table[] = "# a wall\nwavelength_um,emissivity\n8,0.9\n10,0.95\n14,0.97\n";

static status read_path(spectral_curve **out, const char *path)
{
    const spectral_source source = {.path = path};

    return spectral_curve_read(out, &source);
}

static spectral_curve *read_text(const char *text)
{
    spectral_curve *c = NULL;

    if (read_path(&c, text_file(text)) != STATUS_OK) fail_msg("%s", status_message());
    return c;
}

static void ecostress_turns_round_and_leaves_percent(void **state)
{
    (void)state;
    spectral_curve *c = read_text(ecostress);

    assert_int_equal(c->quantity, SPECTRAL_REFLECTANCE);
    assert_int_equal(c->grid.count, 4);
    assert_near(c->grid.wavelength_um[0], .42, 0.0);
    assert_near(c->value[0], .075, 1e-15);
    assert_near(c->value[3], .06, 1e-15);
    assert_false(c->is_directional);
    spectral_curve_free(c);
}

static void a_wavelength_without_a_value_is_a_gap_and_0_none(void **state)
{
    (void)state;
    spectral_curve *c = read_text(
        "Name: x\nX Units: Wavelength (micrometer)\nY Units: Emissivity\nNumber of X Values: "
        "6\n\n0.4\t0.9\n0.5\t0.9\n0.55\n0.6\t0.8\n0.7\t0.8\n0.0\t0.0\n");

    assert_int_equal(c->grid.count, 4);
    assert_int_equal(c->grid.link[1], WAVELENGTH_LINK_GAP);
    spectral_curve_free(c);
}

static void a_header_that_says_bidirectional_is_heard(void **state)
{
    spectral_curve *c = NULL;

    (void)state;
    assert_int_equal(
        read_path(&c, text_file_with(ecostress, "Directional (10 Degree) Hemispherical",
                                     "Bidirectional")),
        STATUS_OK);
    assert_true(c->is_directional);
    spectral_curve_free(c);
}

static void tables_are_read_in_every_unit(void **state)
{
    static const char *const texts[] = {
        "wavelength_um,emissivity\n8,0.9\n10,0.95\n12.5,0.97\n",
        "Wavelength [nm];Reflectance [%]\n8000;10\n10000;5\n12500;3\n",
        "wavenumber_cm1,reflectance\n800,0.03\n1000,0.05\n1250,0.1\n",
        "wavelength_um\treflectance_percent\n12.5\t3\n10\t5\n8\t10\n"};

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        spectral_curve *c = read_text(texts[i]);
        spectral_curve_take_kirchhoff(c);
        assert_int_equal(c->quantity, SPECTRAL_EMISSIVITY);
        assert_near(c->grid.wavelength_um[0], 8.0, 1e-12);
        assert_near(c->grid.wavelength_um[2], 12.5, 1e-12);
        assert_near(c->value[1], .95, 1e-12);
        spectral_curve_free(c);
    }
}

/* Straight in wavenumber: at 9 um, 1111 cm-1, 0.4444 of the way from 1250 to 1000 cm-1 is left. */
static void a_table_is_straight_in_what_its_file_counts_in(void **state)
{
    (void)state;
    spectral_curve *um = read_text("wavelength_um,emissivity\n8,0.9\n10,0.95\n12.5,0.97\n");
    spectral_curve *cm1 = read_text("wavenumber_cm1,emissivity\n800,0.97\n1000,0.95\n1250,0.9\n");

    assert_near(wavelength_grid_find(&um->grid, 1e4 / 9.0).fraction, .5, 1e-12);
    assert_near(wavelength_grid_find(&cm1->grid, 1e4 / 9.0).fraction, (1250.0 - 1e4 / 9.0) / 250.0,
                1e-12);
    spectral_curve_free(um);
    spectral_curve_free(cm1);
}

static void deleted_channels_are_gaps(void **state)
{
    (void)state;
    spectral_curve *c = read_text(
        "wavelength_um,reflectance\n1,.1\n1.3,.1\n1.4,-1.23e34\n1.8,-1.23e34\n2,.2\n2.4,.2\n");

    assert_int_equal(c->grid.count, 4);
    assert_int_equal(c->grid.link[1], WAVELENGTH_LINK_GAP);
    assert_true(wavelength_grid_measures(&c->grid, 1.2));
    assert_false(wavelength_grid_measures(&c->grid, 1.5));
    assert_true(wavelength_grid_covers(&c->grid, 1.42)); /* 1.3 + 10 % */
    assert_false(wavelength_grid_covers(&c->grid, 1.6));
    assert_true(wavelength_grid_covers(&c->grid, 1.81)); /* 2 - 10 % */
    assert_near(wavelength_grid_uncovered(&c->grid, 1.0, 2.2), 1.43, 1e-6);
    assert_near(wavelength_grid_uncovered(&c->grid, 1.5, 2.2), 1.5, 0.0);
    assert_true(isnan(wavelength_grid_uncovered(&c->grid, 1.85, 2.6)));
    assert_near(wavelength_grid_find(&c->grid, 1e4 / 1.42).fraction, 0.0, 0.0); /* held from 1.3 */
    assert_near(wavelength_grid_find(&c->grid, 1e4 / 1.81).fraction, 1.0, 0.0);
    assert_near(wavelength_grid_find(&c->grid, 1e4 / 1.615).fraction, .5, 1e-9);
    spectral_curve_free(c);
}

static void an_end_at_14_um_holds_on(void **state)
{
    (void)state;
    spectral_curve *c = read_text(table);

    assert_true(wavelength_grid_covers(&c->grid, 100.0));
    assert_false(wavelength_grid_covers(&c->grid, 7.1));
    assert_true(wavelength_grid_covers(&c->grid, 7.3));
    spectral_curve_free(c);
}

static void joined_files_keep_the_first_where_they_overlap(void **state)
{
    double overlap[2];

    (void)state;
    spectral_curve *c = read_text("wavelength_um,emissivity\n1,.1\n2,.2\n3,.3\n");
    spectral_curve *other = read_text("wavelength_um,emissivity\n2.5,.9\n3,.9\n4,.9\n5,.8\n");

    assert_int_equal(spectral_curve_join(c, other, overlap), STATUS_OK);
    assert_int_equal(c->grid.count, 6); /* and where the other goes on, beside 3 um */
    assert_near(c->value[2], .3, 0.0);
    assert_near(c->value[3], .9, 0.0);
    assert_near(c->grid.wavelength_um[3], 3.0, 1e-8);
    assert_near(wavelength_grid_value(&c->grid, c->value, 1e4 / 2.9), .29, 1e-9);
    assert_near(wavelength_grid_value(&c->grid, c->value, 1e4 / 3.5), .9, 1e-9);
    assert_near(overlap[0], 2.5, 0.0);
    assert_near(overlap[1], 3.0, 0.0);
    spectral_curve_free(other);
    spectral_curve_free(c);
}

/* A table of few points that overlaps with its first alone is known from the seam on. */
static void a_joined_table_is_known_from_the_seam_on(void **state)
{
    double overlap[2];

    (void)state;
    spectral_curve *c = read_text("wavelength_um,emissivity\n1,.1\n2,.2\n3,.3\n");
    spectral_curve *other = read_text("wavelength_um,emissivity\n2,.2\n10,1\n14,1\n");

    assert_int_equal(spectral_curve_join(c, other, overlap), STATUS_OK);
    assert_near(wavelength_grid_value(&c->grid, c->value, 1e4 / 6.0), .6, 1e-9);
    assert_true(isnan(wavelength_grid_uncovered(&c->grid, 1.0, 14.0)));
    assert_near(overlap[0], 2.0, 0.0);
    assert_near(overlap[1], 3.0, 0.0);
    spectral_curve_free(other);
    spectral_curve_free(c);
}

static const char yaml[] =
    "REFERENCES: |\n    Hale: Optical constants\nDATA:\n  - type: tabulated nk\n    "
    "data: |\n        9.8 1.229 0.0484\n        10.0 1.218 0.0508\n        10.5 1.185 "
    "0.0662\nSPECS:\n    n_is_absolute: true\n";

static void optical_constants_are_read(void **state)
{
    (void)state;
    spectral_curve *from[] = {
        read_text(yaml),
        read_text("wavelength_um,n,k\n9.8,1.229,.0484\n10,1.218,.0508\n10.5,1.185,.0662\n")};

    for (int i = 0; i < 2; i++) {
        assert_int_equal(from[i]->quantity, SPECTRAL_CONSTANTS);
        assert_int_equal(from[i]->grid.count, 3);
        assert_near(from[i]->value[1], 1.218, 0.0);
        assert_near(from[i]->absorption[1], .0508, 0.0);
        spectral_curve_free(from[i]);
    }
}

static void a_field_spectrometers_file_is_read(void **state)
{
    (void)state;
    spectral_curve *c =
        read_text("/*** Spectra Vista SIG Data ***/\nname= leaf.sig\ninstrument= HI: 1\ndata= \n"
                  "350.0  14.1  1.2  8.51\n351.5  14.2  1.2  8.45\n353.0  14.3  1.3  9.09\n");

    assert_near(c->grid.wavelength_um[0], .35, 1e-15);
    assert_near(c->value[2], .0909, 1e-15);
    assert_true(c->is_directional);
    spectral_curve_free(c);
}

static void a_wrong_file_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *from, *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {table, "wavelength_um", "wavelength", 2, "wavelength_um, wavelength_nm or wavenumber_cm1"},
        {table, "emissivity", "colour", 2, "emissivity, reflectance"},
        {table, "10,0.95", "8,0.95", 4, "every wavelength once"},
        {table, "14,0.97", "9,0.97", 5, "only rise or only fall"},
        {table, "14,0.97", "14000,0.97", 5, "a wavelength of 0.1 to 200 um"},
        {table, "10,0.95", "10,1.05", 4, "values of 0 to 1"},
        {table, "10,0.95", "10,x", 4, "2 numbers"},
        {table, "14,0.97\n", "", 4, "3 or more"},
        {ecostress, "(micrometers)", "", 9, "Wavelength (micrometers)"},
        {ecostress, "Reflectance (percent)", "Radiance", 10, "Reflectance (percent)"},
        {ecostress, "Values: 4", "Values: 5", 19, "5 points, as the header states, not 4"},
        {ecostress, "10.0 \t5.0", "10.0 5 6", 17, "a wavelength and a value"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        spectral_curve *c = NULL;
        assert_refused(read_path(&c, text_file_with(wrong[i].from, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
        assert_null(c);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(ecostress_turns_round_and_leaves_percent),
        cmocka_unit_test(a_wavelength_without_a_value_is_a_gap_and_0_none),
        cmocka_unit_test(a_header_that_says_bidirectional_is_heard),
        cmocka_unit_test(tables_are_read_in_every_unit),
        cmocka_unit_test(a_table_is_straight_in_what_its_file_counts_in),
        cmocka_unit_test(deleted_channels_are_gaps),
        cmocka_unit_test(an_end_at_14_um_holds_on),
        cmocka_unit_test(joined_files_keep_the_first_where_they_overlap),
        cmocka_unit_test(a_joined_table_is_known_from_the_seam_on),
        cmocka_unit_test(optical_constants_are_read),
        cmocka_unit_test(a_field_spectrometers_file_is_read),
        cmocka_unit_test(a_wrong_file_is_refused_at_its_line),
    };

    return cmocka_run_group_tests(tests, text_file_setup, text_file_teardown);
}
