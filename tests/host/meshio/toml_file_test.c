/* Scene files as TOML: values, lines, and what --set changes. */
#include "meshio/toml_file.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

static const char scene[] = "name = \"airport\"\n"
                            "[site]\n"
                            "latitude_deg = 39.773333\n"
                            "time = 1987-06-24T10:00:00-05:00\n"
                            "local = 1987-06-24T10:00:00\n"
                            "date = 1987-06-24\n"
                            "[camera]\n"
                            "position_m = [7162.4, -6951.7,\n"
                            "              10000]\n"
                            "tags = [\"a\", \"b\"]\n"
                            "mixed = [1, \"b\"]\n"
                            "two_sided = true\n"
                            "[[band]]\n"
                            "name = \"lwir\"\n"
                            "[[band]]\n"
                            "name = \"mwir\"\n"
                            "gain = nan\n"
                            "[atmosphere]\n"
                            "uniform = { transmission = 1 }\n";

static char path[] = P_tmpdir "/radsig-toml-XXXXXX", message[512];

static void write_file(const char *text)
{
    FILE *file = fopen(path, "w");

    assert_non_null(file);
    assert_true(fputs(text, file) >= 0);
    assert_int_equal(fclose(file), 0);
}

static toml_file *read_set(const char *text, const char *const *setting, size_t count)
{
    toml_file *file = NULL;

    write_file(text);
    if (toml_file_read(&file, path, setting, count, message, sizeof message))
        fail_msg("%s", message);
    return file;
}

static void assert_refused(const char *text, const char *setting, const char *expected)
{
    toml_file *file = NULL;

    write_file(text);
    assert_int_not_equal(
        toml_file_read(&file, path, &setting, setting != NULL, message, sizeof message), 0);
    assert_null(file);
    if (!strstr(message, expected)) fail_msg("\"%s\" lacks \"%s\"", message, expected);
}

/* Asserts a message of `path:` and then `expected`. */
static void assert_message(const char *expected)
{
    char whole[512];

    snprintf(whole, sizeof whole, "%s:%s", path, expected);
    assert_string_equal(message, whole);
}

static const toml_node *get(const toml_file *file, const char *table, const char *key)
{
    const toml_node *node = toml_node_get(toml_node_get(toml_file_root(file), table), key);

    assert_non_null(node);
    return node;
}

static void every_kind_of_value_is_read(void **state)
{
    toml_file *file = read_set(scene, NULL, 0);
    const char *text, *const *texts;
    const double *numbers;
    double number;
    size_t count;
    int flag;
    (void)state;

    assert_int_equal(toml_node_string(&text, toml_node_get(toml_file_root(file), "name"), message,
                                      sizeof message),
                     0);
    assert_string_equal(text, "airport");
    assert_int_equal(
        toml_node_number(&number, get(file, "site", "latitude_deg"), message, sizeof message), 0);
    assert_true(number == 39.773333);
    assert_int_equal(toml_node_time(&text, get(file, "site", "time"), message, sizeof message), 0);
    assert_string_equal(text, "1987-06-24T10:00:00-05:00");
    assert_int_equal(
        toml_node_bool(&flag, get(file, "camera", "two_sided"), message, sizeof message), 0);
    assert_int_equal(flag, 1);
    assert_int_equal(toml_node_numbers(&numbers, &count, get(file, "camera", "position_m"), message,
                                       sizeof message),
                     0);
    assert_int_equal(count, 3);
    assert_true(numbers[0] == 7162.4 && numbers[2] == 10000);
    assert_int_equal(
        toml_node_strings(&texts, &count, get(file, "camera", "tags"), message, sizeof message), 0);
    assert_int_equal(count, 2);
    assert_string_equal(texts[1], "b");
    toml_file_free(file);
}

