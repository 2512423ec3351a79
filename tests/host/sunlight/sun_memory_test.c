#include "sunlight/sun_memory.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

enum { POINTS = 3, WORDS = 2 };

static sun_memory_entry *find(sun_memory *memory, const hit_record *hit, uint32_t count,
                              uint32_t words)
{
    sun_memory_entry *entry = NULL;

    assert_int_equal(sun_memory_find(memory, hit, count, words, &entry), STATUS_OK);
    return entry;
}

static void points_that_were_met_before_have_what_was_kept(void **state)
{
    hit_record hit[POINTS] = {
        {.facet = 1, .point = {1.0f, 2.0f, 3.0f}}, {.facet = 2}, {.facet = 9}};
    hit_record moved[POINTS];
    sun_memory *memory = NULL;

    (void)state;
    memcpy(moved, hit, sizeof moved);
    moved[POINTS - 1].point[2] = 1e-30f;
    assert_int_equal(sun_memory_open(&memory), STATUS_OK);
    sun_memory_entry *first = find(memory, hit, POINTS, WORDS);
    assert_int_equal(first->last, SUN_MEMORY_NOTHING);
    first->last = 7;
    first->lit[POINTS * WORDS - 1] = 5;
    assert_ptr_not_equal(find(memory, moved, POINTS, WORDS), first);
    assert_ptr_not_equal(find(memory, hit, POINTS - 1, WORDS), first);
    assert_ptr_not_equal(find(memory, hit, POINTS, WORDS + 1), first);

    memset(moved, 0, sizeof moved); /* what was kept is not the caller's */
    assert_ptr_equal(find(memory, hit, POINTS, WORDS), first);
    assert_int_equal(first->last, 7);
    assert_int_equal(first->lit[POINTS * WORDS - 1], 5);
    sun_memory_free(memory);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(points_that_were_met_before_have_what_was_kept),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
