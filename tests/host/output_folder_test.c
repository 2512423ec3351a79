/* The files of a render appear together or not at all. */
#include "output_folder.h"

#include "scratch_folder.h"

#include <sys/stat.h>

static output_folder *opened(const char *name)
{
    output_folder *folder = NULL;

    if (output_folder_open(&folder, scratch_path(name)) != STATUS_OK)
        fail_msg("%s", status_message());
    return folder;
}

static void write_file(output_folder *folder, const char *name, const char *text)
{
    const output_file *place = NULL;
    FILE *file;

    assert_int_equal(output_folder_add(folder, name, &place), STATUS_OK);
    file = fopen(output_file_temporary_path(place), "w");
    assert_non_null(file);
    fputs(text, file);
    fclose(file);
}

static void files_have_their_names_after_the_commit_and_not_before(void **state)
{
    output_folder *folder = opened("out/airport");
    (void)state;

    write_file(folder, "a.img", "1");
    write_file(folder, "a.hdr", "2");
    assert_int_not_equal(access(scratch_path("out/airport/a.img"), F_OK), 0);
    assert_int_equal(output_folder_commit(folder), STATUS_OK);
    output_folder_free(folder);

    scratch_assert_text("out/airport/a.img", "1");
    scratch_assert_text("out/airport/a.hdr", "2");
    assert_int_equal(scratch_count("out/airport"), 2);
}

static void a_folder_made_in_vain_is_gone_with_its_parents(void **state)
{
    output_folder *folder = opened("out//airport/");
    (void)state;

    write_file(folder, "a.img", "1");
    output_folder_free(folder);

    assert_int_equal(scratch_count(""), 0);
}

static void a_failed_run_leaves_the_old_file_and_the_folder_that_was_there(void **state)
{
    output_folder *folder = opened("out");
    (void)state;

    write_file(folder, "a.img", "old");
    assert_int_equal(output_folder_commit(folder), STATUS_OK);
    output_folder_free(folder);
    folder = opened("out/new/../");
    write_file(folder, "a.img", "new");
    output_folder_free(folder);

    scratch_assert_text("out/a.img", "old");
    assert_int_equal(scratch_count("out"), 1);
}

static void a_folder_below_a_file_is_refused_with_the_file_s_path(void **state)
{
    output_folder *folder = NULL;
    FILE *file = fopen(scratch_path("file"), "w");
    (void)state;

    assert_non_null(file);
    fclose(file);

    assert_int_equal(output_folder_open(&folder, scratch_path("file/out")), STATUS_FILE);
    assert_non_null(strstr(status_message(), scratch_path("file")));
    assert_null(folder);
    assert_int_equal(output_folder_open(&folder, scratch_path("file")), STATUS_FILE);
    assert_non_null(strstr(status_message(), scratch_path("file")));
}

static void a_folder_that_cannot_be_made_is_refused_with_its_path(void **state)
{
    output_folder *folder = NULL;
    (void)state;

    assert_int_equal(output_folder_open(&folder, "/proc/radsig/out"), STATUS_FILE);
    assert_non_null(strstr(status_message(), "/proc/radsig"));
}

static void a_folder_without_permission_is_refused_with_its_path(void **state)
{
    output_folder *folder = NULL;
    (void)state;

    if (geteuid() == 0) skip(); /* root may write anywhere */
    assert_int_equal(mkdir(scratch_path("locked"), 0500), 0);

    assert_int_equal(output_folder_open(&folder, scratch_path("locked")), STATUS_FILE);
    assert_non_null(strstr(status_message(), scratch_path("locked")));
}

static void a_folder_in_the_place_of_a_file_stops_all_renames(void **state)
{
    output_folder *folder = opened("out");
    (void)state;

    write_file(folder, "a.img", "1");
    write_file(folder, "a.json", "2");
    mkdir(scratch_path("out/a.json"), 0777);

    assert_int_equal(output_folder_commit(folder), STATUS_FILE);
    assert_non_null(strstr(status_message(), "a.json: is a folder"));
    output_folder_free(folder);
    assert_int_not_equal(access(scratch_path("out/a.img"), F_OK), 0);
    rmdir(scratch_path("out/a.json"));
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(files_have_their_names_after_the_commit_and_not_before),
        TEST(a_folder_made_in_vain_is_gone_with_its_parents),
        TEST(a_failed_run_leaves_the_old_file_and_the_folder_that_was_there),
        TEST(a_folder_below_a_file_is_refused_with_the_file_s_path),
        TEST(a_folder_that_cannot_be_made_is_refused_with_its_path),
        TEST(a_folder_without_permission_is_refused_with_its_path),
        TEST(a_folder_in_the_place_of_a_file_stops_all_renames),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
