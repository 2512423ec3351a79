#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <dlfcn.h>
#include <errno.h>
#include <pthread.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <time.h>

#include "base/interrupt.h"
#include "render/tile_queue.h"

enum { PIXELS = 10007, WORKERS = 4 };

/* A worker that counts how often it has computed each pixel, and fails when it is told to. */
typedef struct fake {
    uint32_t most, room; /* pixels of a tile; above `room` it has no memory */
    uint32_t good_tiles; /* it fails at the next one after them */
    bool fails_to_open, waits;
    const char *warning;
    uint32_t tiles;
} fake;

static atomic_uint times[PIXELS];
static atomic_uint computed; /* pixels */
static atomic_int token;
static int threads_left; /* that can still be started */
static uint32_t last_progress;
static bool is_rising;

/* In place of the library's: fails once there are no threads left. */
int pthread_create(pthread_t *thread, const pthread_attr_t *attributes, void *(*run)(void *),
                   void *argument)
{
    int (*start)(pthread_t *, const pthread_attr_t *, void *(*)(void *), void *);

    *(void **)&start = dlsym(RTLD_NEXT, "pthread_create");
    return threads_left-- > 0 ? start(thread, attributes, run, argument) : EAGAIN;
}

static status open_fake(void *self, uint32_t *out_most)
{
    fake *f = self;

    *out_most = f->most;
    if (f->warning) status_warn("%s", f->warning);
    return f->fails_to_open ? status_set(STATUS_DEVICE, "it does not open") : STATUS_OK;
}

static status compute_fake(void *self, uint32_t first, uint32_t count)
{
    fake *f = self;

    if (count > f->room) return status_set(STATUS_MEMORY, "no room for %u", count);
    /* Its tile is then the last one of all. */
    while (f->waits && atomic_load(&computed) < PIXELS - count)
        nanosleep(&(struct timespec){.tv_nsec = 1000000}, NULL);
    if (f->tiles == f->good_tiles) return status_set(STATUS_DEVICE, "it broke");
    f->tiles++;
    for (uint32_t i = first; i < first + count; i++) atomic_fetch_add(&times[i], 1);
    atomic_fetch_add(&computed, count);
    return STATUS_OK;
}

static void progress(void *listener, uint32_t done)
{
    (void)listener;
    is_rising &= done > last_progress; /* in a thread of a worker: asserted later */
    last_progress = done;
}

static fake sound(void)
{
    return (fake){.most = 100, .room = PIXELS, .good_tiles = UINT32_MAX};
}

static status run_with(int threads, fake *fakes, size_t count, bool *out_failed)
{
    static const char *const names[WORKERS] = {"first", "second", "third", "fourth"};
    tile_worker worker[WORKERS];
    const tile_queue_job job = {
        .pixel_count = PIXELS, .worker = worker, .worker_count = count, .on_progress = progress};

    for (size_t i = 0; i < count; i++)
        worker[i] = (tile_worker){&fakes[i], names[i], open_fake, compute_fake};
    memset(times, 0, sizeof times);
    atomic_store(&computed, 0);
    last_progress = 0;
    is_rising = true;
    status_warnings();
    threads_left = threads;
    return tile_queue_run(&job, out_failed);
}

static status run(fake *fakes, size_t count, bool *out_failed)
{
    return run_with(WORKERS, fakes, count, out_failed);
}

static void assert_every_pixel_once(void)
{
    for (uint32_t i = 0; i < PIXELS; i++) assert_int_equal(times[i], 1);
    assert_int_equal(last_progress, PIXELS);
    assert_true(is_rising);
}

static void every_pixel_is_computed_once_whatever_the_workers(void **state)
{
    (void)state;
    for (size_t count = 1; count <= WORKERS; count++) {
        fake fakes[WORKERS] = {sound(), sound(), sound(), sound()};
        bool failed[WORKERS];
        fakes[1].most = 7;

        assert_int_equal(run(fakes, count, failed), STATUS_OK);

        assert_every_pixel_once();
        for (size_t i = 0; i < count; i++) assert_false(failed[i]);
        assert_string_equal(status_warnings(), "");
    }
}

