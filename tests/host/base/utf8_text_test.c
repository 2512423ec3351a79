/* UTF-8 text: names in either of two encodings. */
#include "base/utf8_text.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

static void assert_copy(const char *text, const char *expected)
{
    char *copy = utf8_text_copy(text);

    assert_string_equal(copy, expected);
    free(copy);
}

static void a_text_in_utf_8_stays_as_it_is(void **state)
{
    (void)state;
    assert_copy("", "");
    assert_copy("wall", "wall");
    assert_copy("B\xc3\xa9ton \xe6\x9c\xa8 \xf0\x9f\xa7\xb1",
                "B\xc3\xa9ton \xe6\x9c\xa8 \xf0\x9f\xa7\xb1");
}

static void a_text_in_latin_1_becomes_utf_8(void **state)
{
    (void)state;
    assert_copy("B\xe9ton", "B\xc3\xa9ton");
    assert_copy("\xff\xc0\x80", "\xc3\xbf\xc3\x80\xc2\x80"); /* the last two an overlong zero */
}

/* RFC 3629: overlong forms, surrogates, beyond U+10FFFF, and what is cut. */
static void what_is_no_utf_8_is_told(void **state)
{
    static const char *const bad[] = {"\xc0\xaf", "\xed\xa0\x80", "\xf4\x90\x80\x80", "\xe6\x9c",
                                      "\x80"};
    (void)state;

    for (size_t i = 0; i < sizeof bad / sizeof *bad; i++) assert_false(utf8_text_is_valid(bad[i]));
    assert_true(utf8_text_is_valid("\xf4\x8f\xbf\xbf"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_text_in_utf_8_stays_as_it_is),
        cmocka_unit_test(a_text_in_latin_1_becomes_utf_8),
        cmocka_unit_test(what_is_no_utf_8_is_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
