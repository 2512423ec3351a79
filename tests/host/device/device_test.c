/* RTLD_NEXT */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include "launches.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include <CL/cl.h>
#include <dlfcn.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char *added_option = "";

/* Stands before the library's function, so that a kernel can be made to fail. */
cl_int clBuildProgram(cl_program program, cl_uint count, const cl_device_id *devices,
                      const char *options, void(CL_CALLBACK *notify)(cl_program, void *),
                      void *data)
{
    cl_int (*real)(cl_program, cl_uint, const cl_device_id *, const char *,
                   void(CL_CALLBACK *)(cl_program, void *), void *);
    char all[256];

    *(void **)&real = dlsym(RTLD_NEXT, "clBuildProgram");
    snprintf(all, sizeof all, "%s %s", options, added_option);
    return real(program, count, devices, all, notify, data);
}

static device *dev;

static int open_device(void **state)
{
    (void)state;
    return device_open(&dev, -1) == STATUS_OK ? 0 : -1;
}

static int close_device(void **state)
{
    (void)state;
    device_free(dev);
    return 0;
}

static void one_device_is_the_default_and_the_default_is_opened(void **state)
{
    device_info *info = NULL;
    size_t count = 0, defaults = 0, chosen = 0;

    (void)state;
    assert_int_equal(device_list(&info, &count), STATUS_OK);
    for (size_t i = 0; i < count; i++) {
        assert_true(*info[i].name && *info[i].platform && info[i].compute_units > 0);
        if (info[i].is_default) chosen = i;
        defaults += info[i].is_default;
    }
    assert_int_equal(defaults, 1);
    assert_string_equal(device_describe(dev)->name, info[chosen].name);
    free(info);
}

static void an_index_past_the_last_names_those_there_are(void **state)
{
    device *none = NULL;

    (void)state;
    assert_int_equal(device_open(&none, 1000), STATUS_ARGUMENT);
    assert_non_null(strstr(status_message(), "device 1000: there are devices 0 to "));
    assert_null(none);
}

static void memory_gives_back_what_was_written(void **state)
{
    const uint initial[4] = {1, 2, 3, 4}, changed[2] = {7, 8};
    uint read[4] = {0};
    uint_buffer memory = {0};

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, 4, initial), STATUS_OK);
    assert_int_equal(device_upload(dev, memory, 2, changed), STATUS_OK);
    assert_int_equal(device_download(dev, memory, 4, read), STATUS_OK);
    assert_int_equal(read[0], 7);
    assert_int_equal(read[1], 8);
    assert_int_equal(read[2], 3);
    assert_int_equal(read[3], 4);
    device_release(memory);
}

static void arrays_of_no_elements_are_allowed(void **state)
{
    background_record_buffer background = {0};
    hit_record_buffer hit = {0};
    hit_record nothing;

    (void)state;
    assert_int_equal(device_allocate(dev, &background, 0, NULL), STATUS_OK);
    assert_int_equal(device_allocate(dev, &hit, 0, NULL), STATUS_OK);
    assert_non_null(hit.memory);
    assert_int_equal(device_upload(dev, hit, 0, &nothing), STATUS_OK);
    assert_int_equal(device_download(dev, hit, 0, &nothing), STATUS_OK);
    assert_int_equal(
        background_hit_run(dev, shape1(0),
                           &(background_hit_args){.background = background, .hit = hit}),
        STATUS_OK);
    device_release(hit);
    device_release(background);
    device_release((hit_record_buffer){0});
}

static void more_memory_than_there_is_is_told_apart_from_other_failures(void **state)
{
    uchar_buffer memory = {0};

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, SIZE_MAX / 4, NULL), STATUS_MEMORY);
    assert_non_null(strstr(status_message(), "no room for "));
    assert_null(memory.memory);
}

static void reading_past_the_end_fails_with_the_name_of_the_device(void **state)
{
    uchar_buffer memory = {0};
    uchar bytes[256];

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, 64, NULL), STATUS_OK);
    assert_int_equal(device_download(dev, memory, sizeof bytes, bytes), STATUS_DEVICE);
    assert_non_null(strstr(status_message(), device_describe(dev)->name));
    assert_non_null(strstr(status_message(), "CL_INVALID_VALUE"));
    device_release(memory);
}

/* 70 pixels: the launch is padded to a multiple of its local size. */
static void a_launch_reaches_every_item_and_none_past_the_end(void **state)
{
    enum { COUNT = 70, ROOM = 128 };
    background_record background[ROOM];
    hit_record hit[ROOM];
    background_record_buffer from = {0};
    hit_record_buffer to = {0};

    (void)state;
    memset(hit, 0, sizeof hit);
    memset(background, 0, sizeof background);
    for (uint i = 0; i < ROOM; i++) background[i].facet = i + 1;
    assert_int_equal(device_allocate(dev, &from, ROOM, background), STATUS_OK);
    assert_int_equal(device_allocate(dev, &to, ROOM, hit), STATUS_OK);
    assert_int_equal(
        background_hit_run(dev, shape1(COUNT),
                           &(background_hit_args){.count = COUNT, .background = from, .hit = to}),
        STATUS_OK);
    assert_int_equal(device_download(dev, to, ROOM, hit), STATUS_OK);
    for (uint i = 0; i < ROOM; i++) assert_int_equal(hit[i].facet, i < COUNT ? i + 1 : 0);
    device_release(from);
    device_release(to);
}

