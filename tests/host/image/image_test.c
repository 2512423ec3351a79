/* The ENVI and OpenEXR files of a render. */
#include "image/image.h"

#include "../scratch_folder.h"
#include "meshio/image_file.h"

#include <signal.h>
#include <sys/resource.h>

static const image_plane cube_plane[] = {{"radiance_mwir", "W m-2 sr-1", 4.0, 2.0, false},
                                         {"radiance_lwir", "W m-2 sr-1", 10.65, 5.3, false}};
static const image_plane truth_plane[] = {{"material", NULL, 0.0, 0.0, true},
                                          {"temperature_c", "C", 0.0, 0.0, false}};
static const image_label material[] = {{1, "concrete"}, {22, "grass, {fair}\n"}};
static const image_field field[] = {{"radsig materials", NULL, material, 2},
                                    {"radsig shape factor", "cosine", NULL, 0}};
static const image_header plain = {"airport, exact mode", "1987-06-24T15:00:00Z", NULL, 0};
static const image_header labelled = {"airport, {exact} mode", "1987-06-24T15:00:00Z", field, 2};

static output_folder *opened(void)
{
    output_folder *folder = NULL;

    assert_int_equal(output_folder_open(&folder, scratch_path("out")), STATUS_OK);
    return folder;
}

/* Three columns and two rows; a value is 100 x plane + 10 x row + column. */
static image *filled(output_folder *folder, const char *stem, const image_plane *plane,
                     size_t plane_count)
{
    image *img = NULL;

    if (image_create(&img, folder, stem, 3, 2, plane, plane_count) != STATUS_OK)
        fail_msg("%s", status_message());
    for (size_t p = 0; p < plane_count; p++)
        for (size_t i = 0; i < 6; i++)
            image_values(img, p)[i] = (float)(100 * p + 10 * (i / 3) + i % 3);
    return img;
}

static void commit(output_folder *folder)
{
    if (output_folder_commit(folder) != STATUS_OK) fail_msg("%s", status_message());
    output_folder_free(folder);
}

static void write_image(const image_plane *plane, size_t plane_count, const image_header *header)
{
    output_folder *folder = opened();
    image *img = filled(folder, "a", plane, plane_count);

    assert_int_equal(image_finish(img, header), STATUS_OK);
    image_free(img);
    commit(folder);
}

static void what_is_written_to_a_plane_stands_in_the_map(void **state)
{
    static const image_plane planes[2] = {{.name = "a"}, {.name = "b"}};
    static const float values[3] = {7.0f, 8.0f, 9.0f};

    (void)state;
    output_folder *folder = opened();
    image *img = filled(folder, "a", planes, 2);
    assert_int_equal(image_write(img, 1, 2, 3, values), STATUS_OK);
    const float expected[6] = {100.0f, 101.0f, 7.0f, 8.0f, 9.0f, 112.0f};
    assert_memory_equal(image_values(img, 1), expected, sizeof expected);
    image_free(img);
    output_folder_free(folder);
}

static void the_header_of_a_cube_has_wavelengths_and_its_unit(void **state)
{
    (void)state;
    write_image(cube_plane, 2, &plain);

    scratch_assert_text("out/a.hdr", "ENVI\n"
                                     "description = {airport, exact mode, radiance in W m-2 sr-1}\n"
                                     "samples = 3\n"
                                     "lines = 2\n"
                                     "bands = 2\n"
                                     "header offset = 0\n"
                                     "file type = ENVI Standard\n"
                                     "data type = 4\n"
                                     "interleave = bsq\n"
                                     "byte order = 0\n"
                                     "band names = {radiance_mwir, radiance_lwir}\n"
                                     "wavelength = {4, 10.65}\n"
                                     "wavelength units = Micrometers\n"
                                     "fwhm = {2, 5.3}\n"
                                     "data units = W m-2 sr-1\n"
                                     "data ignore value = -9999\n"
                                     "acquisition time = 1987-06-24T15:00:00Z\n");
}

