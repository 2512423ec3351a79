#include "../assert_near.h"
#include "../scratch_folder.h"

#include "scene/scene.h"

static const char tiny[] =
    "name = \"tiny\"\n"
    "[site]\n"
    "latitude_deg = 40.5\n"
    "longitude_deg = -80\n"
    "time = 1992-06-21T13:20:00-04:00\n"
    "ground_material = \"grass\"\n"
    "[atmosphere]\n"
    "uniform = { sky_temperature_k = 260.0, sky_radiance_w_m2_sr_um = 0.0,"
    " sun_irradiance_w_m2_um = 0.0, transmission = 1, path_temperature_k = 1.0 }\n"
    "[[geometry]]\n"
    "file = \"tiny.obj\"\n"
    "[library]\n"
    "materials = \"tiny.mat\"\n"
    "[[material]]\n"
    "name = \"wall\"\n"
    "emissivity = 0.9\n"
    "temperature_k = 300\n"
    "[[material]]\n"
    "name = \"grass\"\n"
    "temperature_k = 290.0\n"
    "[camera]\n"
    "position_m = [0, -9, 60.5]\n"
    "target_m = [0, 0, 0]\n"
    "focal_length_mm = 85\n"
    "pixels = [16, 12]\n"
    "[[band]]\n"
    "name = \"lwir\"\n"
    "wavelength_um = [8.0, 14.0]\n"
    "[[band]]\n"
    "name = \"mwir\"\n"
    "wavelength_um = [3, 5]\n"
    "gain = 2.5\n"
    "offset = -1\n"
    "[render]\n"
    "thermal = \"fixed\"\n";

/* Level grass, the largest facet of it at z = 3 and not the last, and a wall. */
static const char mesh[] =
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 3\nv 5 0 3\nv 5 5 3\nv 0 5 3\n"
    "usemtl grass\nf 1 2 3 4\nf 5 6 7 8\nusemtl wall\nf 1 2 6 5\nusemtl grass\nf 2 3 4\n";
/* Appendix A item 10: specific heat, conductivity, density, specularity, emissivities, exposed area. */
static const char library[] = "2\nsteel\n41\n.1\n400\n7.8\n1.0\n.6\n.3\n.5\nflat.ems\nnull\n"
                              "grass\n4\n.5\n5\n1.0\n0.0\n.7\n.95\n-.3\nflat.ems\nnull\n";
/* Appendix A item 3: a face of material 41 at 20 C, whose name the library does not know. */
static const char faces[] =
    "OBJECT\nO\n1-0-0\nPART\nP\n1-1-0\nFACE\nF\n1-1-1\nrusty\n41\nroof\n20.0\n35.56\n0\n1.0\n"
    "null\nnull\nnull\n4\n0 0 0\n0 -9 0\n9 -9 0\n9 0 0\n0 0 -81\n180\n0\n0\n";

static void write_file(const char *name, const char *text)
{
    FILE *stream = fopen(scratch_path(name), "wb");

    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
}

static int write_files(void **state)
{
    FILE *stream;

    if (scratch_setup(state)) return -1;
    write_file("tiny.obj", mesh);
    write_file("tiny.mat", library);
    write_file("tiny.gdb", faces);
    stream = fopen(scratch_path("flat.ems"), "wb");
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++) {
        fprintf(stream, "%d\n", angle);
        for (int i = 0; i < WAVENUMBER_ROWS; i++)
            fprintf(stream, "%d .8\n", WAVENUMBER_ROWS_FIRST_CM1 - i * WAVENUMBER_ROWS_STEP_CM1);
    }
    return fclose(stream);
}

/* The scene with every `old` of a list of pairs, which ends with NULL, replaced by the text after. */
static const char *write_scene(const char *const *changes)
{
    static char text[8192], changed[8192];

    strcpy(text, tiny);
    for (; changes && *changes; changes += 2) {
        const char *at = strstr(text, changes[0]);
        assert_non_null(at);
        snprintf(changed, sizeof changed, "%.*s%s%s", (int)(at - text), text, changes[1],
                 at + strlen(changes[0]));
        strcpy(text, changed);
    }
    write_file("tiny.toml", text);
    return scratch_path("tiny.toml");
}