static void an_integer_is_a_number(void **state)
{
    toml_file *file = read_set(scene, NULL, 0);
    double number;
    (void)state;

    assert_int_equal(
        toml_node_number(&number, toml_node_get(get(file, "atmosphere", "uniform"), "transmission"),
                         message, sizeof message),
        0);
    assert_true(number == 1);
    toml_file_free(file);
}

static void a_table_lists_its_keys_in_the_order_of_the_file_with_their_lines(void **state)
{
    static const char *const key[] = {"name", "site", "camera", "band", "atmosphere"};
    static const int line[] = {1, 2, 7, 13, 18};
    toml_file *file = read_set(scene, NULL, 0);
    const toml_node *root = toml_file_root(file);
    (void)state;

    assert_int_equal(toml_node_count(root), 5);
    for (size_t i = 0; i < 5; i++) {
        assert_string_equal(toml_node_key(toml_node_at(root, i)), key[i]);
        assert_int_equal(toml_node_line(toml_node_at(root, i)), line[i]);
    }
    assert_null(toml_node_at(root, 5));
    toml_file_free(file);
}

static void the_elements_of_an_array_of_tables_have_names_and_lines(void **state)
{
    toml_file *file = read_set(scene, NULL, 0);
    const toml_node *bands = toml_node_get(toml_file_root(file), "band");
    const toml_node *name = toml_node_get(toml_node_at(bands, 1), "name");
    (void)state;

    assert_int_equal(toml_node_kind(bands), TOML_ARRAY);
    assert_int_equal(toml_node_count(bands), 2);
    assert_int_equal(toml_node_line(toml_node_at(bands, 1)), 15);
    assert_int_equal(toml_node_line(name), 16);
    assert_string_equal(toml_node_name(name), "band.1.name");
    toml_file_free(file);
}

static void a_missing_key_is_null_and_so_is_a_key_of_a_value(void **state)
{
    toml_file *file = read_set(scene, NULL, 0);
    const toml_node *root = toml_file_root(file);
    (void)state;

    assert_null(toml_node_get(root, "weather"));
    assert_null(toml_node_get(toml_node_get(root, "weather"), "x"));
    assert_null(toml_node_get(toml_node_get(root, "name"), "x"));
    toml_file_free(file);
}

static void a_value_of_another_kind_is_refused_with_its_line(void **state)
{
    toml_file *file = read_set(scene, NULL, 0);
    const double *numbers;
    const char *text;
    double number;
    size_t count;
    (void)state;

    assert_int_not_equal(
        toml_node_string(&text, get(file, "site", "latitude_deg"), message, sizeof message), 0);
    assert_message("3: site.latitude_deg: 39.773333, expected a string");
    assert_int_not_equal(
        toml_node_string(&text, get(file, "camera", "mixed"), message, sizeof message), 0);
    assert_message("11: camera.mixed: [1, \"b\"], expected a string");
    assert_int_not_equal(
        toml_node_numbers(&numbers, &count, get(file, "camera", "mixed"), message, sizeof message),
        0);
    assert_message("11: camera.mixed.1: \"b\", expected a finite number");
    assert_int_not_equal(
        toml_node_number(
            &number,
            toml_node_get(toml_node_at(toml_node_get(toml_file_root(file), "band"), 1), "gain"),
            message, sizeof message),
        0);
    assert_message("17: band.1.gain: nan, expected a finite number");
    toml_file_free(file);
}

static void a_time_without_offset_is_refused(void **state)
{
    toml_file *file = read_set(scene, NULL, 0);
    const char *text;
    (void)state;

    assert_int_not_equal(toml_node_time(&text, get(file, "site", "local"), message, sizeof message),
                         0);
    assert_message(
        "5: site.local: 1987-06-24T10:00:00, expected a date and time with offset, such as "
        "1987-06-24T10:00:00-05:00");
    assert_int_not_equal(toml_node_time(&text, get(file, "site", "date"), message, sizeof message),
                         0);
    toml_file_free(file);
}

