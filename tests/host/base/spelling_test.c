#include "base/spelling.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>
#include <string.h>

#include <cmocka.h>

static void the_distance_is_the_count_of_edits(void **state)
{
    static const struct {
        const char *a, *b;
        size_t distance;
    } pairs[] = {{"", "", 0},
                 {"", "abc", 3},
                 {"foo", "fov", 1},
                 {"kitten", "sitting", 3}, /* Levenshtein's example in every textbook */
                 {"chekc", "check", 1},    /* swapped */
                 {"ca", "abc", 3},         /* each letter edited once at most */
                 {"render", "rendr", 1},
                 {"size", "sizes", 1}};
    (void)state;

    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++) {
        assert_int_equal(spelling_distance(pairs[i].a, pairs[i].b), pairs[i].distance);
        assert_int_equal(spelling_distance(pairs[i].b, pairs[i].a), pairs[i].distance);
    }
}

static const char *nearest(const char *word)
{
    static const char *const known[] = {"output", "size", "fov", "latitude_deg", "x"};
    spelling s = spelling_of(word);

    for (size_t i = 0; i < sizeof known / sizeof *known; i++) spelling_offer(&s, known[i]);
    return s.nearest;
}

static void the_nearest_name_is_offered_and_a_far_one_is_not(void **state)
{
    (void)state;

    assert_string_equal(nearest("sise"), "size");
    assert_string_equal(nearest("foo"), "fov");
    assert_string_equal(nearest("latitud_degg"), "latitude_deg");
    assert_string_equal(nearest("lat"), "latitude_deg"); /* begins so */
    assert_null(nearest("colour"));
    assert_null(nearest("y")); /* all of it would be wrong */
    assert_null(nearest(""));
}

static void long_words_are_cut_and_not_overrun(void **state)
{
    char long_word[400];
    (void)state;

    memset(long_word, 'a', sizeof long_word - 1);
    long_word[sizeof long_word - 1] = '\0';
    assert_int_equal(spelling_distance(long_word, "b"), 63);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_distance_is_the_count_of_edits),
        cmocka_unit_test(the_nearest_name_is_offered_and_a_far_one_is_not),
        cmocka_unit_test(long_words_are_cut_and_not_overrun),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
