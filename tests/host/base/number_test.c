#include "base/number.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>

static void a_number_is_the_whole_text(void **state)
{
    (void)state;
    double value = 0.0;

    assert_true(number_read("-2.5e3", &value));
    assert_true(value == -2500.0);
    assert_true(number_read("+.5", &value));
    assert_true(value == 0.5);
    assert_true(number_read("5.", &value));
}

static void what_is_no_decimal_number_is_refused(void **state)
{
    static const char *const texts[] = {"",     " 1",  "1 ",    "1,",  "1e",      "nan",   "inf",
                                        "-inf", ".",   "-",     "0x1", "0X1p3",   "1.5.2", "--1",
                                        "+-1",  "1_0", "1e999", "1d3", "infinity"};
    (void)state;
    double value = 7.0;

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_false(number_read(texts[i], &value));
    assert_true(value == 7.0);
}

static void whole_numbers_end_at_their_range_and_do_not_wrap(void **state)
{
    static const char *const texts[] = {"4294967328",
                                        "18446744073709551648",
                                        "-1",
                                        "64",
                                        "1.0",
                                        "1e1",
                                        "0x10",
                                        "1x",
                                        "",
                                        " 1",
                                        "99999999999999999999999999999999"};
    (void)state;
    int64_t value = 7;

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_false(number_read_whole(texts[i], 0, 63, &value));
    assert_true(value == 7);
    assert_true(number_read_whole("63", 0, 63, &value));
    assert_true(value == 63);
    assert_true(number_read_whole("-0064", -64, 63, &value));
    assert_true(value == -64);
}

static void a_list_has_exactly_its_count(void **state)
{
    static const char *const texts[] = {"1",     "1,2",   "1,2,3,4", "1,2,3,",  "1,,3", ",1,2,3",
                                        "1;2;3", "1 2 3", "1,2,nan", "1,2,0x3", "",     "1,2,3x"};
    (void)state;
    double value[3];

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_false(number_read_list(texts[i], 3, value));
    assert_true(number_read_list("1, -2 ,3e0", 3, value));
    assert_true(value[0] == 1.0 && value[1] == -2.0 && value[2] == 3.0);
}

static void a_size_has_at_most_2_31_less_1_pixels(void **state)
{
    static const char *const texts[] = {
        "4294967328x24", "65536x65536", "32768x65536", "2147483648x1",
        "3*2",           "3x2x1",       "x3",          "3x",
        "-3x2",          "3x-2",        "+3x2",        "3x+2",
        "3 x 2",         "3x2 ",        "0x10x2",      "3.0x2"};
    (void)state;
    uint32_t columns = 7, rows = 7;

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        assert_false(number_read_size(texts[i], &columns, &rows));
    assert_true(columns == 7 && rows == 7);
    assert_true(number_read_size("2147483647x1", &columns, &rows));
    assert_true(columns == INT32_MAX && rows == 1);
    assert_true(number_read_size("640x480", &columns, &rows));
    assert_true(columns == 640 && rows == 480);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_number_is_the_whole_text),
        cmocka_unit_test(what_is_no_decimal_number_is_refused),
        cmocka_unit_test(whole_numbers_end_at_their_range_and_do_not_wrap),
        cmocka_unit_test(a_list_has_exactly_its_count),
        cmocka_unit_test(a_size_has_at_most_2_31_less_1_pixels),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
