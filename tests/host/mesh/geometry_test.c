#include "../assert_near.h"
#include "../scratch_folder.h"

#include "mesh/geometry.h"

#include <time.h>

#define DEGREE (M_PI / 180.0)

/* The box 0..1 x 0..2 x 0..3, six quads that run counterclockwise seen from outside: bottom, top,
 * south, north, west, east. */
static const char box[] = "v 0 0 0\nv 1 0 0\nv 1 2 0\nv 0 2 0\nv 0 0 3\nv 1 0 3\nv 1 2 3\nv 0 2 3\n"
                          "o box\ng walls\nusemtl wall\n"
                          "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 3 4 8 7\nf 4 1 5 8\nf 2 3 7 6\n";
static const char pentagon[] = "v 0 0 0\nv 2 0 0\nv 2 2 0\nv 1 3 0\nv 0 2 0\nv 0 0 1\n"
                               "usemtl roof\nf 1 2 3 4 5\nf 1 2 6\n";

static const char *write_file(const char *name, const char *text)
{
    FILE *stream = fopen(scratch_path(name), "wb");

    assert_non_null(stream);
    fputs(text, stream);
    fclose(stream);
    return scratch_path(name);
}

/* Reads one file, as stated by `how` but for its path. */
static geometry *read_one(const char *text, geometry_instance how)
{
    geometry *g = NULL;

    how.path = write_file("one.obj", text);
    if (how.scale == 0.0) how.scale = 1.0;
    if (geometry_read(&g, &how, 1) != STATUS_OK) fail_msg("%s", status_message());
    return g;
}

static status read_refused(const char *name, const char *text)
{
    const geometry_instance instance = {.path = write_file(name, text), .scale = 1.0};
    geometry *g = NULL;
    const status rc = geometry_read(&g, &instance, 1);

    assert_null(g);
    return rc;
}

static void assert_position(const geometry *g, uint32_t vertex, double x, double y, double z)
{
    const double expected[3] = {x, y, z};

    for (int k = 0; k < 3; k++) /* float, within 10 m of the origin */
        assert_near((double)g->position[vertex][k] + g->origin_m[k], expected[k], 2e-6);
}

static void a_box_has_its_areas_slopes_and_azimuths(void **state)
{
    static const double area[6] = {2, 2, 3, 3, 6, 6}, slope[6] = {180, 0, 90, 90, 90, 90};
    static const double azimuth[6] = {0, 0, 180, 0, 270, 90};

    (void)state;
    geometry *g = read_one(box, (geometry_instance){0});
    assert_int_equal(g->facet_count, 6);
    for (uint32_t i = 0; i < 6; i++) {
        assert_near((double)g->area_m2[i], area[i], 1e-6);
        assert_near((double)g->slope_rad[i] / DEGREE, slope[i], 1e-5);
        assert_near((double)g->azimuth_rad[i] / DEGREE, azimuth[i], 2e-5);
        assert_int_equal(g->facet_id[i], i);
    }
    assert_near((double)g->normal[4][0], -1.0, 0.0);
    geometry_free(g);
}

/* Every edge of a cube belongs to two faces: four neighbours each, all but itself and its opposite. */
static void every_side_of_a_box_has_the_four_others_beside_it(void **state)
{
    (void)state;
    geometry *g = read_one(box, (geometry_instance){0});
    for (int32_t i = 0; i < 6; i++) {
        unsigned seen = 1u << i | 1u << (i ^ 1);
        for (int k = 0; k < 4; k++) {
            assert_in_range(g->neighbour[i][k], 0, 5);
            seen |= 1u << g->neighbour[i][k];
        }
        assert_int_equal(seen, 63);
    }
    /* The first edge of the south side, 1-2, is the bottom's. */
    assert_int_equal(g->neighbour[2][0], 0);
    geometry_free(g);
}

static void a_vertex_is_scaled_then_moved(void **state)
{
    (void)state;
    geometry *g = read_one(box, (geometry_instance){.scale = 2.0, .translate_m = {10, 20, 30}});
    assert_position(g, 6, 12, 24, 36);
    geometry_free(g);
}

static void rotations_are_right_handed(void **state)
{
    (void)state;
    geometry *g = read_one(box, (geometry_instance){.rotate_deg = {90, 0, 0}});
    assert_position(g, 6, 1, -3, 2); /* y to z, z to -y */
    geometry_free(g);
    g = read_one(box, (geometry_instance){.rotate_deg = {0, 90, 0}});
    assert_position(g, 6, 3, 2, -1); /* z to x, x to -z */
    geometry_free(g);
    g = read_one(box, (geometry_instance){.rotate_deg = {0, 0, 90}});
    assert_position(g, 6, -2, 1, 3); /* x to y, y to -x */
    geometry_free(g);
}

