#include "../assert_near.h"
#include "../text_file.h"

#include "sky/atmosphere.h"

enum { POINTS = 6, PATHS = 3, ZENITHS = 7, AZIMUTHS = 13 };

/* Rows that thesis Appendix A item 4 prints: the sky at zenith 0 (all azimuths alike), at zenith 90
 * and azimuth 330 and 360. */
static const char zenith_rows[] = "5.640259e-04 3.054148e-08\n2.682229e-04 1.725970e-07\n"
                                  "3.587178e-04 5.711591e-08\n2.350089e-04 8.457958e-08\n"
                                  "3.196508e-04 3.774817e-08\n5.941062e-04 3.755530e-09\n";
static const char north_west_rows[] = "7.817543e-04 9.089405e-09\n8.279369e-04 2.169033e-07\n"
                                      "8.600907e-04 7.488151e-08\n8.496127e-04 1.125547e-07\n"
                                      "8.146524e-04 3.458716e-08\n7.261701e-04 2.290112e-09\n";
static const char horizon_rows[] = "7.817543e-04 9.447878e-09\n8.279369e-04 2.216825e-07\n"
                                   "8.600907e-04 7.631789e-08\n8.496127e-04 1.144063e-07\n"
                                   "8.146524e-04 3.539452e-08\n7.261701e-04 2.378127e-09\n";

static const double altitudes_km[] = {0,  1,  2,  3,  4,  5,  6,  7,  8,  9,  10,
                                      11, 12, 13, 14, 15, 16, 17, 18, 19, 20, 21,
                                      22, 23, 24, 25, 30, 35, 40, 45, 50, 70, 100};
enum { LEVELS = sizeof altitudes_km / sizeof altitudes_km[0] };

static char database[65536];

static char *put_sky(char *to)
{
    to += sprintf(to, "%s", zenith_rows); /* integrated; only its last two rows are printed */
    for (int zenith = 0; zenith < ZENITHS; zenith++)
        for (int azimuth = 0; azimuth < AZIMUTHS; azimuth++) {
            const char *rows = zenith < ZENITHS - 1      ? zenith_rows
                               : azimuth == AZIMUTHS - 2 ? north_west_rows
                                                         : horizon_rows;
            to += sprintf(to, "%f %f\n%s", 15.0 * zenith, 30.0 * azimuth, rows);
        }
    return to;
}

/* The thesis prints the second half of the sky and the profile. What stands before has the order of
 * Figure 2.4-3 and the values of Appendix A item 6 (.snd), with made-up sun and path rows; the sky
 * between the printed directions repeats them. */
static int fill_database(void **state)
{
    char *to = database;

    to += sprintf(to, "# sky of Appendix A\n# item 4\n10.000000\n8.000000\n13.333333\n750.000000\n"
                      "1250.000000\n100.000000\n6\n40.000000\n52.000000\n6.000000\n46.000000\n3\n");
    for (int i = 0; i < POINTS; i++)
        to += sprintf(to, "%f %f %e %e\n", 1e4 / (1250 - 100 * i), 1250.0 - 100 * i,
                      5e-5 - 5e-6 * i, 0.5 + 0.05 * i);
    for (int path = 0; path < PATHS; path++) {
        to += sprintf(to, "%f %f\n", 40.0 + 6.0 * path, 13.0 + path);
        for (int i = 0; i < POINTS; i++)
            to += sprintf(to, "%e %e %e\n", 0.6 - 0.1 * path, 1e-4 * (i + 1), 1e-8 * (path + 1));
    }
    to = put_sky(to);
    to += sprintf(to, "%d\n", LEVELS);
    for (int i = 0; i < LEVELS; i++) to += sprintf(to, "%f 350.0\n", altitudes_km[i]);
    return text_file_setup(state);
}

static atmosphere *read_database(const char *path)
{
    atmosphere *a = NULL;

    if (atmosphere_read(&a, path) != STATUS_OK) fail_msg("%s", status_message());
    return a;
}

