/* NAME.json. */
#include "render/render_report.h"

#include "../scratch_folder.h"

static void write_report(const render_report *report)
{
    output_folder *folder = NULL;

    assert_int_equal(output_folder_open(&folder, scratch), STATUS_OK);
    if (render_report_write(folder, "a.json", report) != STATUS_OK)
        fail_msg("%s", status_message());
    assert_int_equal(output_folder_commit(folder), STATUS_OK);
    output_folder_free(folder);
}

static const char ordered[] = "{\n"
                              "  \"program\": \"radsig " RADSIG_VERSION "\",\n"
                              "  \"scene\": \"airport\",\n"
                              "  \"scene_path\": \"scenes/airport/scene.toml\",\n"
                              "  \"mode\": \"exact\",\n"
                              "  \"thermal\": \"therm\",\n"
                              "  \"time\": \"1987-06-24T15:00:00Z\",\n"
                              "  \"site\": {\n"
                              "    \"latitude_deg\": 39.773333,\n"
                              "    \"longitude_deg\": -84.1,\n"
                              "    \"altitude_m\": 250\n"
                              "  },\n"
                              "  \"device\": {\n"
                              "    \"platform\": \"Portable Computing Language\",\n"
                              "    \"name\": \"cpu\",\n"
                              "    \"version\": \"OpenCL 3.0\"\n"
                              "  },\n"
                              "  \"image\": {\n"
                              "    \"columns\": 512,\n"
                              "    \"rows\": 384\n"
                              "  },\n"
                              "  \"bands\": [\n"
                              "    {\n"
                              "      \"name\": \"lwir\",\n"
                              "      \"wavelength_min_um\": 8,\n"
                              "      \"wavelength_max_um\": 13.3,\n"
                              "      \"gain\": 0.1,\n"
                              "      \"offset\": 0\n"
                              "    }\n"
                              "  ],\n"
                              "  \"planes\": [\n"
                              "    {\n"
                              "      \"name\": \"temperature_c\",\n"
                              "      \"unit\": \"C\"\n"
                              "    },\n"
                              "    {\n"
                              "      \"name\": \"material\",\n"
                              "      \"unit\": null\n"
                              "    }\n"
                              "  ],\n"
                              "  \"materials\": [\n"
                              "    {\n"
                              "      \"number\": 22,\n"
                              "      \"name\": \"grass\"\n"
                              "    }\n"
                              "  ],\n"
                              "  \"settings\": {\n"
                              "    \"seed\": 7,\n"
                              "    \"zenith\": \"cosine\"\n"
                              "  },\n"
                              "  \"inputs\": [\n"
                              "    {\n"
                              "      \"path\": \"summer.rad\",\n"
                              "      \"sha256\": \"00ff\",\n"
                              "      \"bytes\": 5000000000\n"
                              "    }\n"
                              "  ],\n"
                              "  \"warnings\": [\n"
                              "    \"one\",\n"
                              "    \"two\"\n"
                              "  ],\n"
                              "  \"timings_s\": {\n"
                              "    \"rays\": 0.25\n"
                              "  }\n"
                              "}\n";

static const render_report_band one_band = {"lwir", 8.0, 13.3, 0.1, 0.0};
static const image_plane one_plane[] = {{"temperature_c", "C", 0.0, 0.0, false},
                                        {"material", NULL, 0.0, 0.0, true}};