#define CHANGED(...) write_scene((const char *const[]){__VA_ARGS__, NULL})

static scene *read_scene(const char *path)
{
    scene *s = NULL;

    if (scene_read(&s, path, NULL, 0) != STATUS_OK) fail_msg("%s", status_message());
    status_warnings();
    return s;
}

/* Asserts that the scene is refused at a line, with those words. */
static void assert_refused(const char *path, int line, const char *words)
{
    char where[300];
    scene *s = NULL;

    snprintf(where, sizeof where, line ? "%s:%d: " : "%s: ", path, line);
    assert_int_equal(scene_read(&s, path, NULL, 0), STATUS_FORMAT);
    assert_null(s);
    if ((line && !strstr(status_message(), where)) || !strstr(status_message(), words))
        fail_msg("'%s', expected '%s' and '%s'", status_message(), where, words);
    status_clear();
}

static const scene_material *find_material(const scene *s, const char *name)
{
    for (uint32_t i = 0; i < s->material_count; i++)
        if (!strcmp(s->materials[i].name, name)) return &s->materials[i];
    fail_msg("no material %s", name);
    return NULL;
}

static void what_is_stated_is_read(void **state)
{
    (void)state;
    scene *s = read_scene(write_scene(NULL));

    assert_string_equal(s->name, "tiny");
    assert_near(s->place.latitude_deg, 40.5, 0.0);
    assert_near(s->place.longitude_deg, -80.0, 0.0);
    assert_int_equal(s->place.utc_offset_min, -240);
    assert_near(s->place.time_s, 709147200.0, 0.0); /* 1992-06-21T17:20Z by date -u */
    assert_near(s->camera.position_m[2], 60.5, 0.0);
    assert_near(s->camera.focal_length_mm, 85.0, 0.0);
    assert_int_equal(s->camera.columns, 16);
    assert_int_equal(s->camera.rows, 12);
    assert_int_equal(s->band_count, 2);
    assert_near(s->bands[0].high_um, 14.0, 0.0);
    assert_near(s->bands[1].gain, 2.5, 0.0);
    assert_near(s->bands[1].offset, -1.0, 0.0);
    assert_int_equal(s->thermal, SCENE_THERMAL_FIXED);
    assert_true(s->is_uniform);
    scene_free(s);
}

static void what_is_not_stated_has_its_default(void **state)
{
    (void)state;
    scene *s = read_scene(write_scene(NULL));

    assert_false(s->thesis);
    assert_near(s->hemisphere_zenith_step_deg, 15.0, 0.0);
    assert_near(s->hemisphere_azimuth_step_deg, 30.0, 0.0);
    assert_near(s->bands[0].gain, 1.0, 0.0);
    assert_near(s->bands[0].offset, 0.0, 0.0);
    assert_false(s->bands[0].is_mean);
    assert_near((double)find_material(s, "wall")->record.specular_share, 0.0, 0.0);
    assert_false(find_material(s, "wall")->two_sided);
    assert_null(s->history);
    scene_free(s);
}

static void a_material_of_the_library_has_its_properties_and_its_code(void **state)
{
    (void)state;
    scene *s = read_scene(write_scene(NULL));
    const scene_material *grass = find_material(s, "grass");

    assert_int_equal(grass->record.number, 4);
    assert_near((double)grass->record.density_kg_m3, 1000.0, 1e-3);
    assert_near((double)grass->record.solar_absorptance, .7, 1e-7);
    assert_near((double)grass->record.thermal_emissivity, .95, 1e-7);
    assert_near((double)grass->record.exposed_area, -.3, 1e-7);
    assert_non_null(grass->table);
    assert_int_equal(grass->record.emissivity_angles, EMISSIVITY_ANGLES);
    scene_free(s);
}

