#include "mesh/facet_sample.h"

#include "../assert_near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static float position[4][3] = {{0, 0, 1}, {4, 0, 1}, {4, 2, 1}, {0, 2, 1}};
static float normal[2][3] = {{0, 0, 1}, {0, 0, 1}};
static uint32_t corner[2][4] = {{0, 1, 2, 3}, {0, 1, 2, UINT32_MAX}};
static const geometry shape = {
    .facet_count = 2, .vertex_count = 4, .position = position, .corner = corner, .normal = normal};

static void mean_of(uint32_t facet, uint8_t level, double out[3])
{
    hit_record at[64];
    const uint32_t count = facet_sample_count(level);

    facet_sample(at, &shape, facet, level);
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0;
        for (uint32_t i = 0; i < count; i++) out[k] += (double)at[i].point[k] / count;
    }
}

static void the_points_of_a_triangle_have_its_centroid(void **state)
{
    double mean[3];

    (void)state;
    for (uint8_t level = 0; level < 4; level++) {
        mean_of(1, level, mean);
        assert_near(mean[0], 8.0 / 3.0, 1e-6);
        assert_near(mean[1], 2.0 / 3.0, 1e-6);
        assert_near(mean[2], 1.0, 1e-6);
    }
}

/* The second moments of points in a triangle come from the closed form as its parts get smaller: of x over
 * this one it is 4^2 / 18. */
static void points_are_spread_over_a_triangle(void **state)
{
    hit_record at[64];

    (void)state;
    for (uint8_t level = 1; level < 4; level++) {
        const uint32_t count = facet_sample_count(level);
        double sum = 0.0;
        facet_sample(at, &shape, 1, level);
        for (uint32_t i = 0; i < count; i++) {
            const double from = (double)at[i].point[0] - 8.0 / 3.0;
            sum += from * from / count;
        }
        /* Parts have moments of their own: 1 / count of the whole's. */
        assert_near(sum, (1.0 - 1.0 / count) * 16.0 / 18.0, 1e-5);
    }
}

static void half_of_the_points_lie_in_each_half_of_a_quad(void **state)
{
    hit_record at[64];

    (void)state;
    for (uint8_t level = 1; level < 4; level++) {
        const uint32_t count = facet_sample_count(level);
        uint32_t below = 0;
        facet_sample(at, &shape, 0, level);
        for (uint32_t i = 0; i < count; i++) {
            assert_true(at[i].point[0] > 0 && at[i].point[0] < 4);
            assert_true(at[i].point[1] > 0 && at[i].point[1] < 2);
            below += at[i].point[1] < 0.5f * at[i].point[0];
        }
        assert_int_equal(below, count / 2);
    }
}

static void a_quad_has_one_point_near_its_middle(void **state)
{
    double mean[3];

    (void)state;
    mean_of(0, 0, mean);
    assert_near(mean[0], 2.0, .2);
    assert_near(mean[1], 1.0, .1);
}

static void few_facets_have_many_points(void **state)
{
    static const float area[3] = {1e-4f, 1.0f, 1e6f};
    uint8_t level[3];

    (void)state;
    facet_sample_levels(level, area, 3);
    for (int i = 0; i < 3; i++) assert_int_equal(level[i], 3);
}

static void an_area_that_is_not_finite_has_the_fewest_points(void **state)
{
    static const float area[4] = {INFINITY, NAN, 0.0f, 1.0f};
    uint8_t level[4];

    (void)state;
    facet_sample_levels(level, area, 4);
    for (int i = 0; i < 3; i++) assert_true(level[i] <= level[3]);
}

/* Areas from 1 to 100,000, many small ones. */
static void of_many_facets_large_ones_have_more(void **state)
{
    enum { COUNT = 100000 };
    static float area[COUNT];
    static uint8_t level[COUNT];
    uint32_t points = 0;

    (void)state;
    for (int i = 0; i < COUNT; i++) area[i] = (float)COUNT / (float)(COUNT - i);
    facet_sample_levels(level, area, COUNT);
    for (int i = 0; i < COUNT; i++) points += facet_sample_count(level[i]);
    assert_true(points > COUNT && points <= 2 * COUNT);
    for (int i = 1; i < COUNT; i++) assert_true(level[i] >= level[i - 1]);
    assert_int_equal(level[0], 0);
    assert_int_equal(level[COUNT - 1], 3);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_points_of_a_triangle_have_its_centroid),
        cmocka_unit_test(points_are_spread_over_a_triangle),
        cmocka_unit_test(half_of_the_points_lie_in_each_half_of_a_quad),
        cmocka_unit_test(a_quad_has_one_point_near_its_middle),
        cmocka_unit_test(few_facets_have_many_points),
        cmocka_unit_test(an_area_that_is_not_finite_has_the_fewest_points),
        cmocka_unit_test(of_many_facets_large_ones_have_more),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