static void rotations_go_about_x_then_y_then_z_before_the_translation(void **state)
{
    (void)state;
    geometry *g =
        read_one(box, (geometry_instance){.rotate_deg = {90, 90, 90}, .translate_m = {100, 0, 0}});
    /* (1, 2, 3) -> (1, -3, 2) -> (2, -3, -1) -> (3, 2, -1) */
    assert_position(g, 6, 103, 2, -1);
    geometry_free(g);
    g = read_one(box, (geometry_instance){.rotate_deg = {0, 0, 30}});
    assert_position(g, 1, sqrt(.75), .5, 0);
    assert_near((double)g->azimuth_rad[5] / DEGREE, 60.0, 2e-5); /* east turned towards north */
    geometry_free(g);
}

static void a_polygon_s_triangles_share_its_id(void **state)
{
    (void)state;
    geometry *g = read_one(pentagon, (geometry_instance){0});
    double area = 0.0;

    assert_int_equal(g->facet_count, 4);
    for (uint32_t i = 0; i < 3; i++) {
        assert_int_equal(g->facet_id[i], 0);
        assert_int_equal(g->corner[i][3], UINT32_MAX);
        assert_near((double)g->normal[i][2], 1.0, 0.0);
        area += (double)g->area_m2[i];
    }
    assert_near(area, 5.0, 1e-6);
    assert_int_equal(g->facet_id[3], 1);
    geometry_free(g);
}

static void ids_count_on_over_the_files(void **state)
{
    char paths[2][256];
    geometry *g = NULL;

    (void)state;
    snprintf(paths[0], sizeof paths[0], "%s", write_file("a.obj", pentagon));
    snprintf(paths[1], sizeof paths[1], "%s", write_file("b.obj", box));
    const geometry_instance both[] = {{.path = paths[0], .scale = 1.0},
                                      {.path = paths[1], .scale = 1.0, .translate_m = {50, 0, 0}}};
    assert_int_equal(geometry_read(&g, both, 2), STATUS_OK);
    assert_int_equal(g->facet_count, 4 + 6);
    for (uint32_t i = 0; i < 6; i++) assert_int_equal(g->facet_id[4 + i], 2 + i);
    assert_string_equal(g->materials[g->material[0]].name, "roof");
    assert_string_equal(g->materials[g->material[9]].name, "wall");
    assert_string_equal(g->materials[g->material[9]].path, paths[1]);
    assert_string_equal(g->object_name[g->part_object[g->part[9]]], "box");
    assert_string_equal(g->part_name[g->part[9]], "walls");
    geometry_free(g);
}

static void one_file_twice_makes_two_objects(void **state)
{
    char path[256];
    geometry *g = NULL;

    (void)state;
    snprintf(path, sizeof path, "%s", write_file("a.obj", box));
    const geometry_instance twice[] = {{.path = path, .scale = 1.0},
                                       {.path = path, .scale = 1.0, .translate_m = {9, 0, 0}}};
    assert_int_equal(geometry_read(&g, twice, 2), STATUS_OK);
    assert_int_equal(g->object_count, 2);
    assert_int_equal(g->material_count, 1);
    assert_int_equal(g->duplicate_count, 0);
    geometry_free(g);
}

static void coordinates_of_a_map_keep_their_millimetres(void **state)
{
    (void)state;
    geometry *g = read_one("v 433123.001 4402123 250\nv 433123.004 4402123 250\n"
                           "v 433123.001 4402123.002 250\nusemtl a\nf 1 2 3\n",
                           (geometry_instance){0});
    assert_near((double)g->area_m2[0], 3e-6, 1e-10); /* half of 3 mm by 2 mm; double at 4e6 m */
    assert_near((double)(g->position[1][0] - g->position[0][0]), .003, 1e-9);
    geometry_free(g);
}

static void facets_that_no_ray_meets_are_counted(void **state)
{
    (void)state;
    geometry *g = read_one("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 2 0 0\nv nan 0 0\nv 0 0 1\nv 0 0 -1\n"
                           "v 0 -1 0\nusemtl a\n"
                           "f 1 2 3\nf 2 3 1\n"  /* the same once more */
                           "f 1 2 4\n"           /* no area */
                           "f 1 5 3\n"           /* not a number */
                           "f 1 2 6\nf 1 2 7\n", /* three facets at one edge */
                           (geometry_instance){0});

    assert_int_equal(g->facet_count, 6);
    assert_int_equal(g->duplicate_count, 1);
    assert_int_equal(g->degenerate_count, 1);
    assert_int_equal(g->non_finite_count, 1);
    assert_true(g->non_manifold_count > 0);
    geometry_free(g);
}

static void a_face_without_material_is_an_error(void **state)
{
    (void)state;
    assert_int_equal(read_refused("bare.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n"),
                     STATUS_FORMAT);
    assert_non_null(strstr(status_message(), "bare.obj: face 0 names no material; state"));
    status_clear();
}

static void an_instance_states_what_its_file_does_not(void **state)
{
    (void)state;
    geometry *g =
        read_one("v 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\nf 1 2 3\nusemtl own\nf 1 2 4\n",
                 (geometry_instance){.material = "stated", .thickness_m = .25, .power_w_m2 = -7.0});
    assert_string_equal(g->materials[g->material[0]].name, "stated");
    assert_string_equal(g->materials[g->material[1]].name, "own");
    assert_near((double)g->thickness_m[1], .25, 0.0);
    assert_near((double)g->power_w_m2[0], -7.0, 0.0);
    assert_near((double)g->stated_temperature_k[0], 0.0, 0.0);
    geometry_free(g);
}

