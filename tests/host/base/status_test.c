#include "base/status.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <pthread.h>
#include <string.h>

static int forget(void **state)
{
    (void)state;
    status_clear();
    status_warnings();
    return 0;
}

static status need(int condition)
{
    status rc = STATUS_OK;

    NEED(condition, STATUS_FORMAT, "%d is not enough", condition);
    rc = STATUS_INTERRUPTED;
out:
    return rc;
}

static status try(int condition)
{
    status rc = STATUS_OK;

    TRY(need(condition));
out:
    return rc;
}

static void a_failure_leaves_its_code_and_its_text(void **state)
{
    (void)state;
    assert_int_equal(status_set(STATUS_FILE, "%s: %d", "scene", 7), STATUS_FILE);
    assert_string_equal(status_message(), "scene: 7");
}

static void a_second_failure_replaces_the_first(void **state)
{
    (void)state;
    status_set(STATUS_FILE, "the first, which is longer");
    status_set(STATUS_MEMORY, "the second");
    assert_string_equal(status_message(), "the second");
}

static void need_and_try_pass_the_code_on(void **state)
{
    (void)state;
    assert_int_equal(need(1), STATUS_INTERRUPTED);
    assert_int_equal(try(0), STATUS_FORMAT);
    assert_string_equal(status_message(), "0 is not enough");
}

static void a_kept_message_stays_above_the_next(void **state)
{
    (void)state;
    assert_int_equal(status_keep(status_set(STATUS_FILE, "one")), STATUS_FILE);
    status_keep(status_set(STATUS_FORMAT, "two"));
    status_set(STATUS_FORMAT, "dropped");
    status_set(STATUS_FORMAT, "three");
    assert_string_equal(status_message(), "one\ntwo\nthree");
}

static void a_message_is_kept_once(void **state)
{
    (void)state;
    status_keep(status_set(STATUS_FILE, "one"));
    status_keep(STATUS_FILE);
    status_set(STATUS_FILE, "two");
    assert_string_equal(status_message(), "one\ntwo");
}

static void clearing_forgets_what_was_kept(void **state)
{
    (void)state;
    status_keep(status_set(STATUS_FILE, "one"));
    status_clear();
    assert_string_equal(status_message(), "");
    status_set(STATUS_FILE, "two");
    assert_string_equal(status_message(), "two");
}

static void warnings_are_told_once(void **state)
{
    (void)state;
    status_warn("%d columns", 3);
    status_warn("no ground");
    assert_string_equal(status_warnings_so_far(), "3 columns\nno ground\n");
    assert_string_equal(status_warnings(), "3 columns\nno ground\n");
    assert_string_equal(status_warnings(), "");
}

static void warnings_do_not_touch_the_message(void **state)
{
    (void)state;
    status_set(STATUS_FILE, "one");
    status_warn("two");
    assert_string_equal(status_message(), "one");
}

static void told_warnings_stay_valid_while_new_ones_come(void **state)
{
    (void)state;
    status_warn("old");
    const char *told = status_warnings();
    status_warn("new");
    assert_string_equal(told, "old\n");
}

/* 64 KiB is what a thread holds; the texts below would need 300. */
static void more_than_fits_is_cut(void **state)
{
    char text[1001];

    (void)state;
    memset(text, 'x', sizeof text - 1);
    text[sizeof text - 1] = '\0';
    for (int i = 0; i < 300; i++) status_warn("%s", text);
    for (int i = 0; i < 300; i++) status_keep(status_set(STATUS_FILE, "%s", text));
    assert_in_range(strlen(status_warnings()), 60000, 65535);
    assert_in_range(strlen(status_message()), 60000, 65535);
    assert_string_equal(status_warnings(), "");
}

static void what_a_terminal_would_act_on_is_not_repeated(void **state)
{
    (void)state;
    status_set(STATUS_FORMAT, "a.wth:1: '%s' stands there", "\x1b[2Jlate\r");
    status_warn("%s", "\x1b]0;title\x07");
    assert_string_equal(status_message(), "a.wth:1: '?[2Jlate?' stands there");
    assert_string_equal(status_warnings(), "?]0;title?\n");
}

static void the_last_failure_stands_alone_whatever_is_kept_above_it(void **state)
{
    (void)state;
    status_keep(status_set(STATUS_FILE, "one"));
    status_set(STATUS_FILE, "a longer one that nobody keeps");
    status_set(STATUS_FORMAT, "two");
    assert_string_equal(status_last(), "two");
    status_keep(STATUS_FORMAT);
    assert_string_equal(status_last(), "");
}

static void what_is_finished_is_replaced_by_the_next_failure(void **state)
{
    (void)state;
    status_keep(status_set(STATUS_FILE, "one"));
    status_keep(status_set(STATUS_FILE, "two"));
    assert_int_equal(status_finish(STATUS_FORMAT), STATUS_FORMAT);
    assert_string_equal(status_message(), "one\ntwo");
    status_set(STATUS_FILE, "another");
    assert_string_equal(status_message(), "another");
}

static void *fail_elsewhere(void *record)
{
    status_warn("late");
    status_warn("cold");
    *(status_record *)record = status_record_take(status_set(STATUS_FILE, "no file"));
    status_set(STATUS_MEMORY, "what comes later is not taken");
    return NULL;
}

static void what_another_thread_left_is_told_line_by_line_and_once(void **state)
{
    status_record record;
    pthread_t thread;

    (void)state;
    assert_int_equal(pthread_create(&thread, NULL, fail_elsewhere, &record), 0);
    pthread_join(thread, NULL);
    status_warn("cold");
    status_warn("it is late");

    assert_int_equal(status_record_tell(&record), STATUS_FILE);
    assert_int_equal(status_record_tell(&record), STATUS_FILE);
    status_record_free(&record);

    assert_string_equal(status_message(), "no file");
    assert_string_equal(status_warnings(), "cold\nit is late\nlate\n");
}

static void what_went_well_is_told_without_a_message(void **state)
{
    status_record record;

    (void)state;
    status_set(STATUS_FILE, "before");
    record = status_record_take(STATUS_OK);

    assert_int_equal(status_record_tell(&record), STATUS_OK);
    assert_null(record.message);
    status_record_free(&record);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(a_failure_leaves_its_code_and_its_text, forget),
        cmocka_unit_test_setup(a_second_failure_replaces_the_first, forget),
        cmocka_unit_test_setup(need_and_try_pass_the_code_on, forget),
        cmocka_unit_test_setup(a_kept_message_stays_above_the_next, forget),
        cmocka_unit_test_setup(a_message_is_kept_once, forget),
        cmocka_unit_test_setup(clearing_forgets_what_was_kept, forget),
        cmocka_unit_test_setup(warnings_are_told_once, forget),
        cmocka_unit_test_setup(warnings_do_not_touch_the_message, forget),
        cmocka_unit_test_setup(told_warnings_stay_valid_while_new_ones_come, forget),
        cmocka_unit_test_setup(more_than_fits_is_cut, forget),
        cmocka_unit_test_setup(what_a_terminal_would_act_on_is_not_repeated, forget),
        cmocka_unit_test_setup(the_last_failure_stands_alone_whatever_is_kept_above_it, forget),
        cmocka_unit_test_setup(what_is_finished_is_replaced_by_the_next_failure, forget),
        cmocka_unit_test_setup(what_another_thread_left_is_told_line_by_line_and_once, forget),
        cmocka_unit_test_setup(what_went_well_is_told_without_a_message, forget),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
