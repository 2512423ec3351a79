#include "../assert_near.h"

#include "mesh/polygon.h"

#include <stdlib.h>
#include <string.h>
#include <time.h>

enum { LIMIT = 16, LARGE = 32000 };

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

static double turn(const double *a, const double *b, const double *c)
{
    return (b[0] - a[0]) * (c[1] - a[1]) - (b[1] - a[1]) * (c[0] - a[0]);
}

static int is_same(const double *a, const double *b)
{
    return a[0] == b[0] && a[1] == b[1];
}

/* The definition of an ear, by looking at all corners that are left. */
static int is_ear(const uint32_t *left, uint32_t count, uint32_t i, const double (*p)[3])
{
    const double *a = p[left[(i + count - 1) % count]], *b = p[left[i]];
    const double *c = p[left[(i + 1) % count]];

    if (turn(a, b, c) <= 0) return 0;
    for (uint32_t k = 0; k < count; k++) {
        const double *at = p[left[k]];
        if (is_same(at, a) || is_same(at, b) || is_same(at, c)) continue;
        if (turn(a, b, at) >= 0 && turn(b, c, at) >= 0 && turn(c, a, at) >= 0) return 0;
    }
    return 1;
}

/* Ears one by one, each the first one from the corner after the one behind the last cut; without an
 * ear the first corner in line with its neighbours, without that where the search began. */
static void split_slowly(uint32_t count, const double (*p)[3], uint32_t (*triangle)[3])
{
    uint32_t left[LIMIT * LIMIT], start = 1;

    for (uint32_t i = 0; i < count; i++) left[i] = i;
    for (; count > 2; count--, triangle++) {
        uint32_t tries = 0, k;
        while (tries < count && !is_ear(left, count, (start + tries) % count, p)) tries++;
        for (k = 0; tries == count && k < count; k++) {
            const uint32_t i = (start + k) % count;
            if (turn(p[left[(i + count - 1) % count]], p[left[i]], p[left[(i + 1) % count]]) == 0)
                break;
        }
        const uint32_t i = (start + (tries < count ? tries : k)) % count;
        (*triangle)[0] = left[(i + count - 1) % count];
        (*triangle)[1] = left[i];
        (*triangle)[2] = left[(i + 1) % count];
        memmove(left + i, left + i + 1, (count - i - 1) * sizeof *left);
        start = (i < count - 1 ? i + 1 : 1) % (count - 1);
    }
}

/* Corners on a small grid, so that many are in line or at one place; every other face is a star. */
static void any_face_is_cut_as_if_all_corners_were_looked_at(void **state)
{
    (void)state;
    for (uint32_t face = 0; face < 400; face++) {
        double p[LIMIT * LIMIT][3] = {{0}};
        uint32_t corner[LIMIT * LIMIT], got[LIMIT * LIMIT][3], expected[LIMIT * LIMIT][3];
        const uint32_t count = 5 + face * 17 % (LIMIT * LIMIT - 5);
        double area2 = 0;

        srand(face);
        for (uint32_t i = 0; i < count; i++) {
            const double reach = face % 2 ? 2 + rand() % 20 : rand() % 20;
            const double angle = face % 2 ? 6.283185307179586 * i / count : rand();
            corner[i] = i;
            p[i][0] = round(reach * cos(angle));
            p[i][1] = round(reach * sin(angle));
        }
        for (uint32_t i = 0; i < count; i++) area2 += turn(p[0], p[i], p[(i + 1) % count]);
        if (area2 == 0) continue; /* it has no plane of largest area */
        for (uint32_t i = 0; i < count; i++) p[i][1] *= area2 < 0 ? -1 : 1;
        split_slowly(count, (const double(*)[3])p, expected);
        assert_int_equal(polygon_split(count, corner, (const double(*)[3])p, got), STATUS_OK);
        assert_memory_equal(got, expected, (count - 2) * sizeof *got);
    }
}

/* Corners anywhere in a square: looking at all of them took ten minutes. */
static void a_face_of_32000_corners_that_crosses_itself_is_cut_within_seconds(void **state)
{
    (void)state;
    static double p[LARGE][3];
    static uint32_t corner[LARGE], triangle[LARGE][3];
    const clock_t begin = clock();

    srand(1);
    for (uint32_t i = 0; i < LARGE; i++) {
        corner[i] = i;
        p[i][0] = rand();
        p[i][1] = rand();
    }
    assert_int_equal(polygon_split(LARGE, corner, (const double(*)[3])p, triangle), STATUS_OK);
    assert_true(clock() - begin < 5 * CLOCKS_PER_SEC);
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
        cmocka_unit_test(any_face_is_cut_as_if_all_corners_were_looked_at),
        cmocka_unit_test(a_face_of_32000_corners_that_crosses_itself_is_cut_within_seconds),
        cmocka_unit_test(a_quad_is_cut_between_its_first_and_third_corner),
        cmocka_unit_test(a_quad_is_cut_from_the_corner_where_it_is_concave),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