static void a_document_that_is_not_toml_names_its_line(void **state)
{
    (void)state;
    assert_refused("a = 1\nb = \n", NULL, ":2: ");
    assert_refused("a = 1\n\na = 2\n", NULL, ":3: ");
    assert_refused("[site\n", NULL, ":1: ");
}

/* `count` times `part`, between `before` and `after`. */
static const char *repeated(const char *before, const char *part, int count, const char *after)
{
    static char text[1 << 18];
    char *end = text + sprintf(text, "%s", before);

    for (int i = 0; i < count; i++) end += sprintf(end, "%s", part);
    sprintf(end, "%s", after);
    return text;
}

static void keys_of_many_parts_are_refused_with_their_line(void **state)
{
    const char *const hidden = "x = { s = \"\"\"a\"\"\"\", a"; /* a string that ends in a quote */
    (void)state;

    assert_refused(repeated("y = 1\n[a", ".a", 30000, "]\n"), NULL, ":2: a key of more than 16");
    assert_refused(repeated("a", " . \"a\"", 30000, " = 1\n"), NULL, ":1: a key of more than 16");
    assert_refused(repeated("s = \"\"\"\n\\\"\"\"\"\n[[a", ".a", 30000, "]]\n"), NULL,
                   ":3: a key of more than 16");
    assert_refused(repeated(hidden, ".a", 30000, " = 1 }\n"), NULL, ":1: a key of more than 16");
    assert_refused(repeated("x = { a", ".a", 30000, ""), NULL, ":1: a key of more than 16");
    assert_refused(scene, repeated("a", ".a", 30000, "=1"), "--set:1: a key of more than 16");
    assert_refused(scene, repeated("x={ a", ".a", 30000, " = 1 }"), "--set:1: a key of more");
}

static void values_that_lie_too_deep_are_refused(void **state)
{
    char text[1024];
    (void)state;

    strcpy(text, repeated("y = 1\nx = ", "[", 64, "1"));
    assert_refused(repeated(text, "]", 64, "\n"), NULL, ":2: tables and arrays more than 64 deep");
    strcpy(text, repeated("x = ", "{ a.a.a = ", 30, "1"));
    assert_refused(repeated(text, " }", 30, "\n"), NULL, ":1: tables and arrays more than 64 deep");
    strcpy(text, repeated("x = ", "[", 60, "1"));
    toml_file_free(read_set(repeated(text, "]", 60, "\n"), NULL, 0));
}

static void dots_in_values_and_comments_are_no_parts_of_keys(void **state)
{
    (void)state;
    toml_file_free(read_set(
        "# a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a\n"
        "s = '../../../../../../../../../../..'\n"
        "t = \"a.a.a.a.a.a.a.a.a.a.\\\"a.a.a.a.a.a.a.a.a\"\n"
        "n = [1.0e1, 0.1, 0.2, 0.3, 0.4, 0.5, 0.6, 0.7, 0.8, 0.9, 1.0, 1.1, 1.2, 1.3, 1.4]\n"
        "a.a.a.a.a.a.a.a.a.a.a.a.a.a.a.a = 1\n",
        NULL, 0));
}

static void a_file_that_is_not_there_is_refused(void **state)
{
    toml_file *file = NULL;
    (void)state;

    assert_int_not_equal(toml_file_read(&file, "nonesuch.toml", NULL, 0, message, sizeof message),
                         0);
    assert_string_equal(message, "nonesuch.toml: No such file or directory");
}

static void a_setting_replaces_a_value_and_reports_no_line(void **state)
{
    static const char *const setting[] = {"site.latitude_deg=41", "camera.position_m=[1, 2, 3]"};
    toml_file *file = read_set(scene, setting, 2);
    const double *numbers;
    const char *text;
    size_t count;
    (void)state;

    assert_int_equal(toml_node_numbers(&numbers, &count, get(file, "camera", "position_m"), message,
                                       sizeof message),
                     0);
    assert_true(count == 3 && numbers[2] == 3);
    assert_int_equal(toml_node_line(get(file, "site", "latitude_deg")), 0);
    assert_int_not_equal(
        toml_node_string(&text, get(file, "site", "latitude_deg"), message, sizeof message), 0);
    assert_string_equal(message, "--set: site.latitude_deg: 41, expected a string");
    assert_int_equal(toml_node_line(get(file, "site", "time")), 4);
    toml_file_free(file);
}

