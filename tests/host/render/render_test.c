#include "../assert_near.h"
#include "../scratch_folder.h"

#include "render/render.h"
#include "sky/planck.h"

/* Format: the sky's radiance, the sun, transmission, geometry file, materials, camera's position and
 * target, further bands, render's keys. */
static const char scene_text[] =
    "name = \"small\"\n[site]\nlatitude_deg = 40\nlongitude_deg = -80\n"
    "time = 1992-06-21T13:20:00-04:00\n[atmosphere]\nuniform = { sky_temperature_k = 260.0, "
    "sky_radiance_w_m2_sr_um = %s, sun_irradiance_w_m2_um = %s, transmission = %s, "
    "path_temperature_k = 280.0 }\n[[geometry]]\nfile = \"%s\"\n%s"
    "[camera]\nposition_m = %s\ntarget_m = %s\nfocal_length_mm = 24\npixels = [100, 60]\n"
    "[[band]]\nname = \"lwir\"\nwavelength_um = [8.0, 14.0]\n"
    "%s[render]\nthermal = \"fixed\"\n%s";

static const char mwir_band[] = "[[band]]\nname = \"mwir\"\nwavelength_um = [3.0, 5.0]\n";

enum { COLUMNS = 100, ROWS = 60, PIXELS = COLUMNS * ROWS, PLANE_LIMIT = 64 };

/* A closed box of 10 m around the origin, seen from both sides. */
static const char box[] =
    "v -5 -5 -5\nv 5 -5 -5\nv 5 5 -5\nv -5 5 -5\nv -5 -5 5\nv 5 -5 5\nv 5 5 5\nv -5 5 5\n"
    "usemtl wall\nf 1 2 3 4\nf 5 8 7 6\nf 1 5 6 2\nf 3 7 8 4\nf 4 8 5 1\nf 2 6 7 3\n";
/* A floor, a wall in the sun, a mirror that leans back, a triangle in the air, an upright mirror. */
static const char yard[] =
    "v -20 -20 0\nv 20 -20 0\nv 20 20 0\nv -20 20 0\nv -8 4 0\nv 8 4 0\nv 8 4 6\nv -8 4 6\n"
    "v -3 -2 0.5\nv 3 -2 0.5\nv 3 1 4\nv -3 1 4\nv 5 -5 3\nv 9 -5 4\nv 7 -3 7\n"
    "v -12 0 0\nv -9 0 0\nv -9 0 4\nv -12 0 4\n"
    "usemtl floor\nf 1 2 3 4\nusemtl wall\nf 5 6 7 8\nusemtl glass\nf 9 10 11 12\n"
    "usemtl wall\nf 13 14 15\nusemtl glass\nf 16 17 18 19\n";
static const char yard_materials[] =
    "[[material]]\nname = \"floor\"\nemissivity = 0.9\ntemperature_k = 310\n"
    "[[material]]\nname = \"wall\"\nemissivity = 0.7\ntemperature_k = 295\n"
    "[[material]]\nname = \"glass\"\nemissivity = 0.3\nspecular_share = 1\ntemperature_k = 300\n";

static device *dev;

static int open_all(void **state)
{
    if (scratch_setup(state) || device_open(&dev, -1) != STATUS_OK) return -1;
    FILE *stream = fopen(scratch_path("box.obj"), "wb");
    fputs(box, stream);
    fclose(stream);
    stream = fopen(scratch_path("yard.obj"), "wb");
    fputs(yard, stream);
    return fclose(stream);
}

static int close_all(void **state)
{
    device_free(dev);
    return scratch_teardown(state);
}

static scene *read_scene(void)
{
    scene *s = NULL;

    if (scene_read(&s, scratch_path("scene.toml"), NULL, 0) != STATUS_OK)
        fail_msg("%s", status_message());
    status_warnings();
    return s;
}

/* The inside of the box, at 300 K. */
static scene *read_box(const char *grey, const char *mode, const char *further_band)
{
    char materials[128], settings[64];
    FILE *stream = fopen(scratch_path("scene.toml"), "wb");

    snprintf(materials, sizeof materials,
             "[[material]]\nname = \"wall\"\nemissivity = %s\ntemperature_k = 300\n", grey);
    snprintf(settings, sizeof settings, "mode = \"%s\"\n", mode);
    fprintf(stream, scene_text, "0.0", "9.0", "1.0", "box.obj", materials, "[1, -4, 2]",
            "[0, 5, 0]", further_band, settings);
    fclose(stream);
    return read_scene();
}

static scene *read_yard(void)
{
    FILE *stream = fopen(scratch_path("scene.toml"), "wb");

    fprintf(stream, scene_text, "0.2", "30.0", "0.8", "yard.obj", yard_materials, "[4, -25, 9]",
            "[0, 0, 3]", mwir_band, "hemisphere_step_deg = { zenith = 30, azimuth = 60 }\n");
    fclose(stream);
    return read_scene();
}

/* All planes one after the other; the caller frees them.
 *   tile   pixels that are computed at once */
