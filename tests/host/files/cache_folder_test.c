#include "../scratch_folder.h"

#include <fcntl.h>
#include <sys/stat.h>

#include "base/status.h"
#include "files/cache_folder.h"

enum { FILE_BYTES = 1000 };

/* A file of FILE_BYTES that was used at a time. */
static void make_file(const char *name, time_t used)
{
    const struct timespec times[2] = {{.tv_sec = used}, {.tv_sec = used}};
    FILE *file = fopen(scratch_path(name), "wb");

    assert_non_null(file);
    for (int i = 0; i < FILE_BYTES; i++) fputc('x', file);
    assert_int_equal(fclose(file), 0);
    assert_int_equal(utimensat(AT_FDCWD, scratch_path(name), times, 0), 0);
}

static bool is_there(const char *name)
{
    return access(scratch_path(name), F_OK) == 0;
}

static int setup(void **state)
{
    if (scratch_setup(state) != 0) return -1;
    make_file("a", 3000);
    make_file("b", 1000);
    make_file("c", 2000);
    return setenv("RADSIG_CACHE_GB", "3.1e-6", 1); /* 3100 bytes */
}

static int teardown(void **state)
{
    unsetenv("RADSIG_CACHE_GB");
    status_warnings();
    return scratch_teardown(state);
}

static void what_fits_into_the_budget_removes_nothing(void **state)
{
    (void)state;
    assert_true(cache_folder_make_room(scratch_path(""), 100));

    assert_true(is_there("a") && is_there("b") && is_there("c"));
}

static void the_file_that_was_used_longest_ago_goes_first(void **state)
{
    (void)state;
    assert_true(cache_folder_make_room(scratch_path(""), 101));
    assert_true(is_there("a") && !is_there("b") && is_there("c"));

    assert_true(cache_folder_make_room(scratch_path(""), 1101));
    assert_true(is_there("a") && !is_there("c"));
}

static void what_is_larger_than_the_budget_has_no_room_and_removes_nothing(void **state)
{
    (void)state;
    assert_false(cache_folder_make_room(scratch_path(""), 3101));

    assert_true(is_there("a") && is_there("b") && is_there("c"));
}

static void links_and_folders_are_left_alone(void **state)
{
    (void)state;
    char folder[4096];
    snprintf(folder, sizeof folder, "%s", scratch_path("inner"));
    assert_int_equal(mkdir(folder, 0700), 0);
    make_file("inner/old", 1);
    assert_int_equal(symlink("inner/old", scratch_path("link")), 0);

    assert_true(cache_folder_make_room(scratch_path(""), 3100));

    assert_true(is_there("inner/old") && is_there("link") && !is_there("a"));
}

static void a_budget_that_is_not_a_number_is_told_and_is_4_gib(void **state)
{
    (void)state;
    const char *texts[] = {"", "much", "-1", "nan", "1 GB", "1e300"};

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        setenv("RADSIG_CACHE_GB", texts[i], 1);
        assert_int_equal(cache_folder_budget(), UINT64_C(4) << 30);
        assert_non_null(strstr(status_warnings(), "RADSIG_CACHE_GB: found '"));
    }
}

static void without_a_budget_it_is_4_gib(void **state)
{
    (void)state;
    unsetenv("RADSIG_CACHE_GB");

    assert_int_equal(cache_folder_budget(), UINT64_C(4) << 30);
    assert_string_equal(status_warnings(), "");
}

static void a_folder_is_made_with_those_above_it(void **state)
{
    (void)state;
    char path[4096];
    struct stat found;
    snprintf(path, sizeof path, "%s", scratch_path("x/y/z"));

    assert_true(cache_folder_make(path));

    assert_int_equal(stat(path, &found), 0);
    assert_int_equal(found.st_mode & 0777, 0700);
    assert_false(cache_folder_make(scratch_path("a/b"))); /* below a file */
}

#define IN_FOLDER(test) cmocka_unit_test_setup_teardown(test, setup, teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_FOLDER(what_fits_into_the_budget_removes_nothing),
        IN_FOLDER(the_file_that_was_used_longest_ago_goes_first),
        IN_FOLDER(what_is_larger_than_the_budget_has_no_room_and_removes_nothing),
        IN_FOLDER(links_and_folders_are_left_alone),
        IN_FOLDER(a_budget_that_is_not_a_number_is_told_and_is_4_gib),
        IN_FOLDER(without_a_budget_it_is_4_gib),
        IN_FOLDER(a_folder_is_made_with_those_above_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
