/* The files of a render appear together or not at all. */
#include "files/output_folder.h"

#include "../refused_call.h"
#include "../scratch_folder.h"
#include "../skip.h"

#include <stdbool.h>
#include <sys/inotify.h>
#include <sys/stat.h>
#include <sys/wait.h>

static output_folder *opened(const char *name)
{
    output_folder *folder = NULL;

    if (output_folder_open(&folder, scratch_path(name)) != STATUS_OK)
        fail_msg("%s", status_message());
    return folder;
}

static void write_file(output_folder *folder, const char *name, const char *text)
{
    output_file *file = NULL;

    assert_int_equal(output_folder_add(folder, name, &file), STATUS_OK);
    fputs(text, output_file_stream(file));
    assert_int_equal(output_file_close(file), STATUS_OK);
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

static void a_folder_that_may_not_be_made_is_refused_with_the_true_reason(void **state)
{
    int code = -1;
    (void)state;

    if (geteuid() != 0) skip(); /* a parent of another user */
    chmod(scratch, 0755);
    const pid_t process = fork();
    if (process == 0) {
        output_folder *folder = NULL;
        if (setgid(65534) != 0 || setuid(65534) != 0) _exit(1);
        if (output_folder_open(&folder, scratch_path("out")) != STATUS_FILE) _exit(2);
        _exit(strstr(status_message(), "/out: cannot be made: Permission denied") ? 0 : 3);
    }
    assert_int_equal(waitpid(process, &code, 0), process);
    assert_int_equal(code, 0);
}

static void a_folder_without_permission_is_refused_with_its_path(void **state)
{
    output_folder *folder = NULL;
    (void)state;

    SKIP_IF(geteuid() == 0, "root may write anywhere");
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

static void two_files_of_one_name_are_refused(void **state)
{
    output_folder *folder = opened("out");
    output_file *file = NULL;
    (void)state;

    write_file(folder, "a.png", "1");
    assert_int_equal(output_folder_add(folder, "a.png", &file), STATUS_FILE);
    assert_non_null(strstr(status_message(), "out/a.png: two files of this name"));
    output_folder_free(folder);
    assert_int_equal(scratch_count(""), 0);
}

static void write_set(output_folder *folder, const char *text)
{
    static const char *const names[] = {"a.json", "a.hdr", "a.img", "b.png"};

    for (int i = 0; i < 4; i++) write_file(folder, names[i], text);
}

/* In a folder like /tmp a user may not rename a file of another one.
 *   exchanges   false: on a file system that cannot exchange two names */
static void commit_as_nobody(bool exchanges, const char *not_ours)
{
    int code = -1;
    const pid_t process = fork();

    assert_true(process >= 0);
    if (process == 0) {
        char expected[64];
        if (setgid(65534) != 0 || setuid(65534) != 0) _exit(1);
        output_folder *folder = opened("out");
        write_set(folder, "new");
        if (!exchanges) refuse_exchanges();
        if (output_folder_commit(folder) != STATUS_FILE) _exit(2);
        snprintf(expected, sizeof expected, "out/%s: Operation not permitted", not_ours);
        if (!strstr(status_message(), expected)) _exit(3);
        output_folder_free(folder);
        _exit(0);
    }
    assert_int_equal(waitpid(process, &code, 0), process);
    assert_int_equal(code, 0);
}

static void a_rename_that_fails_leaves_all_old_files(void **state)
{
    static const char *const names[] = {"a.json", "a.hdr", "a.img", "b.png"};
    (void)state;

    if (geteuid() != 0) skip(); /* files of two users */
    chmod(scratch, 0755);
    for (int i = 0; i < 8; i++) {
        const char *not_ours = names[i / 2];
        assert_int_equal(mkdir(scratch_path("out"), 0777), 0);
        assert_int_equal(chmod(scratch_path("out"), 01777), 0);
        for (int k = 0; k < 4; k++) {
            char name[32];
            snprintf(name, sizeof name, "out/%s", names[k]);
            if (k == 3 && i / 2 != 3) continue; /* none before: none after */
            FILE *file = fopen(scratch_path(name), "w");
            fputs("old", file);
            fclose(file);
            if (k != i / 2) assert_int_equal(chown(scratch_path(name), 65534, 65534), 0);
        }
        const int before = scratch_count("out");

        commit_as_nobody(i % 2, not_ours);

        assert_int_equal(scratch_count("out"), before);
        for (int k = 0; k < 3; k++) {
            char name[32];
            snprintf(name, sizeof name, "out/%s", names[k]);
            scratch_assert_text(name, "old");
        }
        scratch_remove(scratch_path("out"));
    }
}

static void headers_come_after_the_data_and_the_report_last(void **state)
{
    char events[4096], order[256] = "";
    ssize_t size;
    (void)state;

    mkdir(scratch_path("out"), 0777);
    const int watch = inotify_init1(IN_NONBLOCK);
    assert_true(inotify_add_watch(watch, scratch_path("out"), IN_MOVED_TO) >= 0);
    output_folder *folder = opened("out");
    write_set(folder, "new");

    assert_int_equal(output_folder_commit(folder), STATUS_OK);

    while ((size = read(watch, events, sizeof events)) > 0) {
        for (char *at = events; at < events + size;) {
            const struct inotify_event *event = (const struct inotify_event *)at;
            strcat(strcat(order, event->name), " ");
            at += sizeof *event + event->len;
        }
    }
    close(watch);
    output_folder_free(folder);
    assert_string_equal(order, "a.img b.png a.hdr a.json ");
}

static void of_two_renders_at_once_one_whole_set_stands_there(void **state)
{
    enum { PROCESSES = 4, ROUNDS = 30 };
    pid_t process[PROCESSES];
    (void)state;

    for (int i = 0; i < PROCESSES; i++) {
        process[i] = fork();
        assert_true(process[i] >= 0);
        if (process[i] > 0) continue;
        const char text[2] = {(char)('A' + i), '\0'};
        for (int k = 0; k < ROUNDS; k++) {
            output_folder *folder = opened("out");
            write_set(folder, text);
            if (output_folder_commit(folder) != STATUS_OK) _exit(1);
            output_folder_free(folder);
        }
        _exit(0);
    }
    for (int i = 0; i < PROCESSES; i++) {
        int code = -1;
        assert_int_equal(waitpid(process[i], &code, 0), process[i]);
        assert_int_equal(code, 0);
    }

    scratch_assert_same("out/a.json", "out/a.img");
    scratch_assert_same("out/a.json", "out/a.hdr");
    scratch_assert_same("out/a.json", "out/b.png");
    assert_int_equal(scratch_count("out"), 4);
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
        TEST(a_folder_that_may_not_be_made_is_refused_with_the_true_reason),
        TEST(a_folder_without_permission_is_refused_with_its_path),
        TEST(a_folder_in_the_place_of_a_file_stops_all_renames),
        TEST(two_files_of_one_name_are_refused),
        TEST(a_rename_that_fails_leaves_all_old_files),
        TEST(headers_come_after_the_data_and_the_report_last),
        TEST(of_two_renders_at_once_one_whole_set_stands_there),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