static void a_material_of_the_scene_alone_is_grey_and_numbered_past_the_library(void **state)
{
    (void)state;
    scene *s = read_scene(write_scene(NULL));
    const scene_material *wall = find_material(s, "wall");

    assert_int_equal(wall->record.number, 42); /* codes go up to 41, it is the first stated */
    assert_null(wall->table);
    assert_near(wall->grey_emissivity, .9, 0.0);
    assert_near((double)wall->record.solar_absorptance, .9, 1e-7);
    assert_int_equal(wall->record.emissivity_angles, 1);
    assert_int_equal(scene_emissivity_rows(s), 91 + 1 + 7); /* a table, a grey one, a lobe */
    scene_free(s);
}

static void a_material_is_counted_on_in_the_emissivity_table(void **state)
{
    uint32_t row = 0;

    (void)state;
    scene *s = read_scene(write_scene(NULL));
    for (uint32_t i = 0; i < s->material_count; i++) {
        assert_int_equal(s->materials[i].record.emissivity_first, row);
        row += s->materials[i].record.emissivity_angles;
    }
    scene_free(s);
}

static void the_scene_s_values_go_before_the_library_s(void **state)
{
    (void)state;
    scene *s = read_scene(CHANGED("name = \"grass\"\n", "name = \"grass\"\nemissivity = 0.5\n"
                                                        "density_kg_m3 = 700\n"));
    const scene_material *grass = find_material(s, "grass");

    assert_int_equal(grass->record.number, 4);
    assert_null(grass->table);
    assert_near(grass->grey_emissivity, .5, 0.0);
    assert_near((double)grass->record.thermal_emissivity, .5, 0.0);
    assert_near((double)grass->record.solar_absorptance, .5, 0.0); /* grey: the same in sunlight */
    assert_near((double)grass->record.density_kg_m3, 700.0, 0.0);
    assert_near((double)grass->record.exposed_area, -.3, 1e-7);
    scene_free(s);
}

static void a_gdb_s_material_goes_by_its_code(void **state)
{
    facet_record records[2];

    (void)state;
    scene *s = read_scene(CHANGED("\"tiny.obj\"", "\"tiny.gdb\""));
    assert_string_equal(s->materials[s->material_of[0]].name, "steel");
    assert_int_equal(s->materials[s->material_of[0]].record.number, 41);
    scene_facet_records(s, records);
    assert_near((double)records[0].stated_temperature_k, 293.15, 1e-4); /* its own 20 C */
    assert_near((double)records[0].thickness_m, .3556, 1e-6);
    scene_free(s);
}

static void a_facet_takes_the_temperature_of_its_material(void **state)
{
    facet_record records[5];

    (void)state;
    scene *s = read_scene(write_scene(NULL));
    scene_facet_records(s, records);
    assert_near((double)records[0].stated_temperature_k, 290.0, 0.0);
    assert_near((double)records[2].stated_temperature_k, 300.0, 0.0);
    assert_int_equal(records[2].material, s->material_of[s->shape->material[2]]);
    assert_near((double)records[2].normal[1], -1.0, 0.0);
    assert_near((double)records[2].azimuth_rad, M_PI, 1e-6);
    scene_free(s);
}

static void the_ground_goes_on_from_the_largest_level_facet_of_its_material(void **state)
{
    facet_record records[5];

    (void)state;
    scene *s = read_scene(write_scene(NULL));
    scene_facet_records(s, records);
    assert_near(s->ground_z_m, 3.0, 1e-6);
    assert_int_equal(records[4].material, s->ground_material);
    assert_near((double)records[4].stated_temperature_k, 290.0, 0.0);
    assert_near((double)records[4].normal[2], 1.0, 0.0);
    scene_free(s);
}

static void without_ground_material_there_is_no_ground(void **state)
{
    (void)state;
    scene *s = read_scene(CHANGED("ground_material = \"grass\"\n", ""));

    assert_int_equal(s->ground_material, RECORD_NONE);
    scene_free(s);
}

static void settings_go_before_the_file(void **state)
{
    const char *const settings[] = {"camera.focal_length_mm=50.5", "render.mode=thesis"};
    scene *s = NULL;

    (void)state;
    assert_int_equal(scene_read(&s, write_scene(NULL), settings, 2), STATUS_OK);
    assert_near(s->camera.focal_length_mm, 50.5, 0.0);
    assert_true(s->thesis);
    scene_free(s);
}

