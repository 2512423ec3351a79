#include "../assert_near.h"
#include "../text_file.h"

#include "scene/view.h"

/* Thesis Appendix A item 1. */
static const char printed[] =
    "90.6849 119.9939 0.000\n7162.3865 -6951.7077 10000.0\n45.0 -45.0 0.0\n"
    "3790.47023\n512 512\n";

static const double no_origin[3] = {0.0, 0.0, 0.0};

/* Float32 holds camera directions to 6e-8 of their length, which is about 1. */
static const double float_error = 3e-7;

static int forget_warnings(void **state)
{
    (void)state;
    status_warnings();
    return 0;
}

static view read_printed(void)
{
    view v;

    assert_int_equal(view_read(&v, text_file(printed)), STATUS_OK);
    return v;
}

static void direction(const camera_record *c, double column, double row, double out[3])
{
    for (int i = 0; i < 3; i++)
        out[i] = (double)c->corner[i] + column * (double)c->across[i] + row * (double)c->down[i];
}

static void assert_direction(const camera_record *c, double column, double row, double east,
                             double north, double up)
{
    double d[3];

    direction(c, column, row, d);
    assert_near(d[0], east, float_error);
    assert_near(d[1], north, float_error);
    assert_near(d[2], up, float_error);
}

static void the_printed_view_is_read_in_enu(void **state)
{
    (void)state;
    const view v = read_printed();

    assert_near(v.target_m[0], -119.9939, 0.0);
    assert_near(v.target_m[1], 90.6849, 0.0);
    assert_near(v.position_m[0], 6951.7077, 0.0);
    assert_near(v.position_m[1], 7162.3865, 0.0);
    assert_near(v.position_m[2], 10000.0, 0.0);
    assert_near(v.twist_deg, 0.0, 0.0);
    assert_near(v.focal_length_mm, 3790.47023, 0.0);
    assert_int_equal(v.columns, 512);
    assert_int_equal(v.rows, 512);
}

static void the_printed_angles_agree_with_target_and_position(void **state)
{
    (void)state;
    read_printed();

    assert_string_equal(status_warnings(), "");
}

static void angles_that_disagree_are_a_warning(void **state)
{
    view v;

    (void)state;
    assert_int_equal(view_read(&v, text_file_with(printed, "45.0 -45.0", "45.0 -44.8")), STATUS_OK);
    assert_non_null(strstr(status_warnings(), "file:3: found elevation 45 and azimuth -44.8"));
    assert_int_equal(view_read(&v, text_file_with(printed, "45.0 -45.0", "45.2 315.0")), STATUS_OK);
    assert_non_null(strstr(status_warnings(), "file:3: found elevation 45.2 and azimuth 315"));
}

static void an_azimuth_may_be_a_full_turn_more(void **state)
{
    view v;

    (void)state;
    assert_int_equal(view_read(&v, text_file_with(printed, "45.0 -45.0", "45.0 315.0")), STATUS_OK);
    assert_string_equal(status_warnings(), "");
}