static void the_header_of_truth_planes_has_units_in_the_names_and_no_stray_marks(void **state)
{
    (void)state;
    write_image(truth_plane, 2, &labelled);

    scratch_assert_text("out/a.hdr", "ENVI\n"
                                     "description = {airport, (exact) mode}\n"
                                     "samples = 3\n"
                                     "lines = 2\n"
                                     "bands = 2\n"
                                     "header offset = 0\n"
                                     "file type = ENVI Standard\n"
                                     "data type = 4\n"
                                     "interleave = bsq\n"
                                     "byte order = 0\n"
                                     "band names = {material, temperature_c [C]}\n"
                                     "data ignore value = -9999\n"
                                     "acquisition time = 1987-06-24T15:00:00Z\n"
                                     "radsig materials = {1 concrete, 22 grass; (fair) }\n"
                                     "radsig shape factor = cosine\n");
}

static void lines_of_a_long_list_stay_below_100_characters(void **state)
{
    image_plane plane[40];
    char *text;
    (void)state;

    for (size_t p = 0; p < 40; p++) plane[p] = truth_plane[1];
    write_image(plane, 40, &plain);

    text = scratch_read("out/a.hdr", NULL);
    for (char *line = strtok(text, "\n"); line; line = strtok(NULL, "\n"))
        assert_true(strlen(line) < 100);
    free(text);
}

static void values_lie_plane_after_plane_from_the_top_row_down(void **state)
{
    static const float expected[] = {0, 1, 2, 10, 11, 12, 100, 101, 102, 110, 111, 112};
    size_t size;
    char *bytes;
    (void)state;

    write_image(cube_plane, 2, &plain);

    bytes = scratch_read("out/a.img", &size);
    assert_int_equal(size, sizeof expected);
    assert_memory_equal(bytes, expected, sizeof expected);
    free(bytes);
    assert_int_equal(scratch_count("out"), 2);
}

static void an_image_without_a_commit_leaves_nothing(void **state)
{
    output_folder *folder = opened();
    image *img = filled(folder, "a", cube_plane, 2);
    (void)state;

    assert_int_equal(image_finish(img, &plain), STATUS_OK);
    image_free(img);
    output_folder_free(folder);

    assert_int_equal(scratch_count(""), 0);
}

static void a_disk_without_place_is_an_error_and_leaves_nothing(void **state)
{
    output_folder *folder = opened();
    image *img = NULL;
    struct rlimit old, small;
    (void)state;

    signal(SIGXFSZ, SIG_IGN);
    assert_int_equal(getrlimit(RLIMIT_FSIZE, &old), 0);
    small = old;
    small.rlim_cur = 100000;
    assert_int_equal(setrlimit(RLIMIT_FSIZE, &small), 0);
    const status rc = image_create(&img, folder, "a", 512, 512, cube_plane, 2);
    setrlimit(RLIMIT_FSIZE, &old);
    output_folder_free(folder);

    assert_int_equal(rc, STATUS_FILE);
    assert_non_null(strstr(status_message(), scratch_path("out/a.img")));
    assert_null(img);
    assert_int_equal(scratch_count(""), 0);
}

static void an_image_in_a_folder_that_takes_no_files_is_refused(void **state)
{
    output_folder *folder = NULL;
    image *img = NULL;
    status rc;
    (void)state;

    rc = output_folder_open(&folder, "/proc"); /* root may, a user may not */
    if (rc == STATUS_OK) rc = image_create(&img, folder, "a", 3, 2, cube_plane, 2);
    output_folder_free(folder);

    assert_int_equal(rc, STATUS_FILE);
    assert_non_null(strstr(status_message(), "/proc"));
}

static void an_image_without_pixels_is_refused(void **state)
{
    output_folder *folder = opened();
    image *img = NULL;
    (void)state;

    assert_int_equal(image_create(&img, folder, "a", 0, 2, cube_plane, 2), STATUS_ARGUMENT);
    output_folder_free(folder);
}

