#include "../assert_near.h"
#include "../text_file.h"

#include "files/record_file.h"

static record_file *open_file(const char *text)
{
    record_file *file = NULL;

    if (record_file_open(&file, text_file(text)) != STATUS_OK) fail_msg("%s", status_message());
    return file;
}

static void lines_come_without_their_blanks(void **state)
{
    (void)state;
    record_file *file = open_file("\n  grass green \t\r\n\r\n \n4");
    const char *text;

    assert_int_equal(record_file_text(file, &text, "a name"), STATUS_OK);
    assert_string_equal(text, "grass green");
    assert_int_equal(record_file_line(file), 2);
    assert_int_equal(record_file_column(file), 2);
    assert_string_equal(record_file_peek(file), "4");
    assert_int_equal(record_file_text(file, &text, "a code"), STATUS_OK);
    assert_string_equal(text, "4");
    assert_int_equal(record_file_line(file), 5);
    assert_true(record_file_at_end(file));
    assert_int_equal(record_file_finish(file), STATUS_OK);
    record_file_free(file);
}

static void carriage_returns_do_not_count_as_lines(void **state)
{
    (void)state;
    record_file *file = open_file("1\r\n2\r\nx\r\n");
    double value[1];

    assert_int_equal(record_file_numbers(file, 1, value, "a number"), STATUS_OK);
    assert_int_equal(record_file_numbers(file, 1, value, "a number"), STATUS_OK);
    assert_refused(record_file_numbers(file, 1, value, "a number"), 3,
                   "found 'x', expected a number");
    record_file_free(file);
}

static void a_file_that_ends_too_early_names_the_line_behind_it(void **state)
{
    (void)state;
    record_file *file = open_file("one\ntwo\n");
    const char *text;

    record_file_text(file, &text, "a name");
    record_file_text(file, &text, "a name");
    assert_refused(record_file_text(file, &text, "the gain"), 3,
                   "the file ends, expected the gain");
    record_file_free(file);
}

static void what_stands_behind_the_end_is_refused(void **state)
{
    (void)state;
    record_file *file = open_file("1\n\n  surplus\n");
    double value[1];

    record_file_numbers(file, 1, value, "a number");
    assert_false(record_file_at_end(file));
    assert_refused(record_file_finish(file), 3, "found 'surplus', expected the end");
    record_file_free(file);
}

static void a_header_is_taken_whole(void **state)
{
    (void)state;
    record_file *file = open_file("# one\r\n\n#two\n3\n# four\n");
    char *header;
    const char *text;

    assert_int_equal(record_file_header(file, &header), STATUS_OK);
    assert_string_equal(header, "# one\n#two\n");
    free(header);
    record_file_text(file, &text, "a number");
    assert_string_equal(text, "3");
    record_file_free(file);
}

static void a_file_without_a_header_has_an_empty_one(void **state)
{
    (void)state;
    record_file *file = open_file("1");
    char *header;

    assert_int_equal(record_file_header(file, &header), STATUS_OK);
    assert_string_equal(header, "");
    free(header);
    record_file_free(file);
}

static void numbers_that_run_together_are_told_apart(void **state)
{
    (void)state;
    double n[4];

    assert_int_equal(record_numbers("0.00-15.00+3-1e-3", 4, n), 4);
    assert_near(n[0], 0.0, 0.0);
    assert_near(n[1], -15.0, 0.0);
    assert_near(n[2], 3.0, 0.0);
    assert_near(n[3], -.001, 0.0);
}

static void commas_and_blanks_separate(void **state)
{
    (void)state;
    double n[3];

    assert_int_equal(record_numbers(" 1, 2,\t.5 ", 3, n), 3);
    assert_near(n[2], .5, 0.0);
    assert_int_equal(record_numbers("", 3, n), 0);
}

static void more_numbers_than_asked_for_are_counted_and_not_stored(void **state)
{
    (void)state;
    double n[2] = {0, -7};

    assert_int_equal(record_numbers("1 2 3", 1, n), 3);
    assert_near(n[0], 1.0, 0.0);
    assert_near(n[1], -7.0, 0.0);
}

