#include "scratch_folder.h"

#include "output_file.h"

#include <signal.h>
#include <sys/resource.h>

static void put_old(const char *name)
{
    FILE *stream = fopen(scratch_path(name), "wb");

    assert_non_null(stream);
    fputs("old", stream);
    fclose(stream);
}

static output_file *open_output(const char *name)
{
    output_file *file = NULL;

    if (output_file_open(&file, scratch_path(name)) != STATUS_OK) fail_msg("%s", status_message());
    return file;
}

static void a_committed_file_stands_in_its_place_alone(void **state)
{
    (void)state;
    output_file *file = open_output("new");

    assert_int_equal(scratch_count("."), 1); /* the temporary one */
    fputs("whole", output_file_stream(file));
    assert_int_equal(output_file_commit(file), STATUS_OK);
    output_file_free(file);
    scratch_assert_text("new", "whole");
    assert_int_equal(scratch_count("."), 1);
}

static void the_old_file_stays_until_the_commit(void **state)
{
    (void)state;
    put_old("kept");
    output_file *file = open_output("kept");

    fputs("new", output_file_stream(file));
    fflush(output_file_stream(file));
    scratch_assert_text("kept", "old");
    assert_int_equal(output_file_commit(file), STATUS_OK);
    output_file_free(file);
    scratch_assert_text("kept", "new");
}

static void a_device_or_a_folder_is_not_replaced(void **state)
{
    static const char *const paths[] = {"/dev/null", "/"};
    output_file *file = NULL;

    (void)state;
    for (int i = 0; i < 2; i++) {
        assert_int_equal(output_file_open(&file, paths[i]), STATUS_FILE);
        assert_null(file);
    }
}

static void a_file_that_is_not_committed_leaves_nothing(void **state)
{
    (void)state;
    put_old("kept");
    output_file *file = open_output("kept");

    fputs("half", output_file_stream(file));
    output_file_free(file);
    scratch_assert_text("kept", "old");
    assert_int_equal(scratch_count("."), 1);
}

static void the_temporary_file_stands_beside_its_place(void **state)
{
    (void)state;
    output_file *file = open_output("here");
    const char *path = output_file_path(file), *temporary = output_file_temporary_path(file);

    assert_string_equal(path, scratch_path("here"));
    assert_int_equal(strncmp(temporary, path, strlen(path)), 0);
    assert_string_not_equal(temporary, path);
    output_file_free(file);
}

static void a_reserved_file_is_written_by_name(void **state)
{
    output_file *file = NULL;

    (void)state;
    assert_int_equal(output_file_reserve(&file, scratch_path("named")), STATUS_OK);
    assert_null(output_file_stream(file));
    assert_int_equal(scratch_count("."), 0);
    FILE *stream = fopen(output_file_temporary_path(file), "wb");
    fputs("by name", stream);
    fclose(stream);
    assert_int_equal(output_file_commit(file), STATUS_OK);
    output_file_free(file);
    scratch_assert_text("named", "by name");
}

static void a_reserved_file_that_nobody_wrote_fails(void **state)
{
    output_file *file = NULL;

    (void)state;
    assert_int_equal(output_file_reserve(&file, scratch_path("unwritten")), STATUS_OK);
    assert_int_equal(output_file_commit(file), STATUS_FILE);
    assert_non_null(strstr(status_message(), "unwritten: No such file"));
    output_file_free(file);
}

static void a_folder_that_is_not_there_is_named(void **state)
{
    output_file *file = NULL;

    (void)state;
    assert_int_equal(output_file_open(&file, scratch_path("none/file")), STATUS_FILE);
    assert_non_null(strstr(status_message(), "none/file: No such file"));
    assert_null(file);
}

/* A limit of the process stands for a full disk. */
static void a_disk_without_room_keeps_the_old_file(void **state)
{
    static char block[100000];
    struct rlimit before, limit;

    (void)state;
    put_old("full");
    output_file *file = open_output("full");
    getrlimit(RLIMIT_FSIZE, &before);
    limit = before;
    limit.rlim_cur = 50000;
    signal(SIGXFSZ, SIG_IGN);
    setrlimit(RLIMIT_FSIZE, &limit);
    fwrite(block, 1, sizeof block, output_file_stream(file));
    const status rc = output_file_commit(file);
    setrlimit(RLIMIT_FSIZE, &before);

    assert_int_equal(rc, STATUS_FILE);
    assert_non_null(strstr(status_message(), "full: writing failed"));
    output_file_free(file);
    scratch_assert_text("full", "old");
    assert_int_equal(scratch_count("."), 1);
}

static void freeing_nothing_is_allowed(void **state)
{
    (void)state;
    output_file_free(NULL);
}

#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(a_committed_file_stands_in_its_place_alone),
        IN_A_FOLDER(the_old_file_stays_until_the_commit),
        IN_A_FOLDER(a_device_or_a_folder_is_not_replaced),
        IN_A_FOLDER(a_file_that_is_not_committed_leaves_nothing),
        IN_A_FOLDER(the_temporary_file_stands_beside_its_place),
        IN_A_FOLDER(a_reserved_file_is_written_by_name),
        IN_A_FOLDER(a_reserved_file_that_nobody_wrote_fails),
        IN_A_FOLDER(a_folder_that_is_not_there_is_named),
        IN_A_FOLDER(a_disk_without_room_keeps_the_old_file),
        IN_A_FOLDER(freeing_nothing_is_allowed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
