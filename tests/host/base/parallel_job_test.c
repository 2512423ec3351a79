/* Jobs: all are run, by any thread; the first failure of the list is told. */
#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdatomic.h>

#include "base/interrupt.h"
#include "base/parallel_job.h"

enum { ERRANDS = 100 };

typedef struct fake {
    status rc;
    const char *says;
    atomic_uint runs;
} fake;

static status run_fake(void *self)
{
    fake *f = self;

    atomic_fetch_add(&f->runs, 1);
    if (f->says) status_warn("%s", f->says);
    return f->rc == STATUS_OK ? STATUS_OK : status_set(f->rc, "failed: %s", f->says);
}

static status run_all(fake *fakes)
{
    parallel_job list[ERRANDS];

    for (int i = 0; i < ERRANDS; i++) list[i] = (parallel_job){run_fake, &fakes[i]};
    return parallel_run(list, ERRANDS);
}

static void every_errand_is_run_once(void **state)
{
    static fake fakes[ERRANDS];
    (void)state;

    assert_int_equal(run_all(fakes), STATUS_OK);

    for (int i = 0; i < ERRANDS; i++) assert_int_equal(fakes[i].runs, 1);
}

static void of_several_failures_the_first_of_the_list_is_told(void **state)
{
    static fake fakes[ERRANDS];
    (void)state;

    fakes[1] = (fake){.rc = STATUS_FILE, .says = "second"};
    for (int i = 2; i < ERRANDS; i++) fakes[i] = (fake){.rc = STATUS_MEMORY, .says = "later"};

    assert_int_equal(run_all(fakes), STATUS_FILE);
    assert_string_equal(status_message(), "failed: second");
    assert_int_equal(fakes[ERRANDS - 1].runs, 0); /* at most 8 threads had begun one before */
    status_warnings();
}

static void warnings_become_the_callers_in_the_order_of_the_list(void **state)
{
    static fake fakes[ERRANDS];
    (void)state;

    fakes[3].says = "one";
    fakes[90].says = "two";

    assert_int_equal(run_all(fakes), STATUS_OK);
    assert_string_equal(status_warnings(), "one\ntwo\n");
}

static atomic_int token;
static atomic_uint begun;

static status set_token(void *self)
{
    (void)self;
    atomic_fetch_add(&begun, 1);
    atomic_store(&token, 1);
    return interrupt_check();
}

static void an_interrupt_is_obeyed_by_every_thread(void **state)
{
    parallel_job list[ERRANDS];

    (void)state;
    for (int i = 0; i < ERRANDS; i++) list[i] = (parallel_job){set_token, NULL};

    interrupt_obey(&token);
    assert_int_equal(parallel_run(list, ERRANDS), STATUS_INTERRUPTED);
    interrupt_obey(NULL);

    assert_string_equal(status_message(), "interrupted");
    assert_in_range(begun, 1, 8); /* one a thread */
}

static void no_errands_are_no_failure(void **state)
{
    (void)state;

    assert_int_equal(parallel_run(NULL, 0), STATUS_OK);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_errand_is_run_once),
        cmocka_unit_test(of_several_failures_the_first_of_the_list_is_told),
        cmocka_unit_test(warnings_become_the_callers_in_the_order_of_the_list),
        cmocka_unit_test(an_interrupt_is_obeyed_by_every_thread),
        cmocka_unit_test(no_errands_are_no_failure),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