static float *render_all(const scene *s, uint32_t tile, size_t *out_planes)
{
    float *values = calloc(PLANE_LIMIT, PIXELS * sizeof *values), *planes[PLANE_LIMIT];
    render *r = NULL;

    assert_non_null(values);
    if (render_open(&r, s, dev) != STATUS_OK) fail_msg("%s", status_message());
    render_planes(r, out_planes);
    assert_in_range(*out_planes, 1, PLANE_LIMIT);
    for (size_t i = 0; i < *out_planes; i++) planes[i] = values + i * PIXELS;
    const uint32_t pixels = (uint32_t)(s->camera.columns * s->camera.rows);
    for (uint32_t first = 0; first < pixels; first += tile) {
        const uint32_t left = pixels - first;
        if (render_tile(r, first, left < tile ? left : tile, planes, NULL) != STATUS_OK)
            fail_msg("%s", status_message());
    }
    render_free(r);
    return values;
}

/* The values of one plane; the caller frees them. */
static float *render_plane_of(const scene *s, const char *name)
{
    float *values = calloc(PIXELS, sizeof *values), *planes[PLANE_LIMIT] = {0};
    const render_plane *list;
    render *r = NULL;
    size_t count, found = 0;

    assert_non_null(values);
    if (render_open(&r, s, dev) != STATUS_OK) fail_msg("%s", status_message());
    list = render_planes(r, &count);
    for (size_t i = 0; i < count; i++)
        if (!strcmp(list[i].name, name)) planes[i] = values, found++;
    assert_int_equal(found, 1);
    if (render_tile(r, 0, PIXELS, planes, NULL) != STATUS_OK) fail_msg("%s", status_message());
    render_free(r);
    return values;
}

static void assert_plane(const scene *s, const char *name, double expected, double tolerance)
{
    float *values = render_plane_of(s, name);

    for (int i = 0; i < PIXELS; i++)
        if (!(fabs((double)values[i] - expected) <= tolerance))
            fail_msg("%s: %.9g at pixel %d, expected %.9g", name, (double)values[i], i, expected);
    free(values);
}

/* Radiance in band of a black body at 300 K, midpoints in wavelength. */
static double black_body(double low_um, double high_um, bool thesis)
{
    const int steps = 20000;
    const double step = (high_um - low_um) / steps;
    double sum = 0.0;

    for (int i = 0; i < steps; i++)
        sum += step * planck_spectral(planck_at(low_um + (i + .5) * step, thesis), 300.0);
    return sum;
}

static void assert_tiles_change_nothing(uint32_t samples_per_side)
{
    static const uint32_t tiles[] = {1000, 4096, 777};
    size_t count, again;
    scene *s = read_yard();

    s->samples_per_side = samples_per_side;
    float *whole = render_all(s, 65536, &count);
    for (size_t t = 0; t < sizeof tiles / sizeof *tiles; t++) {
        float *cut = render_all(s, tiles[t], &again);
        assert_int_equal(again, count);
        assert_memory_equal(cut, whole, count * PIXELS * sizeof *whole);
        free(cut);
    }
    free(whole);
    scene_free(s);
}

static void planes_are_the_same_bits_for_tiles_of_any_size(void **state)
{
    (void)state;
    assert_tiles_change_nothing(1);
}

static void planes_of_several_samples_are_the_same_bits_for_tiles_of_any_size(void **state)
{
    (void)state;
    assert_tiles_change_nothing(2);
}

/* 180 rings of 720 directions, a word each, of 64 pixels: 33.2 MB, and 32 MiB are 33.6. */
static void tiles_keep_to_32_mib_whatever_the_steps_of_the_hemisphere(void **state)
{
    const uint32_t cells = 180 * 720;
    size_t count, again;
    render *r = NULL;
    scene *s = read_yard();

    (void)state;
    s->camera.columns = 6;
    s->camera.rows = 3;
    s->hemisphere_zenith_step_deg = s->hemisphere_azimuth_step_deg = .5;
    if (render_open(&r, s, dev) != STATUS_OK) fail_msg("%s", status_message());
    assert_in_range((size_t)render_tile_limit(r) * cells * sizeof(float), 1, 1 << 25);
    render_free(r);
    float *whole = render_all(s, 18, &count), *cut = render_all(s, 5, &again);
    assert_memory_equal(cut, whole, count * PIXELS * sizeof *whole);
    free(cut);
    free(whole);
    scene_free(s);
}

/* So that the test before compares more than one kind of pixel. */
static void the_yard_has_pixels_of_every_kind(void **state)
{
    unsigned seen = 0;

    (void)state;
    scene *s = read_yard();
    float *interaction = render_plane_of(s, "interaction");
    for (int i = 0; i < PIXELS; i++) seen |= 1u << (int)interaction[i];
    assert_int_equal(seen, 15);
    free(interaction);
    scene_free(s);
}

static void a_plane_that_is_not_wanted_is_not_needed(void **state)
{
    size_t count;

    (void)state;
    scene *s = read_yard();
    float *whole = render_all(s, PIXELS, &count), *range = render_plane_of(s, "range_m");
    render *r = NULL;
    size_t index = 0;
    assert_int_equal(render_open(&r, s, dev), STATUS_OK);
    while (strcmp(render_planes(r, &count)[index].name, "range_m")) index++;
    assert_memory_equal(range, whole + index * PIXELS, PIXELS * sizeof *range);
    render_free(r);
    free(range);
    free(whole);
    scene_free(s);
}

