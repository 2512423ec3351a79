/* Name patterns against glob(7). */
#include "base/name_pattern.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <string.h>

#include <cmocka.h>

static void a_pattern_fits_what_glob_says(void **state)
{
    static const struct {
        const char *pattern, *name;
        bool fits;
    } given[] = {
        {"", "", true},
        {"", "a", false},
        {"a", "", false},
        {"*", "", true},
        {"*", "abc", true},
        {"a*c", "abbc", true},
        {"a*c", "abcd", false},
        {"*b*", "abc", true},
        {"*.001", "Material.001", true},
        {"a**", "a", true},
        {"?", "a", true},
        {"?", "", false},
        {"?", "\xc3\xa9", true},
        {"B?ton", "B\xc3\xa9ton", true},
        {"[abc]", "b", true},
        {"[abc]", "d", false},
        {"[a-c]x", "cx", true},
        {"[!a-c]", "d", true},
        {"[^a-c]", "b", false},
        {"[]a]", "]", true},
        {"[a-]", "-", true},
        {"[\xc3\xa0-\xc3\xbc]", "\xc3\xa9", true},
        {"[ab", "[ab", true},
        {"[", "[", true},
        {"\\*", "*", true},
        {"\\*", "a", false},
        {"[\\]]", "]", true},
        {"a\\", "a\\", true},
        {"Wall_[0-9]*", "Wall_12", true},
        {"wall", "Wall", false},
    };
    (void)state;

    for (size_t i = 0; i < sizeof given / sizeof *given; i++)
        if (name_pattern_fits(given[i].pattern, given[i].name) != given[i].fits)
            fail_msg("%s against %s", given[i].pattern, given[i].name);
}

/* Of exponential time this would never end. */
static void many_stars_take_no_longer(void **state)
{
    char name[4096], pattern[201];
    (void)state;

    memset(name, 'a', sizeof name);
    name[sizeof name - 1] = '\0';
    for (int i = 0; i < 198; i += 2) memcpy(pattern + i, "*a", 2);
    strcpy(pattern + 198, "*b");
    assert_false(name_pattern_fits(pattern, name));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_pattern_fits_what_glob_says),
        cmocka_unit_test(many_stars_take_no_longer),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