static const image_label one_material = {22, "grass"};
static const render_report_setting one_setting[] = {{"seed", NULL, 7.0}, {"zenith", "cosine", 0.0}};
static const render_report_input one_input = {"summer.rad", {"00ff", 5000000000u}};
static const render_report_stage one_stage = {"rays", 0.25};
static const render_report full_report = {.scene = "airport",
                                          .scene_path = "scenes/airport/scene.toml",
                                          .mode = "exact",
                                          .thermal = "therm",
                                          .time = "1987-06-24T15:00:00Z",
                                          .latitude_deg = 39.773333,
                                          .longitude_deg = -84.1,
                                          .altitude_m = 250.0,
                                          .platform = "Portable Computing Language",
                                          .device = "cpu",
                                          .device_version = "OpenCL 3.0",
                                          .columns = 512,
                                          .rows = 384,
                                          .band = &one_band,
                                          .band_count = 1,
                                          .plane = one_plane,
                                          .plane_count = 2,
                                          .material = &one_material,
                                          .material_count = 1,
                                          .setting = one_setting,
                                          .setting_count = 2,
                                          .input = &one_input,
                                          .input_count = 1,
                                          .warnings = "one\ntwo\n",
                                          .stage = &one_stage,
                                          .stage_count = 1};

static void a_report_has_its_members_in_their_order(void **state)
{
    (void)state;

    write_report(&full_report);

    scratch_assert_text("a.json", ordered);
}

static void assert_holds(const char *expected)
{
    char *text = scratch_read("a.json", NULL);

    if (!strstr(text, expected)) fail_msg("no %s in %s", expected, text);
    free(text);
}

static void strings_are_escaped(void **state)
{
    const render_report report = {
        .scene = "a\"b\\c\td", .mode = "caf\xc3\xa9", .thermal = "x\x01", .time = NULL};
    (void)state;

    write_report(&report);

    assert_holds("\"scene\": \"a\\\"b\\\\c\\td\"");
    assert_holds("\"mode\": \"caf\xc3\xa9\"");
    assert_holds("\"thermal\": \"x\\u0001\"");
    assert_holds("\"time\": null");
}

/* RFC 3629, 3: no overlong forms, no surrogates, nothing above U+10FFFF. */
static void what_is_not_utf_8_is_read_as_latin_1(void **state)
{
    static const struct {
        const char *bytes, *shown;
    } texts[] = {{"caf\xe9 1", "caf\xc3\xa9 1"},
                 {"s\xc0\x80x", "s\xc3\x80\xc2\x80x"},         /* overlong */
                 {"\xed\xa0\x80", "\xc3\xad\xc2\xa0\xc2\x80"}, /* a surrogate */
                 {"\xf4\x90\x80\x80", "\xc3\xb4\xc2\x90\xc2\x80\xc2\x80"},
                 {"\xc3", "\xc3\x83"}}; /* cut */
    (void)state;

    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++) {
        const render_report report = {.scene = texts[i].bytes};
        char expected[64];
        write_report(&report);
        snprintf(expected, sizeof expected, "\"scene\": \"%s\"", texts[i].shown);
        assert_holds(expected);
    }
}

static void numbers_read_back_exactly_and_others_are_null(void **state)
{
    const render_report_setting setting[] = {{"third", NULL, 1.0 / 3.0},
                                             {"tiny", NULL, 1e-300},
                                             {"seed", NULL, 4294967295.0},
                                             {"none", NULL, 0.0 / 0.0}};
    const render_report report = {.setting = setting, .setting_count = 4};
    (void)state;

    write_report(&report);

    assert_holds("\"third\": 0.3333333333333333,"); /* the shortest that is 1/3 in binary64 */
    assert_holds("\"tiny\": 1e-300");
    assert_holds("\"seed\": 4294967295,");
    assert_holds("\"none\": null");
}

static void empty_lists_close_at_once(void **state)
{
    const render_report report = {.scene = NULL};
    (void)state;

    write_report(&report);

    assert_holds("\"bands\": [],");
    assert_holds("\"settings\": {},");
    assert_holds("\"warnings\": [],");
}

#define TEST(name) cmocka_unit_test_setup_teardown(name, scratch_setup, scratch_teardown)

int main(void)
{
    const struct CMUnitTest tests[] = {
        TEST(a_report_has_its_members_in_their_order),
        TEST(strings_are_escaped),
        TEST(what_is_not_utf_8_is_read_as_latin_1),
        TEST(numbers_read_back_exactly_and_others_are_null),
        TEST(empty_lists_close_at_once),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