static void a_vertex_that_is_moved_beyond_1e9_m_is_an_error(void **state)
{
    const char *path = write_file("far.obj", "v 0 0 0\nv 1e6 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n");
    const geometry_instance beyond[] = {
        {.path = path, .scale = 1e4},
        {.path = path, .scale = 1e3, .translate_m = {1.0, 0.0, 0.0}},
        {.path = path, .scale = 1e4, .rotate_deg = {0.0, 0.0, 30.0}}};

    (void)state;
    for (int i = 0; i < 3; i++) {
        geometry *g = NULL;
        assert_int_equal(geometry_read(&g, &beyond[i], 1), STATUS_FORMAT);
        assert_null(g);
        assert_non_null(strstr(status_message(), "far.obj: vertex 1 comes to ("));
        status_clear();
    }
}

static char *many_parts(uint32_t count, const char *keyword)
{
    char *text = malloc(64 + 32 * (size_t)count), *end = text;

    assert_non_null(text);
    end += sprintf(end, "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\n");
    for (uint32_t i = 0; i < count; i++) end += sprintf(end, "%s n%u\nf 1 2 3\n", keyword, i);
    return text;
}

/* Looking at one name after the other took 50,000 objects 11 s. */
static void a_hundred_thousand_names_are_read_within_seconds(void **state)
{
    enum { NAMES = 100000 };
    static const char *const keyword[] = {"o", "g", "usemtl"};

    (void)state;
    for (int i = 0; i < 3; i++) {
        char *text = many_parts(NAMES, keyword[i]);
        const clock_t begin = clock();
        geometry *g = read_one(text, (geometry_instance){0});
        assert_true(clock() - begin < 5 * CLOCKS_PER_SEC);
        assert_int_equal(g->object_count, i == 0 ? NAMES : 1);
        assert_int_equal(g->part_count, i == 2 ? 1 : NAMES);
        assert_int_equal(g->material_count, i == 2 ? NAMES : 1);
        assert_string_equal(g->part_name[g->part[NAMES - 1]], i == 1 ? "n99999" : "part");
        geometry_free(g);
        free(text);
    }
}

static void a_name_that_comes_again_is_the_same_part(void **state)
{
    (void)state;
    geometry *g = read_one("v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\no one\ng p\nf 1 2 3\n"
                           "o two\ng p\nf 1 2 3\no one\ng p\nusemtl b\nf 1 2 3\n",
                           (geometry_instance){0});

    assert_int_equal(g->object_count, 2);
    assert_int_equal(g->part_count, 2);
    assert_int_equal(g->part[2], g->part[0]);
    assert_int_not_equal(g->part[1], g->part[0]);
    assert_int_equal(g->material[2], 1);
    geometry_free(g);
}

static void every_bad_file_is_told(void **state)
{
    char paths[3][256];
    geometry *g = NULL;

    (void)state;
    snprintf(paths[0], sizeof paths[0], "%s",
             write_file("one.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 9\n"));
    snprintf(paths[1], sizeof paths[1], "%s", write_file("good.obj", box));
    snprintf(paths[2], sizeof paths[2], "%s", write_file("two.off", "OFF\n3 1 0\n0 0 0\n"));
    const geometry_instance all[] = {{.path = paths[0], .scale = 1.0},
                                     {.path = paths[1], .scale = 1.0},
                                     {.path = paths[2], .scale = 1.0}};
    assert_int_equal(geometry_read(&g, all, 3), STATUS_FORMAT);
    assert_null(g);
    assert_non_null(strstr(status_message(), "one.obj:5: "));
    assert_non_null(strstr(status_message(), "two.off:"));
    assert_null(strstr(status_message(), "good.obj"));
    status_clear();
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_box_has_its_areas_slopes_and_azimuths),
        cmocka_unit_test(every_side_of_a_box_has_the_four_others_beside_it),
        cmocka_unit_test(a_vertex_is_scaled_then_moved),
        cmocka_unit_test(rotations_are_right_handed),
        cmocka_unit_test(rotations_go_about_x_then_y_then_z_before_the_translation),
        cmocka_unit_test(a_polygon_s_triangles_share_its_id),
        cmocka_unit_test(ids_count_on_over_the_files),
        cmocka_unit_test(one_file_twice_makes_two_objects),
        cmocka_unit_test(coordinates_of_a_map_keep_their_millimetres),
        cmocka_unit_test(facets_that_no_ray_meets_are_counted),
        cmocka_unit_test(a_face_without_material_is_an_error),
        cmocka_unit_test(an_instance_states_what_its_file_does_not),
        cmocka_unit_test(a_vertex_that_is_moved_beyond_1e9_m_is_an_error),
        cmocka_unit_test(a_hundred_thousand_names_are_read_within_seconds),
        cmocka_unit_test(a_name_that_comes_again_is_the_same_part),
        cmocka_unit_test(every_bad_file_is_told),
    };

    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
