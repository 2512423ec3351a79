#include "facet_sample.h"

#include "assert_near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static float position[4][3] = {{0, 0, 1}, {4, 0, 1}, {4, 2, 1}, {0, 2, 1}};
static float normal[2][3] = {{0, 0, 1}, {0, 0, 1}};
static uint32_t corner[2][4] = {{0, 1, 2, 3}, {0, 1, 2, UINT32_MAX}};
static const geometry shape = {
    .facet_count = 2, .vertex_count = 4, .position = position, .corner = corner, .normal = normal};

static void mean_of(uint32_t facet, double out[3])
{
    hit_record at[FACET_SAMPLES];

    facet_sample(at, &shape, facet);
    for (int k = 0; k < 3; k++) {
        out[k] = 0.0;
        for (int i = 0; i < FACET_SAMPLES; i++) out[k] += (double)at[i].point[k] / FACET_SAMPLES;
    }
}

static void the_points_of_a_triangle_have_its_centroid(void **state)
{
    double mean[3];

    (void)state;
    mean_of(1, mean);

    assert_near(mean[0], 8.0 / 3.0, 1e-6);
    assert_near(mean[1], 2.0 / 3.0, 1e-6);
    assert_near(mean[2], 1.0, 1e-6);
}

static void two_points_lie_in_each_half_of_a_quad(void **state)
{
    hit_record at[FACET_SAMPLES];
    int below = 0;

    (void)state;
    facet_sample(at, &shape, 0);

    for (int i = 0; i < FACET_SAMPLES; i++) {
        assert_true(at[i].point[0] > 0 && at[i].point[0] < 4);
        assert_true(at[i].point[1] > 0 && at[i].point[1] < 2);
        below += at[i].point[1] < 0.5f * at[i].point[0];
    }
    assert_int_equal(below, 2);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_points_of_a_triangle_have_its_centroid),
        cmocka_unit_test(two_points_lie_in_each_half_of_a_quad),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
