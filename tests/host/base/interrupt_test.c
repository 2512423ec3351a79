/* Interrupts: a token ends the work of the threads that obey it, and the signals that set one. */
#include "base/interrupt.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <pthread.h>
#include <signal.h>
#include <sys/wait.h>
#include <unistd.h>

static void without_a_token_nothing_is_interrupted(void **state)
{
    (void)state;
    assert_false(interrupt_is_set());
    assert_int_equal(interrupt_check(), STATUS_OK);
    assert_int_equal(interrupt_status(status_set(STATUS_FILE, "no file")), STATUS_FILE);
    assert_string_equal(status_message(), "no file");
}

static void what_fails_after_the_token_was_set_was_interrupted(void **state)
{
    atomic_int token = 0;

    (void)state;
    interrupt_obey(&token);
    assert_int_equal(interrupt_check(), STATUS_OK);
    atomic_store(&token, 1);
    assert_true(interrupt_is_set());
    assert_int_equal(interrupt_check(), STATUS_INTERRUPTED);
    assert_int_equal(interrupt_status(status_set(STATUS_FILE, "no file")), STATUS_INTERRUPTED);
    assert_string_equal(status_message(), "interrupted");
    assert_int_equal(interrupt_status(STATUS_OK), STATUS_OK);
    interrupt_obey(NULL);
}

static void *look(void *out)
{
    *(bool *)out = interrupt_is_set();
    return NULL;
}

static void a_token_is_obeyed_by_the_thread_that_was_told_to(void **state)
{
    atomic_int token = 1;
    bool is_set = true;
    pthread_t thread;

    (void)state;
    interrupt_obey(&token);
    assert_int_equal(pthread_create(&thread, NULL, look, &is_set), 0);
    pthread_join(thread, NULL);
    assert_false(is_set);
    assert_ptr_equal(interrupt_token(), &token);
    interrupt_obey(NULL);
}

/* Runs a child that gets two signals; returns how it ended. */
static int after(int first, int second, void (*first_action)(int))
{
    int ended = 0;
    const pid_t child = fork();

    if (child == 0) {
        signal(first, first_action);
        interrupt_catch_signals();
        raise(first);
        if (interrupt_is_set() != (first_action == SIG_DFL)) _exit(1);
        if (second) raise(second);
        _exit(0);
    }
    assert_int_equal(waitpid(child, &ended, 0), child);
    return ended;
}

static void each_of_the_signals_sets_the_token(void **state)
{
    (void)state;
    assert_int_equal(after(SIGINT, 0, SIG_DFL), 0);
    assert_int_equal(after(SIGTERM, 0, SIG_DFL), 0);
    assert_int_equal(after(SIGHUP, 0, SIG_DFL), 0);
}

static void a_second_signal_ends_the_process(void **state)
{
    (void)state;
    assert_int_equal(WTERMSIG(after(SIGINT, SIGINT, SIG_DFL)), SIGINT);
    assert_int_equal(WTERMSIG(after(SIGINT, SIGTERM, SIG_DFL)), SIGTERM);
}

static void a_signal_that_was_ignored_stays_ignored(void **state)
{
    (void)state;
    assert_int_equal(after(SIGHUP, SIGHUP, SIG_IGN), 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(without_a_token_nothing_is_interrupted),
        cmocka_unit_test(what_fails_after_the_token_was_set_was_interrupted),
        cmocka_unit_test(a_token_is_obeyed_by_the_thread_that_was_told_to),
        cmocka_unit_test(each_of_the_signals_sets_the_token),
        cmocka_unit_test(a_second_signal_ends_the_process),
        cmocka_unit_test(a_signal_that_was_ignored_stays_ignored),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