static void what_is_no_number_is_refused(void **state)
{
    static const char *const texts[] = {"nan", "inf", "-inf",  "0x10", "-0x1", "1e",    "12a",
                                        "-",   ".",   "1e999", "1;2",  "+-1",  "1 two", "\"1\""};
    double n[4];

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (record_numbers(texts[i], 4, n) != -1) fail_msg("'%s' is taken", texts[i]);
}

static void too_few_and_too_many_numbers_are_refused(void **state)
{
    (void)state;
    record_file *file = open_file("1 2\n1 2 3 4\n");
    double n[3];

    assert_refused(record_file_numbers(file, 3, n, "three numbers"), 1, "expected three numbers");
    assert_refused(record_file_numbers(file, 3, n, "three numbers"), 2, "'1 2 3 4'");
    record_file_free(file);
}

static void a_number_out_of_its_range_is_refused_with_the_range(void **state)
{
    (void)state;
    record_file *file = open_file("1.5\n1\n-0.25\n");
    double n;

    assert_refused(record_file_number(file, 0, 1, &n, "an emissivity"), 1,
                   "an emissivity from 0 to 1");
    assert_int_equal(record_file_number(file, 0, 1, &n, "an emissivity"), STATUS_OK);
    assert_near(n, 1.0, 0.0);
    assert_refused(record_file_number(file, 0, 1, &n, "an emissivity"), 3, "'-0.25'");
    record_file_free(file);
}

static void a_count_is_a_whole_number(void **state)
{
    (void)state;
    record_file *file = open_file("3\n3.5\n1e99\n");
    long n;

    assert_int_equal(record_file_count(file, 1, 10, &n, "points"), STATUS_OK);
    assert_int_equal(n, 3);
    assert_refused(record_file_count(file, 1, 10, &n, "points"), 2, "points, a whole number");
    assert_refused(record_file_count(file, 1, 10, &n, "points"), 3, "points from 1 to 10");
    record_file_free(file);
}