static void the_grids_of_the_head_are_read(void **state)
{
    (void)state;
    atmosphere *a = read_database(text_file(database));

    assert_string_equal(a->header, "# sky of Appendix A\n# item 4\n");
    assert_near(a->sensor_altitude_m, 10000.0, 0.0);
    assert_near(a->wavelength_min_um, 8.0, 0.0);
    assert_near(a->wavenumber_max_cm1, 1250.0, 0.0);
    assert_near(a->wavenumber_step_cm1, 100.0, 0.0);
    assert_int_equal(a->point_count, POINTS);
    assert_int_equal(a->path_count, PATHS);
    assert_near(a->path_zenith_first_deg, 40.0, 0.0);
    assert_near(a->path_zenith_step_deg, 6.0, 0.0);
    assert_near(a->path_zenith_meaningful_deg, 46.0, 0.0);
    atmosphere_free(a);
}

static void sun_and_paths_turn_to_square_metres(void **state)
{
    (void)state;
    atmosphere *a = read_database(text_file(database));

    assert_near(a->wavelength_um[2], 9.523810, 0.0);
    assert_near(a->wavenumber_cm1[2], 1050.0, 0.0);
    assert_near(a->solar_irradiance[2], 0.4, 1e-12); /* 4e-5 W/cm2/um; double */
    assert_near(a->tau1[2], 0.6, 0.0);
    assert_near(a->path_range_m[1], 14000.0, 0.0);
    assert_near(a->tau2[1 * POINTS + 3], 0.5, 0.0);
    assert_near(a->path_emitted[1 * POINTS + 3], 4.0, 1e-12);
    assert_near(a->path_scattered[2 * POINTS + 5], 3e-4, 1e-12);
    atmosphere_free(a);
}

static void the_printed_sky_is_read(void **state)
{
    (void)state;
    atmosphere *a = read_database(text_file(database));
    const int north_west = (6 * AZIMUTHS + 11) * POINTS;

    assert_int_equal(a->zenith_count, ZENITHS);
    assert_int_equal(a->azimuth_count, AZIMUTHS);
    assert_near(a->zenith_step_deg, 15.0, 0.0);
    assert_near(a->azimuth_step_deg, 30.0, 0.0);
    assert_near(a->sky_emitted[0], 5.640259, 1e-9);           /* double */
    assert_near(a->sky_emitted_direction[5], 5.941062, 1e-9); /* zenith 0, azimuth 0 */
    assert_near(a->sky_scattered_direction[5], 3.755530e-5, 1e-12);
    assert_near(a->sky_emitted_direction[north_west + 1], 8.279369, 1e-9);
    assert_near(a->sky_scattered_direction[north_west + 1], 2.169033e-3, 1e-12);
    atmosphere_free(a);
}

static void the_printed_profile_is_read(void **state)
{
    (void)state;
    atmosphere *a = read_database(text_file(database));

    assert_int_equal(a->level_count, 33);
    assert_near(a->level_altitude_m[26], 30000.0, 0.0);
    assert_near(a->level_temperature_k[32], 350.0, 0.0);
    atmosphere_free(a);
}

static void assert_same(const double *value, const double *expected, int count, double tolerance)
{
    for (int i = 0; i < count; i++) assert_near(value[i], expected[i], tolerance * expected[i]);
}

static void a_written_database_reads_as_it_was(void **state)
{
    const double digits = 5e-7; /* half the last of seven */

    (void)state;
    atmosphere *a = read_database(text_file(database));
    assert_int_equal(atmosphere_write(a, text_file_at), STATUS_OK);
    atmosphere *b = read_database(text_file_at);

    assert_string_equal(b->header, a->header);
    assert_near(b->path_zenith_meaningful_deg, 46.0, 0.0);
    assert_same(b->wavelength_um, a->wavelength_um, POINTS, digits);
    assert_same(b->solar_irradiance, a->solar_irradiance, POINTS, digits);
    assert_same(b->tau1, a->tau1, POINTS, digits);
    assert_same(b->path_range_m, a->path_range_m, PATHS, digits);
    assert_same(b->tau2, a->tau2, PATHS * POINTS, digits);
    assert_same(b->path_emitted, a->path_emitted, PATHS * POINTS, digits);
    assert_same(b->path_scattered, a->path_scattered, PATHS * POINTS, digits);
    assert_same(b->sky_emitted, a->sky_emitted, POINTS, digits);
    assert_same(b->sky_scattered, a->sky_scattered, POINTS, digits);
    assert_same(b->sky_emitted_direction, a->sky_emitted_direction, ZENITHS * AZIMUTHS * POINTS,
                digits);
    assert_same(b->sky_scattered_direction, a->sky_scattered_direction, ZENITHS * AZIMUTHS * POINTS,
                digits);
    assert_same(b->level_altitude_m, a->level_altitude_m, LEVELS, digits);
    assert_same(b->level_temperature_k, a->level_temperature_k, LEVELS, digits);
    atmosphere_free(a);
    atmosphere_free(b);
}

