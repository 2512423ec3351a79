#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <stdatomic.h>
#include <stdbool.h>
#include <string.h>
#include <time.h>

#include "tile_queue.h"

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
static volatile sig_atomic_t stop;
static uint32_t last_progress;
static bool is_rising;

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

static status run(fake *fakes, size_t count, bool *out_failed)
{
    static const char *const names[WORKERS] = {"first", "second", "third", "fourth"};
    tile_worker worker[WORKERS];
    const tile_queue_job job = {.pixel_count = PIXELS,
                                .worker = worker,
                                .worker_count = count,
                                .on_progress = progress,
                                .stop = &stop};

    for (size_t i = 0; i < count; i++)
        worker[i] = (tile_worker){&fakes[i], names[i], open_fake, compute_fake};
    memset(times, 0, sizeof times);
    atomic_store(&computed, 0);
    last_progress = 0;
    is_rising = true;
    status_warnings();
    return tile_queue_run(&job, out_failed);
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

static void when_it_is_told_to_stop_it_is_interrupted(void **state)
{
    (void)state;
    stop = 1;
    for (size_t count = 1; count <= 2; count++) {
        fake fakes[2] = {sound(), sound()};
        bool failed[2];

        assert_int_equal(run(fakes, count, failed), STATUS_INTERRUPTED);

        assert_int_equal(computed, 0);
    }
    stop = 0;
}

static void what_several_workers_warn_of_is_said_once(void **state)
{
    (void)state;
    fake fakes[3] = {sound(), sound(), sound()};
    bool failed[3];
    fakes[0].warning = fakes[2].warning = "it is late";
    fakes[1].warning = "it is cold";

    assert_int_equal(run(fakes, 3, failed), STATUS_OK);

    assert_string_equal(status_warnings(), "it is late\nit is cold\n");
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
        cmocka_unit_test(when_it_is_told_to_stop_it_is_interrupted),
        cmocka_unit_test(what_several_workers_warn_of_is_said_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
