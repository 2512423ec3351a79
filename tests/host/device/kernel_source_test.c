#include "device/kernel_source.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static bool is_kernel(const kernel_file *file)
{
    return strlen(file->name) > 3 && !strcmp(file->name + strlen(file->name) - 3, ".cl");
}

static char *read_source(const kernel_file *file)
{
    const char *base = strrchr(file->name, '/') + 1;
    char name[96], *text = NULL;

    snprintf(name, sizeof name, "%.*s", (int)strlen(base) - 3, base);
    if (kernel_source_read(&text, name) != STATUS_OK) fail_msg("%s", status_message());
    return text;
}

/* Start of a line of a kernel file, from 1; NULL where there is none. */
static const char *find_line(const char *name, int line)
{
    for (const kernel_file *f = kernel_files; f->name; f++) {
        const char *text = f->text;
        if (strcmp(f->name, name)) continue;
        for (; line > 1 && text; line--) {
            text = strchr(text, '\n');
            if (text) text++;
        }
        return text;
    }
    return NULL;
}

static int count(const char *text, const char *what)
{
    int times = 0;

    for (; (text = strstr(text, what)); text++) times++;
    return times;
}

static void every_line_is_marked_with_its_file_and_number(void **state)
{
    (void)state;
    for (const kernel_file *f = kernel_files; f->name; f++) {
        if (!is_kernel(f)) continue;
        char *source = read_source(f), name[96] = "";
        int number = 0;
        for (char *line = strtok(source, "\n"); line; line = strtok(NULL, "\n")) {
            if (sscanf(line, "#line %d \"%95[^\"]\"", &number, name) == 2) continue;
            const char *real = find_line(name, number);
            while (real && *real == '\n') real = find_line(name, ++number); /* strtok skips them */
            if (!real || strncmp(real, line, strlen(line)))
                fail_msg("%s, %s:%d: '%s'", f->name, name, number, line);
            number++;
        }
        free(source);
    }
}

static void every_header_stands_once_and_no_include_is_left(void **state)
{
    (void)state;
    for (const kernel_file *f = kernel_files; f->name; f++) {
        if (!is_kernel(f)) continue;
        char *source = read_source(f);
        for (const kernel_file *h = kernel_files; h->name; h++) {
            char mark[128];
            snprintf(mark, sizeof mark, "#line 1 \"%s\"\n", h->name);
            assert_in_range(count(source, mark), h == f ? 1 : 0, 1);
        }
        assert_int_equal(count(source, "#include \""), 0);
        free(source);
    }
}

static void a_kernel_that_is_not_there_is_named(void **state)
{
    char *text = NULL;

    (void)state;
    assert_int_equal(kernel_source_read(&text, "no_such"), STATUS_DEVICE);
    assert_string_equal(status_message(), "kernel no_such: no_such.cl is not part of this program");
    assert_null(text);
}

static void a_header_is_no_kernel(void **state)
{
    char *text = NULL;

    (void)state;
    assert_int_equal(kernel_source_read(&text, "records"), STATUS_DEVICE);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_line_is_marked_with_its_file_and_number),
        cmocka_unit_test(every_header_stands_once_and_no_include_is_left),
        cmocka_unit_test(a_kernel_that_is_not_there_is_named),
        cmocka_unit_test(a_header_is_no_kernel),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
