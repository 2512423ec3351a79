#include "../assert_near.h"
#include "../text_file.h"

#include "files/csv_row.h"

static void assert_fields(const char *line, char separator, const char *const *expected,
                          size_t count)
{
    record_file *file = NULL;
    csv_row row = {0};

    if (record_file_open(&file, text_file(line)) != STATUS_OK) fail_msg("%s", status_message());
    assert_int_equal(csv_row_take(&row, file, separator, "a row"), STATUS_OK);
    assert_int_equal(row.count, count);
    for (size_t i = 0; i < count; i++) assert_string_equal(row.field[i], expected[i]);
    assert_string_equal(csv_row_field(&row, count), "");
    csv_row_free(&row);
    record_file_free(file);
}

static void blanks_quotes_and_empty_fields_at_the_end_go(void **state)
{
    static const char *const plain[] = {"1", "", "two words", "3"};
    static const char *const quoted[] = {"a, b", "say \"x\"", "", "c"};

    (void)state;
    assert_fields(" 1 ,,\ttwo words , 3,, ,\r\n", ',', plain, 4);
    assert_fields("\"a, b\" , \"say \"\"x\"\"\",\"\",\"c\"\n", ',', quoted, 4);
    assert_fields("1;;two words;3;;\n", ';', plain, 4);
    assert_fields("1\t\ttwo words\t3\t\n", '\t', plain, 4);
}

static void a_decimal_comma_is_one_where_semicolons_separate(void **state)
{
    static const char *const numbers[] = {"20.5", "-3.25", "1,2,3", "a,b", ",5", "6,"};
    static const char *const fields[] = {"20", "5;-3", "25"};

    (void)state;
    assert_fields("20,5;-3,25;1,2,3;a,b;,5;6,\n", ';', numbers, 6);
    assert_fields("20,5\t-3,25\t1,2,3\ta,b\t,5\t6,\n", '\t', numbers, 6);
    assert_fields("20,5;-3,25\n", ',', fields, 3);
}

static void a_row_fits_its_names_unless_it_is_cut_or_has_more(void **state)
{
    static const struct {
        const char *line;
        status expected;
    } rows[] = {{"1,2,3", STATUS_OK},   {"1,,", STATUS_OK},      {"1,2,3,,", STATUS_OK},
                {"1,2", STATUS_FORMAT}, {"1,", STATUS_FORMAT},   {"1,2,3,4", STATUS_FORMAT},
                {",,3", STATUS_OK},     {"1,,,4", STATUS_FORMAT}};
    record_file *file = NULL;
    csv_row row = {0};

    (void)state;
    for (size_t i = 0; i < sizeof rows / sizeof *rows; i++) {
        assert_int_equal(record_file_open(&file, text_file(rows[i].line)), STATUS_OK);
        assert_int_equal(csv_row_take(&row, file, ',', "a row"), STATUS_OK);
        assert_int_equal(csv_row_check(&row, 3, file), rows[i].expected);
        record_file_free(file);
    }
    assert_non_null(strstr(status_message(), ":1: found '1,,,4', expected 3 fields, one for each "
                                             "name, not 4"));
    csv_row_free(&row);
}

static void the_names_stand_below_comments_and_a_spreadsheet_s_separator(void **state)
{
    static const char *const texts[] = {"a;b\n1;2\n", "# x\n#\na;b\n", "sep=;\na;b\n",
                                        "# x\nSEP=;\n\na;b\n"};
    record_file *file = NULL;
    csv_row row = {0};
    char separator;

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        assert_int_equal(record_file_open(&file, text_file(texts[i])), STATUS_OK);
        assert_int_equal(csv_row_names(&row, file, &separator, "names"), STATUS_OK);
        assert_int_equal(separator, ';');
        assert_int_equal(row.count, 2);
        assert_string_equal(row.field[1], "b");
        record_file_free(file);
    }
    csv_row_free(&row);
}

static void a_quote_that_nothing_closes_stands_for_itself(void **state)
{
    static const char *const inch[] = {"\"5 inch", "x"};
    static const char *const behind[] = {"\"a\" b", "5\"", "x"};

    (void)state;
    assert_fields("\"5 inch,x\n", ',', inch, 2);
    assert_fields("\"a\" b,5\",x\n", ',', behind, 3);
}

static void a_long_line_is_taken_whole(void **state)
{
    enum { FIELDS = 20000 };
    char *line = malloc(4 * FIELDS + 1), *to = line;
    record_file *file = NULL;
    csv_row row = {0};

    (void)state;
    for (int i = 0; i < FIELDS; i++) to += sprintf(to, "%d,", i % 100);
    assert_int_equal(record_file_open(&file, text_file(line)), STATUS_OK);
    assert_int_equal(csv_row_take(&row, file, ',', "a row"), STATUS_OK);
    assert_int_equal(row.count, FIELDS);
    assert_string_equal(row.field[FIELDS - 1], "99");
    csv_row_free(&row);
    record_file_free(file);
    free(line);
}

static void the_separator_is_what_stands_there_most(void **state)
{
    (void)state;
    assert_int_equal(csv_separator("a,b,c"), ',');
    assert_int_equal(csv_separator("a;b;c,d"), ';');
    assert_int_equal(csv_separator("a\tb\tc;d"), '\t');
    assert_int_equal(csv_separator("\"a;b;c\",d"), ',');
    assert_int_equal(csv_separator("alone"), ',');
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(blanks_quotes_and_empty_fields_at_the_end_go),
        cmocka_unit_test(a_decimal_comma_is_one_where_semicolons_separate),
        cmocka_unit_test(a_row_fits_its_names_unless_it_is_cut_or_has_more),
        cmocka_unit_test(the_names_stand_below_comments_and_a_spreadsheet_s_separator),
        cmocka_unit_test(a_quote_that_nothing_closes_stands_for_itself),
        cmocka_unit_test(a_long_line_is_taken_whole),
        cmocka_unit_test(the_separator_is_what_stands_there_most),
    };

    return cmocka_run_group_tests(tests, text_file_setup, text_file_teardown);
}
