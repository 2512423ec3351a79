#include "base/terminal_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <string.h>

static void assert_cleaned(const char *text, const char *expected)
{
    char changed[64];

    strcpy(changed, text);
    terminal_text_clean(changed);
    assert_string_equal(changed, expected);
}

static void text_of_any_language_stays(void **state)
{
    static const char text[] = "grass\tgrün 草 \xf0\x9f\x8c\xb2\n";

    (void)state;
    assert_cleaned(text, text);
}

/* ECMA-48: C0 is 00 to 1f and 7f, C1 is U+0080 to U+009F, which UTF-8 writes as c2 80 to c2 9f. */
static void control_characters_of_both_sets_are_replaced(void **state)
{
    (void)state;
    assert_cleaned("a\x1b[31mb\rc\bd\x7f", "a?[31mb?c?d?");
    assert_cleaned("\xc2\x9b"
                   "31m",
                   "??31m");
}

/* RFC 3629: overlong forms, surrogates, what lies beyond U+10FFFF and bytes alone are no characters. */
static void what_is_not_utf_8_is_replaced(void **state)
{
    (void)state;
    assert_cleaned("\x9b"
                   "1m",
                   "?1m");
    assert_cleaned("\xc0\x9b", "??");
    assert_cleaned("\xed\xa0\x80", "???");
    assert_cleaned("\xf4\x90\x80\x80", "????");
    assert_cleaned("cut \xe8\x8d", "cut ??");
}

static void a_name_is_clean_if_it_can_be_shown_on_one_line(void **state)
{
    (void)state;
    assert_true(terminal_text_is_clean("airport grün"));
    assert_false(terminal_text_is_clean("air\nport"));
    assert_false(terminal_text_is_clean("air\x1bport"));
    assert_false(terminal_text_is_clean("\xff"));
}

static void a_copy_is_cut_and_has_one_line(void **state)
{
    char out[8];

    (void)state;
    assert_string_equal(terminal_text_copy(out, sizeof out, "a\nb\rcdefgh"), "a?b?cde");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(text_of_any_language_stays),
        cmocka_unit_test(control_characters_of_both_sets_are_replaced),
        cmocka_unit_test(what_is_not_utf_8_is_replaced),
        cmocka_unit_test(a_name_is_clean_if_it_can_be_shown_on_one_line),
        cmocka_unit_test(a_copy_is_cut_and_has_one_line),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