static void all_errors_are_told_at_once(void **state)
{
    char first[300], second[300], third[300];
    scene *s = NULL;

    (void)state;
    const char *path = CHANGED("latitude_deg = 40.5", "latitude_deg = 140", "focal_length_mm",
                               "focal_length", "\"tiny.mat\"", "\"no.mat\"");
    snprintf(first, sizeof first, "%s:3: site.latitude_deg: found 140, expected", path);
    snprintf(second, sizeof second, "%s:23: camera.focal_length: the unit is missing", path);
    snprintf(third, sizeof third, "%s:12: ", path);
    assert_int_equal(scene_read(&s, path, NULL, 0), STATUS_FORMAT);
    assert_null(s);
    if (!strstr(status_message(), first) || !strstr(status_message(), second) ||
        !strstr(status_message(), third) || !strstr(status_message(), "no.mat: No such file"))
        fail_msg("%s", status_message());
    status_clear();
}

static void what_a_render_would_lack_is_refused(void **state)
{
    (void)state;
    assert_refused(CHANGED("temperature_k = 300\n", ""), 0,
                   "tiny.obj: face 2 of material wall has no temperature");
    assert_refused(CHANGED("temperature_k = 290.0\n", ""), 0, "of material grass has no temp");
    assert_refused(CHANGED("thermal = \"fixed\"", "thermal = \"therm\""), 0,
                   "[weather]: the table is missing");
    assert_refused(CHANGED("thermal = \"fixed\"", "thermal = \"therm\""), 13,
                   "material wall: thermal = \"therm\" needs density_kg_m3");
}

static void a_material_that_nobody_knows_is_refused(void **state)
{
    (void)state;
    assert_refused(CHANGED("name = \"wall\"", "name = \"well\""), 12,
                   "tiny.obj: material \"wall\" is neither in the library nor a [[material]]");
    assert_refused(CHANGED("ground_material = \"grass\"", "ground_material = \"moss\""), 12,
                   "ground_material: material \"moss\"");
}

static void one_name_twice_is_refused(void **state)
{
    (void)state;
    assert_refused(CHANGED("name = \"grass\"", "name = \"wall\""), 17,
                   "two materials are named \"wall\"");
    assert_refused(CHANGED("name = \"mwir\"", "name = \"lwir\""), 28,
                   "two bands are named \"lwir\"");
}

/* What follows a render from the names: files, headers, channels. */
static void a_name_of_more_than_100_bytes_is_refused(void **state)
{
    char name[128];
    (void)state;

    for (int i = 0; i < 3; i++) {
        static const char *const old[] = {"tiny", "wall", "lwir"};
        static const int line[] = {1, 14, 26};
        char before[16];
        snprintf(before, sizeof before, "name = \"%s\"", old[i]);
        snprintf(name, sizeof name, "name = \"%0101d\"", 0);
        assert_refused(CHANGED(before, name), line[i], "of at most 100 bytes");
    }
    snprintf(name, sizeof name, "name = \"%0100d\"", 0);
    scene *s = read_scene(CHANGED("name = \"tiny\"", name, "name = \"lwir\"", name));
    assert_int_equal(strlen(s->name), 100);
    scene_free(s);
}

static void a_name_with_control_characters_is_refused(void **state)
{
    static const char *const codes[] = {"\\r", "\\n", "\\t", "\\u001B", "\\u007F"};
    char name[32];
    (void)state;

    for (size_t i = 0; i < sizeof codes / sizeof *codes; i++) {
        snprintf(name, sizeof name, "name = \"a%sb\"", codes[i]);
        assert_refused(CHANGED("name = \"tiny\"", name), 1, "without control characters");
        assert_refused(CHANGED("name = \"wall\"", name), 14, "without control characters");
        assert_refused(CHANGED("name = \"lwir\"", name), 26, "without control characters");
    }
    assert_refused(CHANGED("name = \"tiny\"", "name = \"a\\u0000b\""), 1,
                   "name: a text with a zero character");
}