static void a_long_line_is_cut_in_the_message(void **state)
{
    char text[5001];

    (void)state;
    memset(text, 'y', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    record_file *file = open_file(text);
    double n;
    assert_refused(record_file_number(file, 0, 1, &n, "a number"), 1, "expected a number");
    assert_true(strlen(status_message()) < 400);
    record_file_free(file);
}

static void a_file_larger_than_the_first_buffer_is_read_whole(void **state)
{
    enum { LINES = 60000 };
    char *text = malloc(LINES * 8 + 1), *to = text;
    double sum = 0, n;

    (void)state;
    for (int i = 0; i < LINES; i++) to += sprintf(to, "%d\n", i);
    record_file *file = open_file(text);
    for (int i = 0; i < LINES; i++, sum += n)
        if (record_file_numbers(file, 1, &n, "a number") != STATUS_OK)
            fail_msg("%s", status_message());
    assert_near(sum, .5 * LINES * (LINES - 1.0), 0.0);
    assert_true(record_file_at_end(file));
    record_file_free(file);
    free(text);
}

static void what_is_no_text_file_is_refused(void **state)
{
    record_file *file = NULL;
    char absent[160];

    (void)state;
    snprintf(absent, sizeof absent, "%s/absent", text_file_folder);
    assert_int_equal(record_file_open(&file, absent), STATUS_FILE);
    assert_non_null(strstr(status_message(), "absent: No such file"));
    assert_int_equal(record_file_open(&file, text_file_folder), STATUS_FILE);
    FILE *stream = fopen(text_file(""), "wb");
    fwrite("1\0002", 1, 3, stream);
    fclose(stream);
    assert_int_equal(record_file_open(&file, text_file_at), STATUS_FILE);
    assert_non_null(strstr(status_message(), "is binary, expected text"));
    assert_null(file);
}

static void an_empty_file_is_at_its_end(void **state)
{
    (void)state;
    record_file *file = open_file("");
    const char *text;

    assert_true(record_file_at_end(file));
    assert_null(record_file_peek(file));
    assert_refused(record_file_text(file, &text, "a name"), 1, "the file ends, expected a name");
    record_file_free(file);
}

static void a_byte_order_mark_is_passed_over(void **state)
{
    (void)state;
    record_file *file = open_file("\xef\xbb\xbf"
                                  "7 8\n");
    double value[2];

    assert_int_equal(record_file_numbers(file, 2, value, "two numbers"), STATUS_OK);
    assert_near(value[0], 7.0, 0.0);
    record_file_free(file);
}

static void assert_line(record_file *file, const char *expected)
{
    const char *text;

    assert_int_equal(record_file_text(file, &text, "a line"), STATUS_OK);
    assert_string_equal(text, expected);
}

static void latin_1_is_read_as_utf_8(void **state)
{
    (void)state;
    record_file *file = open_file("M\xf6rtel \x80\nM\xc3\xb6rtel\n");

    assert_line(file, "M\xc3\xb6rtel \xe2\x82\xac"); /* Windows-1252 has the euro sign there */
    assert_line(file, "M\xc3\xb6rtel");
    record_file_free(file);
}

static void utf_16_is_read_as_utf_8(void **state)
{
    static const char little[] = "\xff\xfe"
                                 "1\0,\0\xb0\0\n\0"
                                 "2\0";
    static const char big[] = "\xfe\xff"
                              "\0"
                              "1\0,\0\xb0\0\n\0"
                              "2";

    (void)state;
    for (int i = 0; i < 2; i++) {
        record_file *file = NULL;
        FILE *stream = fopen(text_file(""), "wb");
        fwrite(i ? big : little, 1, 12, stream);
        fclose(stream);
        assert_int_equal(record_file_open(&file, text_file_at), STATUS_OK);
        assert_line(file, "1,\xc2\xb0");
        assert_line(file, "2");
        record_file_free(file);
    }
}

static void a_carriage_return_alone_ends_a_line(void **state)
{
    (void)state;
    record_file *file = open_file("one\rtwo\r\nthree\rfour\r");

    assert_line(file, "one");
    assert_line(file, "two");
    assert_line(file, "three");
    assert_line(file, "four");
    assert_int_equal(record_file_line(file), 4);
    assert_true(record_file_is_whole(file));
    record_file_free(file);
}

static void a_file_without_a_last_line_end_may_be_cut(void **state)
{
    (void)state;
    record_file *file = open_file("1\n29");

    assert_false(record_file_is_whole(file));
    record_file_free(file);
    file = open_file("1\n290\n");
    assert_true(record_file_is_whole(file));
    record_file_free(file);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(lines_come_without_their_blanks),
        cmocka_unit_test(carriage_returns_do_not_count_as_lines),
        cmocka_unit_test(a_file_that_ends_too_early_names_the_line_behind_it),
        cmocka_unit_test(what_stands_behind_the_end_is_refused),
        cmocka_unit_test(a_header_is_taken_whole),
        cmocka_unit_test(a_file_without_a_header_has_an_empty_one),
        cmocka_unit_test(numbers_that_run_together_are_told_apart),
        cmocka_unit_test(commas_and_blanks_separate),
        cmocka_unit_test(more_numbers_than_asked_for_are_counted_and_not_stored),
        cmocka_unit_test(what_is_no_number_is_refused),
        cmocka_unit_test(too_few_and_too_many_numbers_are_refused),
        cmocka_unit_test(a_number_out_of_its_range_is_refused_with_the_range),
        cmocka_unit_test(a_count_is_a_whole_number),
        cmocka_unit_test(a_long_line_is_cut_in_the_message),
        cmocka_unit_test(a_file_larger_than_the_first_buffer_is_read_whole),
        cmocka_unit_test(what_is_no_text_file_is_refused),
        cmocka_unit_test(an_empty_file_is_at_its_end),
        cmocka_unit_test(a_byte_order_mark_is_passed_over),
        cmocka_unit_test(latin_1_is_read_as_utf_8),
        cmocka_unit_test(utf_16_is_read_as_utf_8),
        cmocka_unit_test(a_carriage_return_alone_ends_a_line),
        cmocka_unit_test(a_file_without_a_last_line_end_may_be_cut),
    };

    return cmocka_run_group_tests(tests, text_file_setup, text_file_teardown);
}
