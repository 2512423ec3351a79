#include "../assert_near.h"
#include "../text_file.h"

#include "sky/site.h"

/* Thesis Appendix A item 6. */
static const char printed[] = "10.000\n40.0000\n52.0000\n0.5000\n750.0\n1250.0\n100.0\n6\n24\n87\n"
                              "17.00\n39.773333\n84.108888\n";

static const double june_24_1987_s = 551491200.0; /* date -u -d 1987-06-24 +%s */

static double parsed(const char *iso)
{
    double time_s = -1.0;
    int offset;

    assert_int_equal(site_parse_time(iso, &time_s, &offset), STATUS_OK);
    return time_s;
}

static void an_offset_is_taken_off_the_local_time(void **state)
{
    (void)state;
    double time_s;
    int offset;

    assert_int_equal(site_parse_time("1987-06-24T10:00:00-05:00", &time_s, &offset), STATUS_OK);

    assert_near(time_s, june_24_1987_s + 15 * 3600, 0.0);
    assert_int_equal(offset, -300);
}

static void half_hours_of_offset_count(void **state)
{
    (void)state;
    assert_near(parsed("1987-06-24T05:30:00+05:30"), june_24_1987_s, 0.0);
}

static void fractions_of_a_second_count(void **state)
{
    (void)state;
    assert_near(parsed("1987-06-24T00:00:00.25Z"), june_24_1987_s + 0.25, 1e-6); /* double */
}

static void times_before_1970_are_negative(void **state)
{
    (void)state;
    assert_near(parsed("1969-12-31T23:59:59Z"), -1.0, 0.0);
}

static void leap_days_are_those_of_the_calendar(void **state)
{
    (void)state;
    double time_s;
    int offset;

    assert_near(parsed("2000-03-01T00:00:00Z") - parsed("2000-02-29T00:00:00Z"), 86400.0, 0.0);
    assert_int_equal(site_parse_time("1900-02-29T00:00:00Z", &time_s, &offset), STATUS_ARGUMENT);
}

static void what_is_no_time_is_refused(void **state)
{
    static const char *const wrong[] = {"",
                                        "1987-06-24",
                                        "1987-06-24T10:00:00",       /* no offset */
                                        "1987-06-31T10:00:00Z",      /* no such day */
                                        "1987-13-01T10:00:00Z",      /* no such month */
                                        "1987-06-24T24:00:00Z",      /* no such hour */
                                        "1987-06-24T10:60:00Z",      /* no such minute */
                                        "1987-06-24T10:00:00.Z",     /* no fraction */
                                        "1987-06-24T10:00:00-05:60", /* no such offset */
                                        "1987-06-24T10:00:00Z x",
                                        "87-06-24T10:00:00Z"};
    double time_s;
    int offset;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_int_equal(site_parse_time(wrong[i], &time_s, &offset), STATUS_ARGUMENT);
}

static void a_formatted_time_reads_as_it_was_written(void **state)
{
    static const char *const times[] = {"1987-06-24T10:00:00-05:00",
                                        "2000-02-29T23:59:59.500+05:30", "1969-12-31T00:00:00Z",
                                        "2100-01-01T00:00:00+14:00"};
    char text[SITE_TIME_SIZE];
    double time_s;
    int offset;

    (void)state;
    for (size_t i = 0; i < sizeof times / sizeof times[0]; i++) {
        assert_int_equal(site_parse_time(times[i], &time_s, &offset), STATUS_OK);
        site_format_time(time_s, offset, text);
        assert_string_equal(text, times[i]);
    }
}

static void the_printed_node_is_read(void **state)
{
    site_node node;

    (void)state;
    assert_int_equal(site_read_node(&node, text_file(printed)), STATUS_OK);

    assert_near(node.sensor_altitude_m, 10000.0, 0.0);
    assert_near(node.path_zenith_min_deg, 40.0, 0.0);
    assert_near(node.path_zenith_max_deg, 52.0, 0.0);
    assert_near(node.path_zenith_step_deg, 0.5, 0.0);
    assert_near(node.wavenumber_min_cm1, 750.0, 0.0);
    assert_near(node.wavenumber_max_cm1, 1250.0, 0.0);
    assert_near(node.wavenumber_step_cm1, 100.0, 0.0);
    assert_near(node.where.time_s, june_24_1987_s + 17 * 3600, 0.0);
    assert_near(node.where.latitude_deg, 39.773333, 0.0);
    assert_int_equal(node.where.utc_offset_min, 0);
}

static void longitude_turns_east_positive(void **state)
{
    site_node node;

    (void)state;
    assert_int_equal(site_read_node(&node, text_file(printed)), STATUS_OK);

    assert_near(node.where.longitude_deg, -84.108888, 0.0);
}

static void a_year_of_four_digits_stands_for_itself(void **state)
{
    site_node node;

    (void)state;
    assert_int_equal(site_read_node(&node, text_file_with(printed, "\n87\n", "\n1987\n")),
                     STATUS_OK);

    assert_near(node.where.time_s, june_24_1987_s + 17 * 3600, 0.0);
}

static void a_wrong_node_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"10.000", "ten", 1, "the sensor altitude in km"},
        {"52.0000", "32.0", 3, "the maximum zenith angle"},
        {"0.5000", "0.7", 4, "dividing 40 to 52"},
        {"1250.0", "1250.0 1", 6, "the maximum wavenumber"},
        {"\n6\n", "\n13\n", 8, "the month from 1 to 12"},
        {"\n6\n24\n", "\n6\n31\n", 10, "the day 31 of line 9"},
        {"\n87\n", "\n187\n", 10, "two digits or four"},
        {"17.00", "25.00", 11, "the hour in GMT from 0 to 24"},
        {"39.77", "139.77", 12, "the latitude in degrees from -90 to 90"},
        {"84.108888\n", "", 13, "the file ends, expected the west-positive longitude"},
        {"84.108888\n", "84.1\n5\n", 14, "the end of the file"},
    };
    site_node node;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(site_read_node(&node, text_file_with(printed, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(an_offset_is_taken_off_the_local_time),
        cmocka_unit_test(half_hours_of_offset_count),
        cmocka_unit_test(fractions_of_a_second_count),
        cmocka_unit_test(times_before_1970_are_negative),
        cmocka_unit_test(leap_days_are_those_of_the_calendar),
        cmocka_unit_test(what_is_no_time_is_refused),
        cmocka_unit_test(a_formatted_time_reads_as_it_was_written),
        cmocka_unit_test(the_printed_node_is_read),
        cmocka_unit_test(longitude_turns_east_positive),
        cmocka_unit_test(a_year_of_four_digits_stands_for_itself),
        cmocka_unit_test(a_wrong_node_is_refused_at_its_line),
    };

    return cmocka_run_group_tests_name("site", tests, text_file_setup, text_file_teardown);
}