static void a_worker_that_fails_leaves_its_tiles_to_the_others(void **state)
{
    (void)state;
    for (uint32_t good = 0; good < 3; good++) {
        fake fakes[2] = {sound(), sound()};
        bool failed[2];
        fakes[0].good_tiles = good;
        fakes[1].most = 10;

        assert_int_equal(run(fakes, 2, failed), STATUS_OK);

        assert_every_pixel_once();
        if (!failed[0]) continue; /* it came too late to get another tile */
        assert_int_equal(fakes[0].tiles, good);
        assert_string_equal(status_warnings(),
                            "first failed, its tiles went to the others: it broke\n");
    }
}

static void the_last_tile_of_all_still_finds_another_worker(void **state)
{
    (void)state;
    fake fakes[3] = {sound(), sound(), sound()};
    bool failed[3];
    fakes[0].good_tiles = 0;
    fakes[0].waits = true;

    assert_int_equal(run(fakes, 3, failed), STATUS_OK);

    assert_every_pixel_once();
    assert_false(failed[1] || failed[2]);
}

static void a_worker_that_does_not_open_is_done_without(void **state)
{
    (void)state;
    fake fakes[2] = {sound(), sound()};
    bool failed[2];
    fakes[1].fails_to_open = true;

    assert_int_equal(run(fakes, 2, failed), STATUS_OK);

    assert_every_pixel_once();
    assert_true(!failed[0] && failed[1]);
    assert_non_null(strstr(status_warnings(), "second failed"));
}

static void where_all_fail_the_last_failure_is_that_of_the_run(void **state)
{
    (void)state;
    fake fakes[3] = {sound(), sound(), sound()};
    bool failed[3];
    fakes[0].good_tiles = 5;
    fakes[1].fails_to_open = true;
    fakes[2].good_tiles = 2;

    assert_int_equal(run(fakes, 3, failed), STATUS_DEVICE);

    assert_true(failed[0] && failed[1] && failed[2]);
    assert_non_null(strstr(status_message(), "it "));
}

static void the_failure_of_a_lone_worker_is_that_of_the_run(void **state)
{
    (void)state;
    fake alone = sound();
    bool failed;
    alone.good_tiles = 3;

    assert_int_equal(run(&alone, 1, &failed), STATUS_DEVICE);

    assert_true(failed);
    assert_string_equal(status_message(), "it broke");
    assert_string_equal(status_warnings(), "");
}

static void without_room_tiles_are_halved(void **state)
{
    (void)state;
    for (size_t count = 1; count <= 3; count++) {
        fake fakes[3] = {sound(), sound(), sound()};
        bool failed[3];
        for (size_t i = 0; i < count; i++) {
            fakes[i].most = 1 << 20;
            fakes[i].room = 1 + 37 * (uint32_t)i;
        }

        assert_int_equal(run(fakes, count, failed), STATUS_OK);

        assert_every_pixel_once();
    }
}

static void a_worker_without_room_for_a_pixel_fails(void **state)
{
    (void)state;
    fake fakes[2] = {sound(), sound()};
    bool failed[2];
    fakes[0].room = 0;
    fakes[1].room = 0;

    assert_int_equal(run(fakes, 2, failed), STATUS_MEMORY);

    assert_true(failed[0] && failed[1]);
}

static void a_worker_without_a_thread_is_done_without(void **state)
{
    (void)state;
    for (int threads = 0; threads < 2; threads++) {
        fake fakes[3] = {sound(), sound(), sound()};
        bool failed[3];

        assert_int_equal(run_with(threads, fakes, 3, failed), STATUS_OK);

        assert_every_pixel_once();
        assert_int_equal(fakes[2].tiles, 0);
        assert_false(failed[0] || failed[1] || failed[2]);
        assert_non_null(
            strstr(status_warnings(), "third is done without: no thread can be started\n"));
    }
}

