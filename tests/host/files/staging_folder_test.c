/* Private folders, and what is left of them when a process is killed. */
#include "files/staging_folder.h"

#include "../scratch_folder.h"

#include <signal.h>
#include <sys/stat.h>
#include <sys/wait.h>

static staging_folder *opened(void)
{
    staging_folder *staging = NULL;

    if (staging_folder_open(&staging, scratch, scratch) != STATUS_OK)
        fail_msg("%s", status_message());
    return staging;
}

static void put_file(const char *folder, const char *name)
{
    char path[1024];

    snprintf(path, sizeof path, "%s/%s", folder, name);
    FILE *file = fopen(path, "wx");
    assert_non_null(file);
    fclose(file);
}

/* Opens a folder in a process of its own, which puts files into it and waits to be killed. */
static pid_t start_process(void)
{
    char folder[512], ready;
    int pipe_end[2];

    assert_int_equal(pipe(pipe_end), 0);
    const pid_t process = fork();
    assert_true(process >= 0);
    if (process == 0) {
        staging_folder *staging = opened();
        snprintf(folder, sizeof folder, "%s/inner", staging_folder_path(staging));
        if (mkdir(folder, 0777) != 0) _exit(1);
        put_file(staging_folder_path(staging), "a.img");
        put_file(folder, "b");
        if (write(pipe_end[1], "r", 1) != 1) _exit(1);
        for (;;) pause();
    }
    close(pipe_end[1]);
    assert_int_equal(read(pipe_end[0], &ready, 1), 1);
    close(pipe_end[0]);
    return process;
}

static void kill_process(pid_t process)
{
    kill(process, SIGKILL);
    assert_int_equal(waitpid(process, NULL, 0), process);
}

static void nobody_else_may_look_into_it(void **state)
{
    (void)state;
    struct stat found;
    staging_folder *staging = opened();

    assert_int_equal(fstat(staging_folder_self(staging), &found), 0);

    assert_int_equal(found.st_mode, S_IFDIR | 0700);
    staging_folder_free(staging);
}

static void it_goes_with_all_that_it_holds(void **state)
{
    (void)state;
    char inner[512];
    staging_folder *staging = opened();
    snprintf(inner, sizeof inner, "%s/inner", staging_folder_path(staging));
    mkdir(inner, 0777);
    put_file(inner, "a");
    put_file(staging_folder_path(staging), "b");

    staging_folder_free(staging);

    assert_int_equal(scratch_count(""), 0);
}

static void what_a_killed_process_left_goes_when_the_next_is_opened(void **state)
{
    (void)state;
    kill_process(start_process());
    assert_int_equal(scratch_count(""), 1);

    staging_folder *staging = opened();

    assert_int_equal(scratch_count(""), 1);
    assert_int_equal(access(staging_folder_path(staging), F_OK), 0);
    staging_folder_free(staging);
    assert_int_equal(scratch_count(""), 0);
}

static void those_of_living_processes_stay(void **state)
{
    (void)state;
    const pid_t process = start_process();
    staging_folder *first = opened();

    staging_folder *second = opened();

    assert_int_equal(scratch_count(""), 3);
    staging_folder_free(second);
    staging_folder_free(first);
    assert_int_equal(scratch_count(""), 1);
    kill_process(process);
}

static void a_link_of_such_a_name_is_not_followed(void **state)
{
    (void)state;
    mkdir(scratch_path("victim"), 0777);
    put_file(scratch_path("victim"), ".radsig-lock");
    put_file(scratch_path("victim"), "precious");
    assert_int_equal(symlink(scratch_path("victim"), scratch_path(".radsig-ABCDEF")), 0);

    staging_folder_free(opened());

    assert_int_equal(scratch_count("victim"), 2);
    assert_int_equal(unlink(scratch_path(".radsig-ABCDEF")), 0);
}

static void a_folder_of_such_a_name_that_holds_no_lock_stays(void **state)
{
    (void)state;
    mkdir(scratch_path(".radsig-ABCDEF"), 0777);
    put_file(scratch_path(".radsig-ABCDEF"), "precious");

    staging_folder_free(opened());

    assert_int_equal(scratch_count(".radsig-ABCDEF"), 1);
}

static void what_another_user_left_stays(void **state)
{
    (void)state;
    if (geteuid() != 0) skip();
    mkdir(scratch_path(".radsig-ABCDEF"), 0777);
    put_file(scratch_path(".radsig-ABCDEF"), ".radsig-lock");
    assert_int_equal(chown(scratch_path(".radsig-ABCDEF"), 65534, 65534), 0);

    staging_folder_free(opened());

    assert_int_equal(scratch_count(".radsig-ABCDEF"), 1);
}

static void a_parent_that_is_not_there_is_told_with_what_was_to_be_made(void **state)
{
    (void)state;
    staging_folder *staging = NULL;

    assert_int_equal(staging_folder_open(&staging, scratch_path("none"), "a.img"), STATUS_FILE);

    assert_string_equal(status_message(), "a.img: No such file or directory");
    assert_null(staging);
}

#define IN_A_FOLDER(test) cmocka_unit_test_setup_teardown(test, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        IN_A_FOLDER(nobody_else_may_look_into_it),
        IN_A_FOLDER(it_goes_with_all_that_it_holds),
        IN_A_FOLDER(what_a_killed_process_left_goes_when_the_next_is_opened),
        IN_A_FOLDER(those_of_living_processes_stay),
        IN_A_FOLDER(a_link_of_such_a_name_is_not_followed),
        IN_A_FOLDER(a_folder_of_such_a_name_that_holds_no_lock_stays),
        IN_A_FOLDER(what_another_user_left_stays),
        IN_A_FOLDER(a_parent_that_is_not_there_is_told_with_what_was_to_be_made),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