static void radiances_come_first_and_carry_their_band(void **state)
{
    size_t count;
    render *r = NULL;

    (void)state;
    scene *s = read_yard();
    assert_int_equal(render_open(&r, s, dev), STATUS_OK);
    const render_plane *planes = render_planes(r, &count);
    assert_string_equal(planes[0].name, "radiance_lwir");
    assert_string_equal(planes[0].plane.unit, "W m-2 sr-1");
    assert_near(planes[0].plane.wavelength_um, 11.0, 1e-4); /* trapezoids of 2 cm-1 */
    assert_near(planes[0].plane.fwhm_um, 6.0, 1e-9);
    assert_string_equal(planes[1].name, "radiance_mwir");
    for (size_t i = 0; i < count; i++) assert_int_equal(planes[i].is_radiance, i < 2);
    render_free(r);
    scene_free(s);
}

/* Sums of 300 float32 samples; trapezoids of 2 cm-1 are good to 1e-6. */
static const double SUMS = 5e-6;

static void a_black_box_is_a_black_body(void **state)
{
    (void)state;
    scene *s = read_box("1.0", "exact", mwir_band);
    const double lwir = black_body(8.0, 14.0, false), mwir = black_body(3.0, 5.0, false);

    assert_plane(s, "radiance_lwir", lwir, SUMS * lwir);
    assert_plane(s, "radiance_mwir", mwir, SUMS * mwir);
    /* The table of temperatures costs 0.001 K, a radiance off by SUMS 0.0005 K. */
    assert_plane(s, "apparent_temperature_lwir_c", 26.85, .002);
    assert_plane(s, "apparent_temperature_mwir_c", 26.85, .002);
    scene_free(s);
}

static void a_black_box_is_seen_as_what_it_is(void **state)
{
    (void)state;
    scene *s = read_box("1.0", "exact", "");
    const double celsius = 2e-5; /* float32 at 300 K */

    assert_plane(s, "interaction", 1.0, 0.0);
    assert_plane(s, "shape_factor", 0.0, 0.0);
    assert_plane(s, "sunlit", 0.0, 0.0);
    assert_plane(s, "background_sunlit", 0.0, 0.0);
    assert_plane(s, "temperature_c", 26.85, celsius);
    assert_plane(s, "background_temperature_c", 26.85, celsius);
    assert_plane(s, "material", 1.0, 0.0);
    assert_plane(s, "background_material", 1.0, 0.0);
    assert_plane(s, "emissivity_lwir", 1.0, 1e-6);
    assert_plane(s, "background_emissivity_lwir", 1.0, 1e-6);
    scene_free(s);
}

/* Exact mode takes what its background sees for black at the background's temperature. */
static void a_grey_box_in_exact_mode_is_a_black_body(void **state)
{
    (void)state;
    scene *s = read_box("0.5", "exact", mwir_band);
    const double lwir = black_body(8.0, 14.0, false), mwir = black_body(3.0, 5.0, false);

    assert_plane(s, "radiance_lwir", lwir, SUMS * lwir);
    assert_plane(s, "radiance_mwir", mwir, SUMS * mwir);
    scene_free(s);
}

/* eq. 2.4-2 knows one bounce: what is missing from a closed box at one temperature is what its
 * background does not emit, L = e B + (1 - e) e_B B with e_B = e. Thesis mode sums over the database's
 * points in the band; with this band alone the database begins and ends with it. */
static void a_box_in_thesis_mode_lacks_what_its_background_reflects(void **state)
{
    static const char *const texts[] = {"1.0", "0.9", "0.5", "0.2"};
    static const double emissivities[] = {1.0, .9, .5, .2};

    (void)state;
    for (int i = 0; i < 4; i++) {
        scene *s = read_box(texts[i], "thesis", "");
        const double e = emissivities[i];
        const double expected = (e + (1.0 - e) * e) * black_body(8.0, 14.0, true);
        assert_plane(s, "radiance_lwir", expected, SUMS * expected);
        scene_free(s);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(planes_are_the_same_bits_for_tiles_of_any_size),
        cmocka_unit_test(tiles_keep_to_32_mib_whatever_the_steps_of_the_hemisphere),
        cmocka_unit_test(planes_of_several_samples_are_the_same_bits_for_tiles_of_any_size),
        cmocka_unit_test(the_yard_has_pixels_of_every_kind),
        cmocka_unit_test(a_plane_that_is_not_wanted_is_not_needed),
        cmocka_unit_test(radiances_come_first_and_carry_their_band),
        cmocka_unit_test(a_black_box_is_a_black_body),
        cmocka_unit_test(a_black_box_is_seen_as_what_it_is),
        cmocka_unit_test(a_grey_box_in_exact_mode_is_a_black_body),
        cmocka_unit_test(a_box_in_thesis_mode_lacks_what_its_background_reflects),
    };

    return cmocka_run_group_tests(tests, open_all, close_all);
}
