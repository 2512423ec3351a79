/* Images as they are written: exact values, names, the same bytes twice, and failing writes. */
#include "meshio/image_file.h"

#include "../skip.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

enum { WIDTH = 7, HEIGHT = 5, PIXELS = WIDTH * HEIGHT };

static char path[] = P_tmpdir "/radsig-image-XXXXXX", message[512];
static float temperature_c[PIXELS], radiance[PIXELS];
static const image_text text[] = {{"unit", "W m-2 sr-1"}, {"DateTime", "1987:06:24 15:00:00"}};
static const image_frame dated = {WIDTH, HEIGHT, text, 2, NULL},
                         undated = {WIDTH, HEIGHT, text, 1, NULL};
static const image_channel channel[] = {{"temperature_c", temperature_c, 0.0, 0.0},
                                        {"radiance_lwir", radiance, 0.0, 0.0}};

static const uint8_t *row_of(void *rgb, uint32_t y)
{
    return (uint8_t *)rgb + 3 * WIDTH * y;
}

/* Writes `count` channels, or a PNG where `from` is NULL, into a file; returns what the writer does. */
static int write_into(const char *to, const image_frame *frame, const image_channel *from,
                      size_t count, image_compression compression)
{
    uint8_t rgb[PIXELS * 3];
    FILE *file = fopen(to, "wb");

    assert_non_null(file);
    for (int i = 0; i < PIXELS * 3; i++) rgb[i] = (uint8_t)i;
    const int code =
        from ? image_file_write_exr(file, to, frame, from, count, compression, message,
                                    sizeof message)
             : image_file_write_png(file, to, frame, row_of, rgb, message, sizeof message);
    fclose(file);
    return code;
}

static void write_exr(const image_frame *frame, image_compression compression)
{
    if (write_into(path, frame, channel, 2, compression)) fail_msg("%s", message);
}

/* The bytes of the image written last; the caller frees them. */
static char *bytes_of_file(size_t *out_size)
{
    FILE *file = fopen(path, "rb");
    char *bytes = calloc(1, 65536);

    assert_non_null(file);
    assert_non_null(bytes);
    *out_size = fread(bytes, 1, 65535, file);
    assert_int_equal(fclose(file), 0);
    return bytes;
}

static int holds(const char *bytes, size_t size, const char *word)
{
    for (size_t i = 0; i + strlen(word) <= size; i++)
        if (!memcmp(bytes + i, word, strlen(word))) return 1;
    return 0;
}

static void the_channels_of_an_exr_come_back_exactly_by_name(void **state)
{
    const image_compression each[] = {IMAGE_NONE, IMAGE_ZIP};
    (void)state;

    for (int i = 0; i < 2; i++) {
        uint32_t width = 0, height = 0;
        float *value = NULL;
        write_exr(&dated, each[i]);
        assert_int_equal(image_file_read_channel(&value, &width, &height, path, "radiance_lwir",
                                                 message, sizeof message),
                         0);
        assert_int_equal(width, WIDTH);
        assert_int_equal(height, HEIGHT);
        assert_memory_equal(value, radiance, sizeof radiance);
        free(value);
    }
}

static void a_channel_that_is_not_there_is_refused(void **state)
{
    uint32_t width, height;
    float *value = NULL;
    (void)state;

    write_exr(&dated, IMAGE_NONE);
    assert_int_not_equal(
        image_file_read_channel(&value, &width, &height, path, "radiance", message, sizeof message),
        0);
    assert_null(value);
    assert_non_null(strstr(message, "no channel \"radiance\""));
}

/* A second passes between the two, so that a time of writing would show. */
static void the_same_image_gives_the_same_bytes_twice(void **state)
{
    const image_frame *each[] = {&dated, &undated};
    char *first[2], *second;
    size_t size[2], size_again;
    (void)state;

    for (int i = 0; i < 2; i++) {
        write_exr(each[i], IMAGE_ZIP);
        first[i] = bytes_of_file(&size[i]);
    }
    sleep(1);
    for (int i = 0; i < 2; i++) {
        write_exr(each[i], IMAGE_ZIP);
        second = bytes_of_file(&size_again);
        assert_int_equal(size[i], size_again);
        assert_memory_equal(first[i], second, size_again);
        free(second);
        free(first[i]);
    }
}

static void texts_and_the_stated_time_are_stored(void **state)
{
    size_t size;
    char *bytes;
    (void)state;

    write_exr(&dated, IMAGE_NONE);
    bytes = bytes_of_file(&size);
    assert_true(holds(bytes, size, "W m-2 sr-1"));
    assert_true(holds(bytes, size, "1987:06:24 15:00:00"));
    free(bytes);
}

/* Byte counts and field places of the PNG specification, 5.2 and 11.2.2. */
static void a_png_has_its_size_8_bit_rgb_and_texts(void **state)
{
    static const unsigned char begin[] = {0x89, 'P', 'N', 'G', 13, 10, 26, 10, 0, 0, 0, 13, 'I',
                                          'H',  'D', 'R', 0,   0,  0,  7,  0,  0, 0, 5, 8,  2};
    size_t size;
    char *bytes;
    (void)state;

    assert_int_equal(write_into(path, &undated, NULL, 0, IMAGE_NONE), 0);
    bytes = bytes_of_file(&size);
    assert_memory_equal(bytes, begin, sizeof begin);
    assert_true(holds(bytes, size, "tEXtunit"));
    assert_true(holds(bytes, size, "W m-2 sr-1"));
    free(bytes);
}

static void a_full_disk_is_told(void **state)
{
    (void)state;

    SKIP_IF(access("/dev/full", W_OK), "there is no /dev/full");
    assert_int_not_equal(write_into("/dev/full", &dated, channel, 2, IMAGE_NONE), 0);
    assert_string_equal(message, "/dev/full: No space left on device");
    assert_int_not_equal(write_into("/dev/full", &dated, NULL, 0, IMAGE_NONE), 0);
    assert_string_equal(message, "/dev/full: No space left on device");
}

static void an_image_without_channels_or_with_one_name_twice_is_refused(void **state)
{
    const image_channel twice[] = {{"a", radiance, 0.0, 0.0}, {"a", radiance, 0.0, 0.0}};
    (void)state;

    assert_int_not_equal(write_into(path, &dated, twice, 0, IMAGE_NONE), 0);
    assert_non_null(strstr(message, "7 x 5 pixels and 0 channels"));
    assert_int_not_equal(write_into(path, &dated, twice, 2, IMAGE_NONE), 0);
    assert_non_null(strstr(message, "two channels \"a\""));
}

static int make_file(void **state)
{
    const int file = mkstemp(path);
    (void)state;

    for (int i = 0; i < PIXELS; i++) {
        temperature_c[i] = 20.0f + 0.1f * (float)i;
        radiance[i] = 1.0f / (float)(i + 1);
    }
    radiance[3] = -9999.0f;
    radiance[4] = 3.0e38f;
    return file < 0 || close(file);
}

static int remove_file(void **state)
{
    (void)state;
    return remove(path);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_channels_of_an_exr_come_back_exactly_by_name),
        cmocka_unit_test(a_channel_that_is_not_there_is_refused),
        cmocka_unit_test(the_same_image_gives_the_same_bytes_twice),
        cmocka_unit_test(texts_and_the_stated_time_are_stored),
        cmocka_unit_test(a_png_has_its_size_8_bit_rgb_and_texts),
        cmocka_unit_test(a_full_disk_is_told),
        cmocka_unit_test(an_image_without_channels_or_with_one_name_twice_is_refused),
    };

    return cmocka_run_group_tests(tests, make_file, remove_file);
}