static void a_prepared_kernel_has_no_launches(void **state)
{
    const device_time *times = NULL;
    device *own = NULL;
    size_t kernels = 0;

    (void)state;
    assert_int_equal(device_open(&own, -1), STATUS_OK);
    assert_int_equal(device_prepare(own, KERNEL_BACKGROUND_HIT), STATUS_OK);
    assert_int_equal(device_times(own, &times, &kernels), STATUS_OK);
    assert_int_equal(kernels, KERNEL_COUNT);
    assert_int_equal(times[KERNEL_BACKGROUND_HIT].launches, 0);
    device_free(own);
}

static void launches_are_counted_and_timed(void **state)
{
    enum { TIMES = 1100 }; /* more than are kept as events */
    const device_time *times = NULL;
    background_record_buffer from = {0};
    hit_record_buffer to = {0};
    device *own = NULL;
    size_t kernels = 0;

    (void)state;
    assert_int_equal(device_open(&own, -1), STATUS_OK);
    assert_int_equal(device_allocate(own, &from, 1, NULL), STATUS_OK);
    assert_int_equal(device_allocate(own, &to, 1, NULL), STATUS_OK);
    for (int i = 0; i < TIMES; i++)
        assert_int_equal(
            background_hit_run(own, shape1(1),
                               &(background_hit_args){.count = 1, .background = from, .hit = to}),
            STATUS_OK);
    assert_int_equal(device_times(own, &times, &kernels), STATUS_OK);
    const device_time own_time = times[KERNEL_BACKGROUND_HIT];
    assert_string_equal(own_time.kernel, "background_hit");
    assert_int_equal(own_time.launches, TIMES);
    assert_true(own_time.seconds > 0.0);
    device_release(from);
    device_release(to);
    device_free(own);
}

static void a_buffer_that_is_left_out_is_named_and_nothing_is_launched(void **state)
{
    const device_time *times = NULL;
    background_record_buffer from = {0};
    device *own = NULL;
    size_t kernels = 0;

    (void)state;
    assert_int_equal(device_open(&own, -1), STATUS_OK);
    assert_int_equal(device_allocate(own, &from, 1, NULL), STATUS_OK);
    assert_int_equal(
        background_hit_run(own, shape1(1), &(background_hit_args){.count = 1, .background = from}),
        STATUS_DEVICE);
    assert_string_equal(status_message(), "kernel background_hit: argument hit is missing");
    assert_int_equal(device_times(own, &times, &kernels), STATUS_OK);
    assert_int_equal(times[KERNEL_BACKGROUND_HIT].launches, 0);
    device_release(from);
    device_free(own);
}

/* Without an order the points stand as they are; one without a facet is never lit. */
static void an_optional_buffer_may_be_left_out(void **state)
{
    const world_record world = {.ground_facet = RECORD_NONE};
    hit_record hit = {.facet = RECORD_NONE};
    uint read = 7;
    bvh_node_buffer nodes = {0};
    bvh_block_buffer blocks = {0};
    facet_record_buffer facets = {0};
    float_buffer sun = {0};
    hit_record_buffer hits = {0};
    uint_buffer lit = {0};

    (void)state;
    assert_int_equal(device_allocate(dev, &nodes, 0, NULL), STATUS_OK);
    assert_int_equal(device_allocate(dev, &blocks, 0, NULL), STATUS_OK);
    assert_int_equal(device_allocate(dev, &facets, 0, NULL), STATUS_OK);
    assert_int_equal(device_allocate(dev, &sun, 128, (float[128]){0}), STATUS_OK);
    assert_int_equal(device_allocate(dev, &hits, 1, &hit), STATUS_OK);
    assert_int_equal(device_allocate(dev, &lit, 1, &read), STATUS_OK);
    assert_int_equal(sun_history_run(dev, shape1(1),
                                     &(sun_history_args){.count = 1,
                                                         .day = {.word_count = 1, .stride = 1},
                                                         .tree = {world, nodes, blocks},
                                                         .facets = facets,
                                                         .sun = sun,
                                                         .hit = hits,
                                                         .lit = lit}),
                     STATUS_OK);
    assert_int_equal(device_download(dev, lit, 1, &read), STATUS_OK);
    assert_int_equal(read, 0);
    device_release(lit);
    device_release(hits);
    device_release(sun);
    device_release(facets);
    device_release(blocks);
    device_release(nodes);
}

static void a_failed_build_shows_its_log_with_file_and_line(void **state)
{
    (void)state;
    added_option = "-Dtowards=7";
    const status rc = device_prepare(dev, KERNEL_MIRROR);
    added_option = "";
    assert_int_equal(rc, STATUS_DEVICE);
    assert_non_null(strstr(status_message(), "kernel mirror does not build on "));
    assert_non_null(strstr(status_message(), "CL_BUILD_PROGRAM_FAILURE"));
    assert_non_null(strstr(status_message(), "error: "));
    assert_non_null(strstr(status_message(), "kernels/hemisphere/mirror.cl:"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_device_is_the_default_and_the_default_is_opened),
        cmocka_unit_test(an_index_past_the_last_names_those_there_are),
        cmocka_unit_test(memory_gives_back_what_was_written),
        cmocka_unit_test(arrays_of_no_elements_are_allowed),
        cmocka_unit_test(more_memory_than_there_is_is_told_apart_from_other_failures),
        cmocka_unit_test(reading_past_the_end_fails_with_the_name_of_the_device),
        cmocka_unit_test(a_launch_reaches_every_item_and_none_past_the_end),
        cmocka_unit_test(a_prepared_kernel_has_no_launches),
        cmocka_unit_test(launches_are_counted_and_timed),
        cmocka_unit_test(a_buffer_that_is_left_out_is_named_and_nothing_is_launched),
        cmocka_unit_test(an_optional_buffer_may_be_left_out),
        cmocka_unit_test(a_failed_build_shows_its_log_with_file_and_line),
    };

    return cmocka_run_group_tests(tests, open_device, close_device);
}