static void a_wrong_view_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"90.6849 119", "90.6849 x119", 1, "the target's x, y and z"},
        {"7162.3865 -6951.7077 10000.0", "90.6849 119.9939 0", 2, "a sensor away from its target"},
        {"45.0 -45.0 0.0", "45.0 -45.0", 3, "elevation, azimuth and twist"},
        {"3790.47023", "0", 4, "the focal length in mm"},
        {"512 512", "512 512.5", 5, "whole numbers"},
        {"512 512", "0 512", 5, "whole numbers"},
        {"512 512", "512 512\n1", 6, "the end of the file"},
    };
    view v;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(view_read(&v, text_file_with(printed, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
}

static void the_centre_ray_meets_the_target(void **state)
{
    (void)state;
    const view v = read_printed();
    const camera_record c = view_camera(&v, no_origin);
    double d[3], away = 0.0;

    direction(&c, 256.0, 256.0, d);
    const double range = v.position_m[2] / -d[2]; /* the target lies at z 0 */
    for (int i = 0; i < 3; i++)
        away = fmax(away, fabs(v.position_m[i] + range * d[i] - v.target_m[i]));
    assert_near(away, 0.0, 0.005); /* 14 km x 3e-7 */
}

/* Looking north, 36 mm lens: the picture is as wide as it is away. */
static void corners_lie_at_half_the_film_over_the_focal_length(void **state)
{
    const view v = {.position_m = {0, 0, 0},
                    .target_m = {0, 50, 0},
                    .twist_deg = 0.0,
                    .focal_length_mm = 36.0,
                    .columns = 4,
                    .rows = 2};

    (void)state;
    const camera_record c = view_camera(&v, no_origin);

    assert_direction(&c, 0, 0, -0.5, 1.0, 0.25); /* top left */
    assert_direction(&c, 4, 0, 0.5, 1.0, 0.25);  /* top right */
    assert_direction(&c, 4, 2, 0.5, 1.0, -0.25); /* square pixels: half as high as wide */
}

/* A point to the right of the line of sight, 45 degrees down from the south: east. */
static void what_is_to_the_right_has_a_larger_column(void **state)
{
    const view v = {.position_m = {0, -100, 100},
                    .target_m = {0, 0, 0},
                    .twist_deg = 0.0,
                    .focal_length_mm = 36.0,
                    .columns = 100,
                    .rows = 100};

    (void)state;
    const camera_record c = view_camera(&v, no_origin);

    assert_direction(&c, 100, 50, 0.5, sqrt(0.5), -sqrt(0.5));
}

static void straight_down_the_top_is_north(void **state)
{
    const view v = {.position_m = {0, 0, 100},
                    .target_m = {0, 0, 0},
                    .twist_deg = 0.0,
                    .focal_length_mm = 36.0,
                    .columns = 2,
                    .rows = 2};

    (void)state;
    const camera_record c = view_camera(&v, no_origin);

    assert_direction(&c, 1, 0, 0.0, 0.5, -1.0);
    assert_direction(&c, 2, 1, 0.5, 0.0, -1.0);
}

static void straight_up_the_top_is_north(void **state)
{
    const view v = {.position_m = {0, 0, 0},
                    .target_m = {0, 0, 100},
                    .twist_deg = 0.0,
                    .focal_length_mm = 36.0,
                    .columns = 2,
                    .rows = 2};

    (void)state;
    const camera_record c = view_camera(&v, no_origin);

    assert_direction(&c, 1, 0, 0.0, 0.5, 1.0);
    assert_direction(&c, 2, 1, -0.5, 0.0, 1.0);
}

/* A quarter turn counterclockwise brings what was at the right to the top. */
static void a_positive_twist_turns_the_picture_counterclockwise(void **state)
{
    const view v = {.position_m = {0, 0, 0},
                    .target_m = {0, 50, 0},
                    .twist_deg = 90.0,
                    .focal_length_mm = 36.0,
                    .columns = 2,
                    .rows = 2};

    (void)state;
    const camera_record c = view_camera(&v, no_origin);

    assert_direction(&c, 1, 0, 0.5, 1.0, 0.0); /* top: east */
    assert_direction(&c, 2, 1, 0.0, 1.0, -0.5);
}

static void the_camera_stands_relative_to_the_origin(void **state)
{
    const view v = {.position_m = {1000, 2000, 30},
                    .target_m = {1000, 2050, 30},
                    .twist_deg = 0.0,
                    .focal_length_mm = 36.0,
                    .columns = 2,
                    .rows = 2};
    const double origin[3] = {900, 1800, 10};

    (void)state;
    const camera_record c = view_camera(&v, origin);

    assert_near((double)c.position[0], 100.0, 0.0);
    assert_near((double)c.position[1], 200.0, 0.0);
    assert_near((double)c.position[2], 20.0, 0.0);
    assert_direction(&c, 1, 1, 0.0, 1.0, 0.0);
}

static void a_written_view_is_read_back_to_the_last_bit(void **state)
{
    (void)state;
    const view v = {.position_m = {1.0 / 3.0, -200.1, 1e4 / 7.0},
                    .target_m = {-0.1, 2.2, 0.3},
                    .twist_deg = 12.3,
                    .focal_length_mm = 35.7,
                    .columns = 640,
                    .rows = 481};
    view back;

    assert_int_equal(view_write(&v, text_file("")), STATUS_OK);
    assert_int_equal(view_read(&back, text_file_at), STATUS_OK);
    assert_memory_equal(back.position_m, v.position_m, sizeof v.position_m);
    assert_memory_equal(back.target_m, v.target_m, sizeof v.target_m);
    assert_true(back.twist_deg == v.twist_deg && back.focal_length_mm == v.focal_length_mm);
    assert_true(back.columns == v.columns && back.rows == v.rows);
    assert_string_equal(status_warnings(), "");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_view_is_read_in_enu),
        cmocka_unit_test_setup(the_printed_angles_agree_with_target_and_position, forget_warnings),
        cmocka_unit_test_setup(angles_that_disagree_are_a_warning, forget_warnings),
        cmocka_unit_test_setup(an_azimuth_may_be_a_full_turn_more, forget_warnings),
        cmocka_unit_test(a_wrong_view_is_refused_at_its_line),
        cmocka_unit_test(the_centre_ray_meets_the_target),
        cmocka_unit_test(corners_lie_at_half_the_film_over_the_focal_length),
        cmocka_unit_test(what_is_to_the_right_has_a_larger_column),
        cmocka_unit_test(straight_down_the_top_is_north),
        cmocka_unit_test(straight_up_the_top_is_north),
        cmocka_unit_test(a_positive_twist_turns_the_picture_counterclockwise),
        cmocka_unit_test(the_camera_stands_relative_to_the_origin),
        cmocka_unit_test_setup(a_written_view_is_read_back_to_the_last_bit, forget_warnings),
    };

    return cmocka_run_group_tests_name("view", tests, text_file_setup, text_file_teardown);
}
