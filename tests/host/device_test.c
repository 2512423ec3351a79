/* RTLD_NEXT */
#define _GNU_SOURCE
#define CL_TARGET_OPENCL_VERSION 120
#include "device.h"

#include <setjmp.h>
#include <stdarg.h>

#include <cmocka.h>

#include "../kernels/records.h"

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
    const int initial[4] = {1, 2, 3, 4}, changed[2] = {-7, -8};
    int read[4] = {0};
    device_memory memory = NULL;

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, sizeof initial, initial), STATUS_OK);
    assert_int_equal(device_upload(dev, memory, sizeof(int), sizeof changed, changed), STATUS_OK);
    assert_int_equal(device_download(dev, memory, 0, sizeof read, read), STATUS_OK);
    assert_int_equal(read[0], 1);
    assert_int_equal(read[1], -7);
    assert_int_equal(read[2], -8);
    assert_int_equal(read[3], 4);
    device_release(memory);
}

static void arrays_of_no_bytes_are_allowed(void **state)
{
    device_memory memory = NULL;
    int nothing;
    const uint count = 0;

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, 0, NULL), STATUS_OK);
    assert_non_null(memory);
    assert_int_equal(device_upload(dev, memory, 0, 0, &nothing), STATUS_OK);
    assert_int_equal(device_download(dev, memory, 0, 0, &nothing), STATUS_OK);
    assert_int_equal(
        device_run(dev, "background_hit", shape1(0), ARG(count), ARG(memory), ARG(memory)),
        STATUS_OK);
    device_release(memory);
    device_release(NULL);
}

static void more_memory_than_there_is_is_told_apart_from_other_failures(void **state)
{
    device_memory memory = NULL;

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, SIZE_MAX / 4, NULL), STATUS_MEMORY);
    assert_non_null(strstr(status_message(), "no room for "));
    assert_null(memory);
}

static void reading_past_the_end_fails_with_the_name_of_the_device(void **state)
{
    device_memory memory = NULL;
    char bytes[256];

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, 64, NULL), STATUS_OK);
    assert_int_equal(device_download(dev, memory, 0, sizeof bytes, bytes), STATUS_DEVICE);
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
    const uint count = COUNT;
    device_memory from = NULL, to = NULL;

    (void)state;
    memset(hit, 0, sizeof hit);
    memset(background, 0, sizeof background);
    for (uint i = 0; i < ROOM; i++) background[i].facet = i + 1;
    assert_int_equal(device_allocate(dev, &from, sizeof background, background), STATUS_OK);
    assert_int_equal(device_allocate(dev, &to, sizeof hit, hit), STATUS_OK);
    assert_int_equal(
        device_run(dev, "background_hit", shape1(COUNT), ARG(count), ARG(from), ARG(to)),
        STATUS_OK);
    assert_int_equal(device_download(dev, to, 0, sizeof hit, hit), STATUS_OK);
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
    assert_int_equal(device_prepare(own, "background_hit"), STATUS_OK);
    assert_int_equal(device_times(own, &times, &kernels), STATUS_OK);
    assert_int_equal(kernels, 1);
    assert_int_equal(times[0].launches, 0);
    device_free(own);
}

static void launches_are_counted_and_timed(void **state)
{
    enum { TIMES = 1100 }; /* more than are kept as events */
    const uint count = 1;
    const device_time *times = NULL;
    device_memory from = NULL, to = NULL;
    device *own = NULL;
    size_t kernels = 0;

    (void)state;
    assert_int_equal(device_open(&own, -1), STATUS_OK);
    assert_int_equal(device_allocate(own, &from, sizeof(background_record), NULL), STATUS_OK);
    assert_int_equal(device_allocate(own, &to, sizeof(hit_record), NULL), STATUS_OK);
    for (int i = 0; i < TIMES; i++)
        assert_int_equal(
            device_run(own, "background_hit", shape1(1), ARG(count), ARG(from), ARG(to)),
            STATUS_OK);
    assert_int_equal(device_times(own, &times, &kernels), STATUS_OK);
    assert_int_equal(kernels, 1);
    assert_string_equal(times[0].kernel, "background_hit");
    assert_int_equal(times[0].launches, TIMES);
    assert_true(times[0].seconds > 0.0);
    device_release(from);
    device_release(to);
    device_free(own);
}

static void a_wrong_number_of_arguments_is_counted_out(void **state)
{
    const uint count = 1;

    (void)state;
    assert_int_equal(device_run(dev, "background_hit", shape1(1), ARG(count)), STATUS_DEVICE);
    assert_string_equal(status_message(), "kernel background_hit takes 3 arguments, not 1");
}

static void a_wrong_argument_is_told_by_its_place(void **state)
{
    device_memory memory = NULL;
    const double wide = 1.0;

    (void)state;
    assert_int_equal(device_allocate(dev, &memory, 64, NULL), STATUS_OK);
    assert_int_equal(
        device_run(dev, "background_hit", shape1(1), ARG(wide), ARG(memory), ARG(memory)),
        STATUS_DEVICE);
    assert_non_null(strstr(status_message(), "kernel background_hit on "));
    assert_non_null(strstr(status_message(), "argument 0: CL_INVALID_ARG_SIZE"));
    device_release(memory);
}

static void a_kernel_that_is_not_there_is_named(void **state)
{
    const uint count = 1;

    (void)state;
    assert_int_equal(device_run(dev, "no_such", shape1(1), ARG(count)), STATUS_DEVICE);
    assert_non_null(strstr(status_message(), "kernels/no_such.cl"));
}

static void a_failed_build_shows_its_log_with_file_and_line(void **state)
{
    const uint count = 1;

    (void)state;
    added_option = "-Dtowards=7";
    const status rc = device_run(dev, "mirror", shape1(1), ARG(count));
    added_option = "";
    assert_int_equal(rc, STATUS_DEVICE);
    assert_non_null(strstr(status_message(), "kernel mirror does not build on "));
    assert_non_null(strstr(status_message(), "CL_BUILD_PROGRAM_FAILURE"));
    assert_non_null(strstr(status_message(), "error: "));
    assert_non_null(strstr(status_message(), "kernels/mirror.cl:"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(one_device_is_the_default_and_the_default_is_opened),
        cmocka_unit_test(an_index_past_the_last_names_those_there_are),
        cmocka_unit_test(memory_gives_back_what_was_written),
        cmocka_unit_test(arrays_of_no_bytes_are_allowed),
        cmocka_unit_test(more_memory_than_there_is_is_told_apart_from_other_failures),
        cmocka_unit_test(reading_past_the_end_fails_with_the_name_of_the_device),
        cmocka_unit_test(a_launch_reaches_every_item_and_none_past_the_end),
        cmocka_unit_test(a_prepared_kernel_has_no_launches),
        cmocka_unit_test(launches_are_counted_and_timed),
        cmocka_unit_test(a_wrong_number_of_arguments_is_counted_out),
        cmocka_unit_test(a_wrong_argument_is_told_by_its_place),
        cmocka_unit_test(a_kernel_that_is_not_there_is_named),
        cmocka_unit_test(a_failed_build_shows_its_log_with_file_and_line),
    };

    return cmocka_run_group_tests(tests, open_device, close_device);
}