static void a_sky_without_azimuths_is_read(void **state)
{
    static const char text[] = "0\n10\n10\n1000\n1000\n1\n1\n0\n0\n1\n0\n1\n"
                               "10 1000 0 1\n0 1\n1 0 0\n1e-4 0\n"
                               "0 0\n1e-4 0\n45 0\n2e-4 0\n90 0\n3e-4 0\n1\n0 288\n";

    (void)state;
    atmosphere *a = read_database(text_file(text));

    assert_int_equal(a->zenith_count, 3);
    assert_int_equal(a->azimuth_count, 1);
    assert_near(a->zenith_step_deg, 45.0, 0.0);
    assert_near(a->sky_emitted_direction[2], 3.0, 1e-12); /* double */
    atmosphere_free(a);
}

static void a_wrong_database_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"10.000000\n", "10000\n", 3, "the sensor altitude in km from 0 to 1000"},
        {"\n750.0", "\n760.0", 6, "the wavenumber of 13.3333 um"},
        {"\n1250.0", "\n1260.0", 7, "the wavenumber of 8 um"},
        {"\n6\n", "\n7\n", 9, "the number of points from 750 to 1250 cm-1 by 100"},
        {"\n3\n", "\n4\n", 14, "the number of angles from 40 to 52 degrees by 6"},
        {"1150.000000 4.5", "1160.000000 4.5", 16, "8.695652 um and 1150 cm-1 first"},
        {"8.695652 1150", "8.705652 1150", 16, "8.695652 um and 1150 cm-1 first"},
        {"5.500000e-01", "5.500000e+00", 16, "number 4 from 0 to 1"},
        {"4.500000e-05", "4.500000e+00", 16, "number 3 from 0 to 1"},
        {"46.000000 14", "47.000000 14", 28, "the zenith angle 46 and a range above 0 km"},
        {"6.000000e-01 2.000000e-04", "6.000000e-01 -2.0e-04", 23, "number 2 from 0 to 1"},
        {"0.000000 30.000000\n", "0.000000 45.000000\n", 62,
         "the zenith angle 0 and the azimuth 90"},
        {"0.000000 360.000000\n", "0.000000 330.000000\n", 132,
         "the zenith angle 0 and the azimuth"},
        {"15.000000 30.000000\n", "15.000000 60.000000\n", 146,
         "the zenith angle 15 and the azimuth 30"},
        {"30.000000 0.000000\n", "45.000000 0.000000\n", 230,
         "the zenith angle 30 and the azimuth 0"},
        {"75.000000 0.000000\n", "33\n", 503, "the direction after zenith 60, azimuth 360"},
        {"90.000000 360.000000\n", "33\n", 678, "all azimuths"},
        {"\n33\n", "\n34\n", 719, "the file ends"},
        {"\n33\n", "\n32\n", 718, "the end of the file"},
        {"\n2.000000 350.0", "\n1.000000 350.0", 688, "a rising altitude in km"},
        {"\n2.000000 350.0", "\n2.000000 35.0", 688, "a temperature from 100 to 1000 K"},
        {"\n33\n", "\nx\n", 685, "two angles of a direction, or the number of levels"},
    };
    atmosphere *a = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(atmosphere_read(&a, text_file_with(database, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
    assert_null(a);
}

static void a_database_cut_inside_its_last_number_is_refused(void **state)
{
    atmosphere *a = NULL;

    (void)state;
    text_file(database);
    assert_int_equal(truncate(text_file_at, (off_t)strlen(database) - 2), 0);
    assert_refused(atmosphere_read(&a, text_file_at), 718, "a number may be cut");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_grids_of_the_head_are_read),
        cmocka_unit_test(sun_and_paths_turn_to_square_metres),
        cmocka_unit_test(the_printed_sky_is_read),
        cmocka_unit_test(the_printed_profile_is_read),
        cmocka_unit_test(a_written_database_reads_as_it_was),
        cmocka_unit_test(a_sky_without_azimuths_is_read),
        cmocka_unit_test(a_wrong_database_is_refused_at_its_line),
        cmocka_unit_test(a_database_cut_inside_its_last_number_is_refused),
    };

    return cmocka_run_group_tests_name("atmosphere", tests, fill_database, text_file_teardown);
}