static void where_the_only_worker_with_a_thread_fails_the_run_fails(void **state)
{
    (void)state;
    fake fakes[2] = {sound(), sound()};
    bool failed[2];
    fakes[0].good_tiles = 3;

    assert_int_equal(run_with(0, fakes, 2, failed), STATUS_DEVICE);

    assert_true(failed[0] && !failed[1]);
    assert_string_equal(status_message(), "it broke");
}

static void an_interrupt_before_it_leaves_all_undone(void **state)
{
    (void)state;
    atomic_store(&token, 1);
    for (size_t count = 1; count <= 2; count++) {
        fake fakes[2] = {sound(), sound()};
        bool failed[2];

        interrupt_obey(&token);
        assert_int_equal(run(fakes, count, failed), STATUS_INTERRUPTED);
        interrupt_obey(NULL);

        assert_int_equal(computed, 0);
    }
    atomic_store(&token, 0);
}

static status compute_until_interrupted(void *self, uint32_t first, uint32_t count)
{
    (void)self;
    if (first == 0) atomic_store(&token, 1);
    atomic_fetch_add(&computed, count);
    return interrupt_check();
}

/* Workers that fail because of it are not said to have failed. */
static void an_interrupt_ends_the_work_of_all_without_a_warning(void **state)
{
    (void)state;
    for (size_t count = 1; count <= WORKERS; count++) {
        fake fakes[WORKERS] = {sound(), sound(), sound(), sound()};
        bool failed[WORKERS];
        tile_worker worker[WORKERS];
        const tile_queue_job job = {.pixel_count = PIXELS, .worker = worker, .worker_count = count};
        for (size_t i = 0; i < count; i++)
            worker[i] = (tile_worker){&fakes[i], "one", open_fake, compute_until_interrupted};
        atomic_store(&computed, 0);
        threads_left = WORKERS;

        interrupt_obey(&token);
        assert_int_equal(tile_queue_run(&job, failed), STATUS_INTERRUPTED);
        interrupt_obey(NULL);

        assert_string_equal(status_message(), "interrupted");
        assert_string_equal(status_warnings(), "");
        assert_true(computed < PIXELS);
        atomic_store(&token, 0);
    }
}

static void what_several_workers_warn_of_is_said_once(void **state)
{
    (void)state;
    fake fakes[3] = {sound(), sound(), sound()};
    bool failed[3];
    fakes[0].warning = fakes[2].warning = "it is late";
    fakes[1].warning = "late"; /* a part of the other's, but not the same */

    assert_int_equal(run(fakes, 3, failed), STATUS_OK);

    assert_string_equal(status_warnings(), "it is late\nlate\n");
}

static void a_warning_that_another_contains_is_still_told(void **state)
{
    (void)state;
    fake fakes[2] = {sound(), sound()};
    bool failed[2];
    fakes[0].warning = "it is late and cold";
    fakes[1].warning = "it is late";

    assert_int_equal(run(fakes, 2, failed), STATUS_OK);

    assert_string_equal(status_warnings(), "it is late and cold\nit is late\n");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_pixel_is_computed_once_whatever_the_workers),
        cmocka_unit_test(a_worker_that_fails_leaves_its_tiles_to_the_others),
        cmocka_unit_test(the_last_tile_of_all_still_finds_another_worker),
        cmocka_unit_test(a_worker_that_does_not_open_is_done_without),
        cmocka_unit_test(where_all_fail_the_last_failure_is_that_of_the_run),
        cmocka_unit_test(the_failure_of_a_lone_worker_is_that_of_the_run),
        cmocka_unit_test(without_room_tiles_are_halved),
        cmocka_unit_test(a_worker_without_room_for_a_pixel_fails),
        cmocka_unit_test(a_worker_without_a_thread_is_done_without),
        cmocka_unit_test(where_the_only_worker_with_a_thread_fails_the_run_fails),
        cmocka_unit_test(an_interrupt_before_it_leaves_all_undone),
        cmocka_unit_test(an_interrupt_ends_the_work_of_all_without_a_warning),
        cmocka_unit_test(what_several_workers_warn_of_is_said_once),
        cmocka_unit_test(a_warning_that_another_contains_is_still_told),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
