/* Quick looks: sizes, colours, and the same bytes twice. */
#include "image/quick_look.h"

#include "../scratch_folder.h"
#include "../skip.h"
#include "base/interrupt.h"
#include "image/colour_map.h"

#include <sys/resource.h>

static const image_label material[] = {{1, "concrete"}, {22, "grass"}};

static quick_look look_of(const float *value, uint32_t columns, uint32_t rows)
{
    return (quick_look){.columns = columns,
                        .rows = rows,
                        .value = value,
                        .scene = "airport",
                        .time = "1987-06-24T15:00:00Z",
                        .plane = "temperature_c",
                        .unit = "C",
                        .colours = QUICK_LOOK_HEAT};
}

static void write_look(const char *name, const quick_look *look)
{
    output_folder *folder = NULL;

    assert_int_equal(output_folder_open(&folder, scratch), STATUS_OK);
    if (quick_look_write(folder, name, look) != STATUS_OK) fail_msg("%s", status_message());
    if (output_folder_commit(folder) != STATUS_OK) fail_msg("%s", status_message());
    output_folder_free(folder);
}

static uint32_t big_endian(const char *bytes)
{
    const unsigned char *b = (const unsigned char *)bytes;

    return (uint32_t)b[0] << 24 | (uint32_t)b[1] << 16 | (uint32_t)b[2] << 8 | b[3];
}

/* Width and height as the PNG's first chunk gives them (RFC 2083, 4.1.1). */
static void size_of(const char *name, uint32_t *out_width, uint32_t *out_height)
{
    size_t size;
    char *bytes = scratch_read(name, &size);

    assert_true(size > 24);
    assert_memory_equal(bytes, "\x89PNG\r\n\x1a\n", 8);
    *out_width = big_endian(bytes + 16);
    *out_height = big_endian(bytes + 20);
    free(bytes);
}

static void a_large_plane_is_drawn_pixel_by_pixel(void **state)
{
    static float value[512 * 300];
    uint32_t width, height;
    const quick_look look = look_of(value, 512, 300);
    (void)state;

    write_look("a.png", &look);

    size_of("a.png", &width, &height);
    assert_in_range(width, 512 + 40, 512 + 140); /* margins and the bar with its numbers */
    assert_in_range(height, 300 + 40, 300 + 90); /* margins and the title */
}

static void a_small_plane_is_enlarged_by_a_whole_factor(void **state)
{
    static float value[16 * 12];
    uint32_t width, height;
    const quick_look look = look_of(value, 16, 12);
    (void)state;

    write_look("a.png", &look);

    size_of("a.png", &width, &height);
    assert_in_range(width, 16 * 22 + 40, 16 * 22 + 140); /* 22 x 12 is the first above 256 */
    assert_in_range(height, 12 * 22 + 40, 12 * 22 + 90);
}

static void a_single_row_is_not_enlarged_beyond_4096(void **state)
{
    static float value[1000];
    uint32_t width, height;
    const quick_look look = look_of(value, 1000, 1);
    (void)state;

    write_look("a.png", &look);

    size_of("a.png", &width, &height);
    assert_in_range(width, 4000, 4096 + 140);
    assert_in_range(height, 100, 300); /* there is still place for the bar */
}

static void two_looks_at_one_plane_have_the_same_bytes(void **state)
{
    static float value[16 * 12];
    quick_look look = look_of(value, 16, 12);
    (void)state;

    for (int i = 0; i < 16 * 12; i++) value[i] = (float)i;
    write_look("a.png", &look);
    write_look("b.png", &look);

    scratch_assert_same("a.png", "b.png");
}

static void planes_without_values_or_with_strange_ones_are_drawn(void **state)
{
    const float value[] = {IMAGE_NO_DATA, IMAGE_NO_DATA, IMAGE_NO_DATA, IMAGE_NO_DATA};
    const float strange[] = {0.0f / 0.0f, 1e38f, -1e38f, 1.0f / 0.0f};
    quick_look look = look_of(value, 2, 2);
    (void)state;

    for (int colours = QUICK_LOOK_GREY; colours <= QUICK_LOOK_IDS; colours++) {
        look.colours = (quick_look_colours)colours;
        look.value = value;
        write_look("a.png", &look);
        look.value = strange;
        write_look("b.png", &look);
    }
}

static void a_legend_has_a_line_for_every_named_number(void **state)
{
    static float value[64 * 32];
    static image_label named[45];
    uint32_t width, height;
    quick_look look = look_of(value, 64, 32);
    (void)state;

    for (int i = 0; i < 45; i++) named[i] = (image_label){i, "material"};
    for (int i = 0; i < 64 * 32; i++) value[i] = (float)(i % 45);
    look.colours = QUICK_LOOK_LABELS;
    look.label = named;
    look.label_count = 45;
    write_look("a.png", &look);

    size_of("a.png", &width, &height);
    assert_in_range(height, 45 * 18, 45 * 18 + 90); /* lines of 18 pixels, heading and margins */
}

static void a_legend_with_more_than_twenty_unnamed_lines_ends(void **state)
{
    static float value[64 * 32];
    uint32_t width, height;
    quick_look look = look_of(value, 64, 32);
    (void)state;

    for (int i = 0; i < 64 * 32; i++) value[i] = (float)i;
    look.colours = QUICK_LOOK_LABELS;
    look.label = material;
    look.label_count = 2;
    write_look("a.png", &look);

    size_of("a.png", &width, &height);
    assert_true(height < 23 * 18 + 90); /* 2 named lines, 20 others and the end; not 2048 */
}