static void write_exr(const char *name)
{
    output_folder *folder = opened();
    const image_plane split = {"range.R", "m", 0.0, 0.0, false};
    image *cube = filled(folder, "a", cube_plane, 2), *truth = filled(folder, "b", &split, 1);
    image *const both[] = {cube, truth};

    if (image_write_exr(folder, name, both, 2, &labelled) != STATUS_OK)
        fail_msg("%s", status_message());
    assert_int_equal(image_finish(cube, &plain), STATUS_OK);
    assert_int_equal(image_finish(truth, &plain), STATUS_OK);
    image_free(cube);
    image_free(truth);
    commit(folder);
}

static void assert_channel(const char *name, const float *expected)
{
    char message[512] = "";
    uint32_t width = 0, height = 0;
    float *value = NULL;

    if (image_file_read_channel(&value, &width, &height, scratch_path("out/a.exr"), name, message,
                                sizeof message))
        fail_msg("%s", message);
    assert_int_equal(width, 3);
    assert_int_equal(height, 2);
    assert_memory_equal(value, expected, 6 * sizeof *value);
    free(value);
}

static void the_exr_holds_the_planes_of_both_images_by_name(void **state)
{
    (void)state;
    write_exr("a.exr");

    assert_channel("radiance_mwir", (float[]){0, 1, 2, 10, 11, 12});
    assert_channel("radiance_lwir", (float[]){100, 101, 102, 110, 111, 112});
    assert_channel("range.R", (float[]){0, 1, 2, 10, 11, 12}); /* R alone would be a colour */
}

static void
the_exr_of_a_hyperspectral_cube_has_a_picture_of_its_last_middle_and_first_plane(void **state)
{
    enum { COUNT = 17 };
    static const float up[6] = {0, 1.0f / 12, 2.0f / 12, 10.0f / 12, 11.0f / 12, 1};
    static const float down[6] = {1, 11.0f / 12, 10.0f / 12, 2.0f / 12, 1.0f / 12, 0};
    image_plane plane[COUNT];
    char name[COUNT][8];
    (void)state;

    for (int p = 0; p < COUNT; p++) {
        snprintf(name[p], sizeof name[p], "b%d", p);
        plane[p] = (image_plane){name[p], "W", 8.0 + 0.1 * p, 0.1, false};
    }
    output_folder *folder = opened();
    image *cube = filled(folder, "a", plane, COUNT);
    for (int i = 0; i < 6; i++) image_values(cube, COUNT - 1)[i] *= -1;
    if (image_write_exr(folder, "a.exr", &cube, 1, &labelled) != STATUS_OK)
        fail_msg("%s", status_message());
    assert_int_equal(image_finish(cube, &plain), STATUS_OK);
    image_free(cube);
    commit(folder);

    assert_channel("R", down);
    assert_channel("G", up);
    assert_channel("B", up);
}

static void two_exr_files_of_one_render_have_the_same_bytes(void **state)
{
    (void)state;
    write_exr("a.exr");
    write_exr("b.exr");

    scratch_assert_same("out/a.exr", "out/b.exr");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(what_is_written_to_a_plane_stands_in_the_map),
        TEST(the_header_of_a_cube_has_wavelengths_and_its_unit),
        TEST(the_header_of_truth_planes_has_units_in_the_names_and_no_stray_marks),
        TEST(lines_of_a_long_list_stay_below_100_characters),
        TEST(values_lie_plane_after_plane_from_the_top_row_down),
        TEST(an_image_without_a_commit_leaves_nothing),
        TEST(a_disk_without_place_is_an_error_and_leaves_nothing),
        TEST(an_image_in_a_folder_that_takes_no_files_is_refused),
        TEST(an_image_without_pixels_is_refused),
        TEST(the_exr_holds_the_planes_of_both_images_by_name),
        TEST(the_exr_of_a_hyperspectral_cube_has_a_picture_of_its_last_middle_and_first_plane),
        TEST(two_exr_files_of_one_render_have_the_same_bytes),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