static void only_the_named_bands_are_kept(void **state)
{
    (void)state;
    scene *s = read_scene(write_scene(NULL));

    assert_int_equal(scene_keep_bands(s, "mwir,none"), STATUS_ARGUMENT);
    assert_non_null(strstr(status_message(), "unknown band 'none'"));
    assert_int_equal(scene_keep_bands(s, "mwir"), STATUS_OK);
    assert_int_equal(s->band_count, 1);
    assert_string_equal(s->bands[0].name, "mwir");
    scene_free(s);
}

static void every_file_is_an_input_once(void **state)
{
    static const char *const names[] = {"tiny.obj", "tiny.mat", "flat.ems"};

    (void)state;
    scene *s = read_scene(CHANGED("[library]", "[[geometry]]\nfile = \"tiny.obj\"\n[library]"));
    assert_int_equal(s->input_count, 4);
    for (int i = 0; i < 3; i++) assert_string_equal(s->inputs[i + 1].name, names[i]);
    assert_int_equal(s->shape->object_count, 2);
    scene_free(s);
}

/* The walls state what they are; nothing gives the ground plane a temperature but the weather. */
static void a_ground_plane_without_weather_is_refused(void **state)
{
    (void)state;
    assert_refused(
        CHANGED("\"tiny.obj\"", "\"tiny.gdb\"", "thermal = \"fixed\"", "thermal = \"therm\""), 0,
        "[weather]: the table is missing");
}

static void a_band_too_many_is_refused(void **state)
{
    (void)state;
    assert_refused(
        CHANGED("wavelength_um = [8.0, 14.0]", "wavelength_um = [8.0, 14.0]\ncount = 4096"), 29,
        "more than 4096 bands");
}

static void whole_numbers_are_read_as_such(void **state)
{
    (void)state;
    assert_refused(CHANGED("pixels = [16, 12]", "pixels = [16, 12.5]"), 24,
                   "found [16, 12.5], expected whole numbers");
    assert_refused(
        CHANGED("wavelength_um = [8.0, 14.0]", "wavelength_um = [8.0, 14.0]\ncount = 2.5"), 28,
        "count: found 2.5, expected a whole number");
    assert_refused(CHANGED("[render]\n", "[weather]\nair_temperature_sunrise_c = 10\n"
                                         "air_temperature_peak_c = 20\npeak_time_h = 15\n"
                                         "relative_humidity_sunrise = 0.9\nwind_m_s = 2\n"
                                         "cloud_type = 2.7\n[render]\n"),
                   39, "cloud_type: found 2.7, expected a whole number");
}

/* The uniform sky is made over the bands that are right. */
static void a_wrong_band_is_told_once(void **state)
{
    scene *s = NULL;

    (void)state;
    assert_int_equal(scene_read(&s, CHANGED("[3, 5]", "[5, 3]"), NULL, 0), STATUS_FORMAT);
    if (!strstr(status_message(), ":30: ") || strchr(status_message(), '\n'))
        fail_msg("%s", status_message());
}

static void more_pixels_than_2_31_are_refused_whatever_states_them(void **state)
{
    static const char view_file[] = "0 0 0\n0 0 60\n90 0 0\n85\n65536 65537\n";

    (void)state;
    write_file("wide.adv", view_file);
    assert_refused(CHANGED("pixels = [16, 12]", "pixels = [65536, 65537]"), 24,
                   "found 65536 x 65537 pixels, expected at most 2147483647");
    assert_refused(CHANGED("pixels = [16, 12]", "pixels = [65536, 65537]\ncrop = [0, 0, 8, 8]"), 24,
                   "found 65536 x 65537 pixels");
    assert_refused(
        CHANGED("[camera]\n", "[camera]\nview = \"wide.adv\"\n", "pixels = [16, 12]\n", ""), 21,
        "found 65536 x 65537 pixels");
    assert_refused(CHANGED("pixels = [16, 12]", "pixels = [40000, 40000]", "[render]\n",
                           "[render]\nsamples_per_pixel = 4\n"),
                   24, "pixels of 4 samples, expected at most 4294967295");
    scene_free(read_scene(CHANGED("pixels = [16, 12]", "pixels = [46340, 46340]"))); /* below */
}