static void the_plane_chooses_the_colours(void **state)
{
    const image_plane plane[] = {{"facet", NULL, 0.0, 0.0, true},
                                 {"material", NULL, 0.0, 0.0, true},
                                 {"temperature_c", "C", 0.0, 0.0, false},
                                 {"radiance_lwir", "W m-2 sr-1", 10.65, 5.3, false},
                                 {"sunlit", NULL, 0.0, 0.0, false}};
    (void)state;

    assert_int_equal(quick_look_colours_of(&plane[0]), QUICK_LOOK_IDS);
    assert_int_equal(quick_look_colours_of(&plane[1]), QUICK_LOOK_LABELS);
    assert_int_equal(quick_look_colours_of(&plane[2]), QUICK_LOOK_HEAT);
    assert_int_equal(quick_look_colours_of(&plane[3]), QUICK_LOOK_GREY);
    assert_int_equal(quick_look_colours_of(&plane[4]), QUICK_LOOK_GREY);
}

static void diverging_runs_from_blue_over_white_to_red(void **state)
{
    (void)state;
    /* ColorBrewer's RdBu with 11 classes: 2166ac and b2182b near its ends, f7f7f7 in the middle. */
    static const struct {
        double fraction;
        uint8_t rgb[3];
    } known[] = {{0.0, {0x21, 0x66, 0xac}}, {0.5, {0xf7, 0xf7, 0xf7}}, {1.0, {0xb2, 0x18, 0x2b}}};
    uint8_t rgb[3];

    for (int i = 0; i < 3; i++) {
        colour_map_diverging(known[i].fraction, rgb);
        assert_memory_equal(rgb, known[i].rgb, 3);
    }
}

static void heat_has_the_colours_of_inferno(void **state)
{
    /* matplotlib 3.6.3, colormaps['inferno'].colors[i] * 255, rounded */
    static const struct {
        int i;
        uint8_t rgb[3];
    } inferno[] = {{0, {0, 0, 4}},       {37, {41, 11, 85}},   {100, {144, 37, 104}},
                   {155, {223, 83, 55}}, {203, {252, 163, 9}}, {255, {252, 255, 164}}};
    uint8_t rgb[3];
    (void)state;

    for (size_t n = 0; n < sizeof inferno / sizeof *inferno; n++) {
        colour_map_heat(inferno[n].i / 255.0, rgb);
        for (int c = 0; c < 3; c++)
            assert_in_range(rgb[c] + 2, inferno[n].rgb[c], inferno[n].rgb[c] + 4);
    }
}

static void the_first_22_categories_differ(void **state)
{
    uint8_t rgb[22][3];
    (void)state;

    for (uint32_t n = 0; n < 22; n++) {
        colour_map_category(n, rgb[n]);
        for (uint32_t m = 0; m < n; m++) {
            int distance = 0;
            for (int c = 0; c < 3; c++) distance += abs(rgb[n][c] - rgb[m][c]);
            assert_true(distance > 25); /* the closest of Kelly's are two yellows and oranges */
        }
    }
}

/* Of 48 MB of pixels a strip of 4 MiB is held; the values are zero pages, which need no memory. */
static void memory_does_not_grow_with_the_picture(void **state)
{
    (void)state;
#if defined __SANITIZE_ADDRESS__ || defined __SANITIZE_THREAD__
    SKIP_IF(true, "sanitizers take memory of their own");
#endif
    const uint32_t columns = 2000, rows = 8000;
    float *value = calloc((size_t)columns * rows, sizeof *value);
    const quick_look small = look_of(value, 300, 300), large = look_of(value, columns, rows);
    struct rusage before, after;

    assert_non_null(value);
    write_look("small.png", &small);
    getrusage(RUSAGE_SELF, &before);
    write_look("large.png", &large);
    getrusage(RUSAGE_SELF, &after);
    free(value);

    assert_true(after.ru_maxrss - before.ru_maxrss < 16 << 10); /* KiB */
}

static void an_interrupt_ends_a_picture(void **state)
{
    const atomic_int token = 1;
    static float value[16 * 12];
    const quick_look look = look_of(value, 16, 12);
    output_folder *folder = NULL;
    (void)state;

    assert_int_equal(output_folder_open(&folder, scratch), STATUS_OK);
    interrupt_obey(&token);
    assert_int_equal(quick_look_write(folder, "a.png", &look), STATUS_INTERRUPTED);
    interrupt_obey(NULL);
    output_folder_free(folder);
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_large_plane_is_drawn_pixel_by_pixel),
        TEST(a_small_plane_is_enlarged_by_a_whole_factor),
        TEST(a_single_row_is_not_enlarged_beyond_4096),
        TEST(two_looks_at_one_plane_have_the_same_bytes),
        TEST(planes_without_values_or_with_strange_ones_are_drawn),
        TEST(a_legend_has_a_line_for_every_named_number),
        TEST(a_legend_with_more_than_twenty_unnamed_lines_ends),
        TEST(the_plane_chooses_the_colours),
        TEST(heat_has_the_colours_of_inferno),
        TEST(diverging_runs_from_blue_over_white_to_red),
        TEST(the_first_22_categories_differ),
        TEST(memory_does_not_grow_with_the_picture),
        TEST(an_interrupt_ends_a_picture),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
