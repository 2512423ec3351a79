#include "../refused_call.h"
#include "../scratch_folder.h"

#include "files/output_file.h"

#include <fcntl.h>
#include <limits.h>
#include <signal.h>
#include <sys/file.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <sys/wait.h>

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

    assert_int_equal(scratch_count("."), 1); /* the staging folder */
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

static mode_t permissions(const char *name)
{
    struct stat found;

    assert_int_equal(stat(scratch_path(name), &found), 0);
    return found.st_mode & 07777;
}

static void commit_text(const char *name, const char *text)
{
    output_file *file = open_output(name);

    fputs(text, output_file_stream(file));
    if (output_file_commit(file) != STATUS_OK) fail_msg("%s", status_message());
    output_file_free(file);
}

static void a_new_file_has_the_permissions_of_the_umask(void **state)
{
    const mode_t before = umask(027);
    (void)state;

    commit_text("new", "1");

    umask(before);
    assert_int_equal(permissions("new"), 0640);
}

static void a_file_keeps_the_permissions_of_the_one_it_replaces(void **state)
{
    const mode_t kept[] = {0600, 0664, 0444, 0};
    (void)state;

    put_old("kept");
    for (size_t i = 0; i < sizeof kept / sizeof *kept; i++) {
        assert_int_equal(chmod(scratch_path("kept"), kept[i]), 0);
        commit_text("kept", "new");
        assert_int_equal(permissions("kept"), kept[i]);
    }
}

static void a_link_is_replaced_and_what_it_points_to_stays(void **state)
{
    (void)state;
    put_old("victim");
    assert_int_equal(symlink("victim", scratch_path("link")), 0);

    commit_text("link", "new");

    scratch_assert_text("victim", "old");
    scratch_assert_text("link", "new");
    assert_int_equal(scratch_count("."), 2);
}

static void of_two_of_one_name_the_one_committed_last_stands_there_whole(void **state)
{
    (void)state;
    output_file *first = open_output("both"), *second = open_output("both");

    fputs("the second", output_file_stream(second));
    fputs("first", output_file_stream(first));
    assert_int_equal(output_file_commit(second), STATUS_OK);
    assert_int_equal(output_file_commit(first), STATUS_OK);
    output_file_free(first);
    output_file_free(second);

    scratch_assert_text("both", "first");
    assert_int_equal(scratch_count("."), 1);
}

static void a_commit_waits_for_that_of_another_process(void **state)
{
    (void)state;
    put_old("kept");
    const int folder = open(scratch, O_RDONLY | O_DIRECTORY);
    assert_int_equal(flock(folder, LOCK_EX), 0);
    const pid_t other = fork();
    if (other == 0) {
        commit_text("kept", "new");
        _exit(0);
    }

    usleep(200000);
    scratch_assert_text("kept", "old");

    flock(folder, LOCK_UN);
    close(folder);
    int code = -1;
    assert_int_equal(waitpid(other, &code, 0), other);
    assert_int_equal(code, 0);
    scratch_assert_text("kept", "new");
}

/* Network file systems refuse the exchange of two names. */
static void without_exchange_of_names_a_file_is_replaced_as_well(void **state)
{
    (void)state;
    put_old("kept");
    const pid_t other = fork();
    if (other == 0) {
        refuse_exchanges();
        commit_text("kept", "new");
        commit_text("first", "1");
        _exit(0);
    }

    int code = -1;
    assert_int_equal(waitpid(other, &code, 0), other);
    assert_int_equal(code, 0);
    scratch_assert_text("kept", "new");
    scratch_assert_text("first", "1");
    assert_int_equal(scratch_count("."), 2);
}

static void a_name_that_no_file_can_have_is_refused_when_it_is_opened(void **state)
{
    char name[NAME_MAX + 2] = "";
    output_file *file = NULL;

    (void)state;
    memset(name, 'n', NAME_MAX + 1);
    assert_int_equal(output_file_open(&file, name), STATUS_FILE);
    assert_non_null(strstr(status_message(), "nnn: File name too long"));
    assert_null(file);
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
        IN_A_FOLDER(a_new_file_has_the_permissions_of_the_umask),
        IN_A_FOLDER(a_file_keeps_the_permissions_of_the_one_it_replaces),
        IN_A_FOLDER(a_link_is_replaced_and_what_it_points_to_stays),
        IN_A_FOLDER(of_two_of_one_name_the_one_committed_last_stands_there_whole),
        IN_A_FOLDER(a_commit_waits_for_that_of_another_process),
        IN_A_FOLDER(without_exchange_of_names_a_file_is_replaced_as_well),
        IN_A_FOLDER(a_name_that_no_file_can_have_is_refused_when_it_is_opened),
        IN_A_FOLDER(a_folder_that_is_not_there_is_named),
        IN_A_FOLDER(a_disk_without_room_keeps_the_old_file),
        IN_A_FOLDER(freeing_nothing_is_allowed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