static void a_setting_reaches_into_arrays_and_makes_tables(void **state)
{
    static const char *const setting[] = {"band.1.name=swir", "render.deep.mode=\"thesis\""};
    toml_file *file = read_set(scene, setting, 2);
    const toml_node *bands = toml_node_get(toml_file_root(file), "band");
    const char *text;
    (void)state;

    assert_int_equal(toml_node_string(&text, toml_node_get(toml_node_at(bands, 1), "name"), message,
                                      sizeof message),
                     0);
    assert_string_equal(text, "swir");
    assert_int_equal(toml_node_string(&text, toml_node_get(get(file, "render", "deep"), "mode"),
                                      message, sizeof message),
                     0);
    assert_string_equal(text, "thesis");
    toml_file_free(file);
}

static void a_word_that_is_not_toml_is_a_string(void **state)
{
    static const char *const setting[] = {"name=june 24 = hot", "site.time=1988-06-24T10:00:00Z"};
    toml_file *file = read_set(scene, setting, 2);
    const char *text;
    (void)state;

    assert_int_equal(toml_node_string(&text, toml_node_get(toml_file_root(file), "name"), message,
                                      sizeof message),
                     0);
    assert_string_equal(text, "june 24 = hot");
    assert_int_equal(toml_node_time(&text, get(file, "site", "time"), message, sizeof message), 0);
    assert_string_equal(text, "1988-06-24T10:00:00Z");
    toml_file_free(file);
}

static void a_bad_setting_is_named(void **state)
{
    (void)state;
    assert_refused(scene, "site", "--set site: expected table.key=value");
    assert_refused(scene, "site..x=1", "--set site..x=1: an empty name");
    assert_refused(scene, "band.2.name=x", "--set band.2.name=x: \"2\", expected an index below 2");
    assert_refused(scene, "band.name=x", "\"name\", expected an index below 2");
    assert_refused(scene, "name.x=1", "\"x\" is inside a value");
    assert_refused(scene, "camera.position_m=[1, 2", "--set camera.position_m=[1, 2: ");
}

static int make_file(void **state)
{
    const int file = mkstemp(path);
    (void)state;

    return file < 0 || close(file);
}

static int remove_file(void **state)
{
    (void)state;
    return remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_kind_of_value_is_read),
        cmocka_unit_test(an_integer_is_a_number),
        cmocka_unit_test(a_table_lists_its_keys_in_the_order_of_the_file_with_their_lines),
        cmocka_unit_test(the_elements_of_an_array_of_tables_have_names_and_lines),
        cmocka_unit_test(a_missing_key_is_null_and_so_is_a_key_of_a_value),
        cmocka_unit_test(a_value_of_another_kind_is_refused_with_its_line),
        cmocka_unit_test(a_time_without_offset_is_refused),
        cmocka_unit_test(a_document_that_is_not_toml_names_its_line),
        cmocka_unit_test(keys_of_many_parts_are_refused_with_their_line),
        cmocka_unit_test(values_that_lie_too_deep_are_refused),
        cmocka_unit_test(dots_in_values_and_comments_are_no_parts_of_keys),
        cmocka_unit_test(a_file_that_is_not_there_is_refused),
        cmocka_unit_test(a_setting_replaces_a_value_and_reports_no_line),
        cmocka_unit_test(a_setting_reaches_into_arrays_and_makes_tables),
        cmocka_unit_test(a_word_that_is_not_toml_is_a_string),
        cmocka_unit_test(a_bad_setting_is_named),
    };

    return cmocka_run_group_tests(tests, make_file, remove_file);
}
