#include "hemisphere/point_order.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

enum { COUNT = 3 * PIXEL_GROUP };

/* One row of an image. */
static const point_tile row = {.count = COUNT, .columns = COUNT, .samples = 1};

static facet_record facet[3] = {{.material = 0}, {.material = 1}, {.material = 0}};

static hit_record point(uint32_t of_facet, float x, float z)
{
    return (hit_record){.facet = of_facet, .normal = {x, 0.0f, z}};
}

/* Every second one is level; the rest faces ways of its own but for two. */
static void fill(hit_record hit[COUNT])
{
    for (int i = 0; i < COUNT; i++)
        hit[i] = i % 2 ? point(0, 0.0f, 1.0f) : point(2, (float)i / COUNT, .5f);
}

static void every_point_stands_once(void **state)
{
    hit_record hit[COUNT];
    uint32_t order[COUNT], set[COUNT], seen[COUNT] = {0};

    (void)state;
    fill(hit);
    assert_int_equal(point_order_fill(order, set, hit, facet, &row), STATUS_OK);
    for (int i = 0; i < COUNT; i++) seen[order[i]]++;
    for (int i = 0; i < COUNT; i++) assert_int_equal(seen[i], 1);
}

static void those_that_face_alike_come_first_in_whole_groups(void **state)
{
    hit_record hit[COUNT];
    uint32_t order[COUNT], set[COUNT];

    (void)state;
    fill(hit);
    assert_int_equal(point_order_fill(order, set, hit, facet, &row), STATUS_OK);
    for (uint32_t i = 0; i < PIXEL_GROUP; i++) assert_int_equal(order[i], 2 * i + 1);
    /* The first that is left faces a way of its own, the level ones that are left stand together. */
    assert_int_equal(order[PIXEL_GROUP], 0);
    for (uint32_t i = 0; i < 8; i++)
        assert_int_equal(order[PIXEL_GROUP + 1 + i], 2 * PIXEL_GROUP + 1 + 2 * i);
    for (uint32_t i = PIXEL_GROUP + 9; i < COUNT; i++)
        assert_int_equal(order[i], 2 * (i - PIXEL_GROUP - 8));
}

static void materials_and_misses_are_kept_apart(void **state)
{
    hit_record hit[COUNT];
    uint32_t order[COUNT], set[COUNT];

    (void)state;
    for (int i = 0; i < COUNT; i++)
        hit[i] =
            i % 3 == 2 ? (hit_record){.facet = RECORD_NONE} : point((uint32_t)i % 3, 0.0f, 1.0f);
    assert_int_equal(point_order_fill(order, set, hit, facet, &row), STATUS_OK);
    for (uint32_t i = 0; i < COUNT; i++) assert_int_equal(order[i] % 3, i / PIXEL_GROUP);
}

static void the_sign_of_a_zero_does_not_count(void **state)
{
    hit_record hit[COUNT];
    uint32_t order[COUNT], set[COUNT];

    (void)state;
    for (uint32_t i = 0; i < COUNT; i++)
        hit[i] = i < PIXEL_GROUP ? point(1, 1.0f, 0.0f) : point(0, i % 2 ? 0.0f : -0.0f, 1.0f);
    assert_int_equal(point_order_fill(order, set, hit, facet, &row), STATUS_OK);
    for (uint32_t i = 0; i < COUNT; i++) assert_int_equal(order[i], i);
}

/* Where all are alike, squares of 8 x 8 follow each other, and within them groups' squares of 4 x 4; the
 * tile begins and ends within a row. */
static void neighbours_in_the_image_stand_together(void **state)
{
    enum { COLUMNS = 20, FIRST = 3, SIZE = 16 * COLUMNS - 8 };
    static hit_record hit[SIZE];
    static uint32_t order[SIZE], set[SIZE], seen[SIZE];
    const point_tile tile = {.first = FIRST, .count = SIZE, .columns = COLUMNS, .samples = 1};

    (void)state;
    for (int i = 0; i < SIZE; i++) hit[i] = point(0, 0.0f, 1.0f);
    assert_int_equal(point_order_fill(order, set, hit, facet, &tile), STATUS_OK);
    for (int i = 0; i < SIZE; i++) seen[order[i]]++;
    for (int i = 0; i < SIZE; i++) assert_int_equal(seen[i], 1);
    for (int i = 0; i < 61; i++) {
        const uint32_t pixel = FIRST + order[i], across = pixel % COLUMNS, down = pixel / COLUMNS;
        assert_true(across < 8 && down < 8);
        if (i < 13) assert_true(across < 4 && down < 4);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_point_stands_once),
        cmocka_unit_test(those_that_face_alike_come_first_in_whole_groups),
        cmocka_unit_test(materials_and_misses_are_kept_apart),
        cmocka_unit_test(the_sign_of_a_zero_does_not_count),
        cmocka_unit_test(neighbours_in_the_image_stand_together),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
