#include "assert_near.h"

#include "polygon.h"

enum { LIMIT = 16 };

/* Signed area of a triangle seen along an axis. */
static double area(const double (*p)[3], const uint32_t c[3], int axis)
{
    const int x = (axis + 1) % 3, y = (axis + 2) % 3;

    return .5 * ((p[c[1]][x] - p[c[0]][x]) * (p[c[2]][y] - p[c[0]][y]) -
                 (p[c[1]][y] - p[c[0]][y]) * (p[c[2]][x] - p[c[0]][x]));
}

/* Splits a polygon; fails where a triangle turns the other way; returns the sum of areas. */
static double split_area(uint32_t count, const double (*p)[3], int axis, double sign)
{
    uint32_t corner[LIMIT] = {0}, triangle[LIMIT][3];
    double sum = 0;

    for (uint32_t i = 0; i < count; i++) corner[i] = i;
    assert_int_equal(polygon_split(count, corner, p, triangle), STATUS_OK);
    for (uint32_t i = 0; i < count - 2; i++) {
        assert_true(sign * area(p, triangle[i], axis) >= 0);
        sum += area(p, triangle[i], axis);
    }
    return sum;
}

static void a_convex_face_keeps_its_area(void **state)
{
    (void)state;
    double p[12][3];

    for (int i = 0; i < 12; i++) {
        p[i][0] = 100 + cos(i * 3.141592653589793 / 6);
        p[i][1] = 200 + sin(i * 3.141592653589793 / 6);
        p[i][2] = 5;
    }

    assert_near(split_area(12, p, 2, 1), 3, 1e-12); /* 12 sin(30) / 2 */
}

static void a_concave_face_keeps_its_area(void **state)
{
    (void)state;
    const double comb[8][3] = {{0, 0, 0}, {5, 0, 0}, {5, 4, 0}, {4, 1, 0},
                               {3, 4, 0}, {2, 1, 0}, {1, 4, 0}, {0, 4, 0}};

    assert_near(split_area(8, comb, 2, 1), 14, 1e-12); /* 20 less notches of 2 x 3 / 2 each */
}

static void a_face_that_turns_clockwise_gives_triangles_that_do(void **state)
{
    (void)state;
    const double wall[5][3] = {{0, 0, 0}, {0, 0, 4}, {0, 2, 1}, {0, 4, 4}, {0, 4, 0}};

    assert_near(split_area(5, wall, 0, -1), -10, 1e-12); /* 16 less a notch of 4 x 3 / 2 */
}

static void corners_in_line_keep_the_area(void **state)
{
    (void)state;
    const double p[6][3] = {{0, 0, 0}, {1, 0, 0}, {2, 0, 0}, {2, 2, 0}, {1, 2, 0}, {0, 2, 0}};

    assert_near(split_area(6, p, 2, 1), 4, 1e-12);
}

/* A square with a square hole, joined by a cut that is walked twice. */
static void a_hole_behind_a_cut_stays_open(void **state)
{
    (void)state;
    const double p[10][3] = {{0, 0, 0}, {4, 0, 0}, {4, 4, 0}, {0, 4, 0}, {0, 0, 0},
                             {1, 1, 0}, {1, 3, 0}, {3, 3, 0}, {3, 1, 0}, {1, 1, 0}};

    assert_near(split_area(10, p, 2, 1), 12, 1e-12);
}

static void a_face_without_area_gives_triangles_all_the_same(void **state)
{
    (void)state;
    const double p[6][3] = {{0, 0, 0}, {1, 1, 1}, {2, 2, 2}, {3, 3, 3}, {NAN, 0, 0}, {1, 1, 1}};
    const uint32_t corner[6] = {0, 1, 2, 3, 4, 5};
    uint32_t triangle[4][3];

    assert_int_equal(polygon_split(6, corner, p, triangle), STATUS_OK);
    for (int i = 0; i < 4; i++)
        for (int k = 0; k < 3; k++) assert_true(triangle[i][k] < 6);
}

static void a_quad_is_cut_between_its_first_and_third_corner(void **state)
{
    (void)state;
    const float p[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const uint32_t corner[4] = {0, 1, 2, 3};

    assert_int_equal(polygon_diagonal(corner, p), 0);
}

static void a_quad_is_cut_from_the_corner_where_it_is_concave(void **state)
{
    (void)state;
    const float p[4][3] = {{0, 0, 0}, {4, 2, 0}, {0, 4, 0}, {1, 2, 0}};

    for (uint32_t first = 0; first < 4; first++) {
        const uint32_t corner[4] = {first, (first + 1) % 4, (first + 2) % 4, (first + 3) % 4};

        assert_int_equal(polygon_diagonal(corner, p), (first + 1) % 2);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_convex_face_keeps_its_area),
        cmocka_unit_test(a_concave_face_keeps_its_area),
        cmocka_unit_test(a_face_that_turns_clockwise_gives_triangles_that_do),
        cmocka_unit_test(corners_in_line_keep_the_area),
        cmocka_unit_test(a_hole_behind_a_cut_stays_open),
        cmocka_unit_test(a_face_without_area_gives_triangles_all_the_same),
        cmocka_unit_test(a_quad_is_cut_between_its_first_and_third_corner),
        cmocka_unit_test(a_quad_is_cut_from_the_corner_where_it_is_concave),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