static void a_pixel_has_to_fit_on_a_device(void **state)
{
    (void)state;
    assert_refused(CHANGED("[render]\n",
                           "[render]\nsamples_per_pixel = 1024\n"
                           "hemisphere_step_deg = { zenith = 0.5, azimuth = 0.5 }\n",
                           "wavelength_um = [8.0, 14.0]",
                           "wavelength_um = [8.0, 14.0]\ncount = 200"),
                   0, "expected at most 512");
    assert_refused(
        CHANGED("[render]\n", "[render]\nhemisphere_step_deg = { zenith = 7, azimuth = 30 }\n"), 34,
        "zenith: found 7, expected a divisor of 90");
}

static void names_that_a_terminal_would_act_on_are_refused(void **state)
{
    (void)state;
    assert_refused(CHANGED("name = \"tiny\"", "name = \"ti\\u001bny\""), 1, "\"ti?ny\"");
    assert_refused(CHANGED("name = \"lwir\"", "name = \"lw\\rir\""), 26, "\"lw?ir\"");
    assert_refused(CHANGED("name = \"wall\"", "name = \"wa\\u007fll\""), 14, "\"wa?ll\"");
}

static void a_time_that_the_sun_is_not_known_for_is_told_at_its_line(void **state)
{
    (void)state;
    assert_refused(CHANGED("1992-06-21", "1599-06-21"), 5, "expected a time from 1600 to 9999");
}

static void a_failure_after_a_refused_scene_stands_alone(void **state)
{
    scene *s = NULL;

    (void)state;
    assert_int_equal(scene_read(&s, CHANGED("[3, 5]", "[5, 3]"), NULL, 0), STATUS_FORMAT);
    status_set(STATUS_FILE, "another");
    assert_string_equal(status_message(), "another");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(what_is_stated_is_read),
        cmocka_unit_test(what_is_not_stated_has_its_default),
        cmocka_unit_test(a_material_of_the_library_has_its_properties_and_its_code),
        cmocka_unit_test(a_material_of_the_scene_alone_is_grey_and_numbered_past_the_library),
        cmocka_unit_test(a_material_is_counted_on_in_the_emissivity_table),
        cmocka_unit_test(the_scene_s_values_go_before_the_library_s),
        cmocka_unit_test(a_gdb_s_material_goes_by_its_code),
        cmocka_unit_test(a_facet_takes_the_temperature_of_its_material),
        cmocka_unit_test(the_ground_goes_on_from_the_largest_level_facet_of_its_material),
        cmocka_unit_test(without_ground_material_there_is_no_ground),
        cmocka_unit_test(settings_go_before_the_file),
        cmocka_unit_test(all_errors_are_told_at_once),
        cmocka_unit_test(what_a_render_would_lack_is_refused),
        cmocka_unit_test(a_material_that_nobody_knows_is_refused),
        cmocka_unit_test(one_name_twice_is_refused),
        cmocka_unit_test(a_name_of_more_than_100_bytes_is_refused),
        cmocka_unit_test(a_name_with_control_characters_is_refused),
        cmocka_unit_test(only_the_named_bands_are_kept),
        cmocka_unit_test(every_file_is_an_input_once),
        cmocka_unit_test(a_ground_plane_without_weather_is_refused),
        cmocka_unit_test(a_band_too_many_is_refused),
        cmocka_unit_test(whole_numbers_are_read_as_such),
        cmocka_unit_test(a_wrong_band_is_told_once),
        cmocka_unit_test(more_pixels_than_2_31_are_refused_whatever_states_them),
        cmocka_unit_test(a_pixel_has_to_fit_on_a_device),
        cmocka_unit_test(names_that_a_terminal_would_act_on_are_refused),
        cmocka_unit_test(a_time_that_the_sun_is_not_known_for_is_told_at_its_line),
        cmocka_unit_test(a_failure_after_a_refused_scene_stands_alone),
    };

    return cmocka_run_group_tests(tests, write_files, scratch_teardown);
}
