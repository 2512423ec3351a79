#include "../assert_near.h"
#include "../text_file.h"

#include "mesh/geometry_file.h"

/* Thesis Appendix A item 3. The dots between RUNWAY_2 and GRASS_4 are left out: an object and a part
 * for the grass stand instead. */
static const char printed[] =
    "OBJECT\nRUNWAY2_OBJ\n1-0-0\nPART\nRUNWAY2_ATTS\n1-1-0\n"
    "FACE\nRUNWAY2_RUNWAY_1\n1-1-1\nconcrete/roadway\n22\nrunway\n-1\n35.56\n0\n1.0\n"
    "null\nnull\nnull\n4\n"
    "6.000000e+01 -3.000000e+01 -1.000000e+00\n"
    "6.000000e+01 -6.000000e+01 -1.000000e+00\n"
    "3.600000e+02 -6.000000e+01 -1.000000e+00\n"
    "3.600000e+02 -3.000000e+01 -1.000000e+00\n"
    "-0.00000000000000000000e+00 -0.00000000000000000000e+00 -8.999999999999999450000e+03\n"
    "1.800000e+02\n0.000000e+00\n0.000000e+00\n"
    "FACE\nRUNWAY2_RUNWAY_2\n1-1-2\nconcrete/roadway\n22\nrunway\n-1\n35.56\n0\n1.0\n"
    "null\nnull\nnull\n4\n"
    "6.000000e+01 -3.000000e+01 -5.000000e-01\n"
    "6.000000e+01 -3.000000e+01 -1.000000e+00\n"
    "3.600000e+02 -3.000000e+01 -1.000000e+00\n"
    "3.600000e+02 -3.000000e+01 -5.000000e-01\n"
    "-0.000000000000000000e+00 1.499999999999999940000e+02 -0.000000000000000000e+00\n"
    "9.000000e+01\n2.700000e+02\n2.500000e-01\n"
    "OBJECT\nGRASS_OBJ\n24-0-0\nPART\nGRASS_ATTS\n24-1-0\n"
    "FACE\nGRASS_4\n24-1-4\nsummergrass\n4\ngrass\n-1\n.91\n-3.5\n1.0\nnull\nnull\nnull\n4\n"
    "1.200000e+03 -8.500000e+02 -1.000000e+00\n"
    "1.200000e+03 -8.500000e+02 -6.000000e+00\n"
    "-1.300000e+03 -8.500000e+02 -6.000000e+00\n"
    "-1.300000e+03 -8.500000e+02 -1.000000e+00\n"
    "-0.000000000000000000e+00 -1.249999999999999960000e+04 -0.000000000000000000e+00\n"
    "9.000000e+01\n9.000000e+01\n2.500000e-01\n"
    "FACE\nGRASS_5\n24-1-5\nsummergrass\n4\ngrass\n-1\n.91\n-3.5\n1.0\nnull\nnull\nnull\n4\n"
    "-1.300000e+03 -8.500000e+02 -1.000000e+00\n"
    "-1.300000e+03 -8.500000e+02 -6.000000e+00\n"
    "-1.300000e+03 2.150000e+03 -6.000000e+00\n"
    "-1.300000e+03 2.150000e+03 -1.000000e+00\n"
    "-1.499999999999999960000e+04 -0.000000000000000000e+00 -0.000000000000000000e+00\n"
    "9.000000e+01\n1.800000e+02\n2.500000e-01\n";

static int forget_warnings(void **state)
{
    (void)state;
    status_warnings();
    return 0;
}

static geometry_file *read_geometry(const char *path)
{
    geometry_file *g = NULL;

    if (geometry_file_read(&g, path) != STATUS_OK) fail_msg("%s", status_message());
    return g;
}

/* Right-hand normal of a facet's first three vertices; as long as the area of a rectangle. */
static void right_hand(const geometry_file *g, int facet, double out[3])
{
    const double *p = &g->position_m[3 * (size_t)g->facets[facet].first_vertex];
    const double a[3] = {p[3] - p[0], p[4] - p[1], p[5] - p[2]};
    const double b[3] = {p[6] - p[3], p[7] - p[4], p[8] - p[5]};

    out[0] = a[1] * b[2] - a[2] * b[1];
    out[1] = a[2] * b[0] - a[0] * b[2];
    out[2] = a[0] * b[1] - a[1] * b[0];
}

static void the_printed_hierarchy_is_read(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file(printed));

    assert_int_equal(g->object_count, 2);
    assert_int_equal(g->part_count, 2);
    assert_int_equal(g->facet_count, 4);
    assert_int_equal(g->vertex_count, 16);
    assert_string_equal(g->objects[1].name, "GRASS_OBJ");
    assert_int_equal(g->objects[1].id[0], 24);
    assert_string_equal(g->parts[1].name, "GRASS_ATTS");
    assert_int_equal(g->parts[1].object, 1);
    assert_string_equal(g->facets[1].name, "RUNWAY2_RUNWAY_2");
    assert_int_equal(g->facets[1].id[2], 2);
    assert_int_equal(g->facets[1].part, 0);
    assert_int_equal(g->facets[3].part, 1);
    geometry_file_free(g);
}

static void the_printed_attributes_turn_to_si(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file(printed));
    const geometry_facet *grass = &g->facets[2];

    assert_string_equal(grass->material_name, "summergrass");
    assert_int_equal(grass->material_code, 4);
    assert_string_equal(grass->attribute, "grass");
    assert_near(grass->stated_temperature_k, 0.0, 0.0);  /* -1: to be computed */
    assert_near(grass->thickness_m, 0.0091, 1e-15);      /* double */
    assert_near(grass->power_w_m2, -3.5 * 11.622, 1e-3); /* notes/thermal: 1 ly/h, five digits */
    assert_near(grass->shape_factor, 1.0, 0.0);
    assert_string_equal(grass->unused[2], "null");
    assert_near(grass->slope_deg, 90.0, 0.0);
    assert_near(grass->azimuth_deg, 90.0, 0.0);
    assert_near(grass->last_number, 0.25, 0.0);
    geometry_file_free(g);
}

static void a_stated_temperature_is_in_celsius(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file_with(printed, "\n-1\n", "\n20.5\n"));

    assert_near(g->facets[0].stated_temperature_k, 293.65, 1e-4); /* 273.15 is a float */
    geometry_file_free(g);
}

/* The face's normal -y carries azimuth 90: clockwise from +x, so -y is east and +x is north. */
static void north_and_west_turn_to_east_and_north(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file(printed));
    const double *p = &g->position_m[3 * (size_t)g->facets[2].first_vertex];

    assert_near(p[0], 850.0, 0.0);
    assert_near(p[1], 1200.0, 0.0);
    assert_near(p[2], -1.0, 0.0);
    assert_near(g->facets[2].normal[0], 12500.0, 1e-9);
    geometry_file_free(g);
}

static void the_right_hand_normal_is_the_printed_one(void **state)
{
    (void)state;
    status_warnings();
    geometry_file *g = read_geometry(text_file(printed));

    for (int facet = 0; facet < 4; facet++) {
        double normal[3];
        right_hand(g, facet, normal);
        for (int axis = 0; axis < 3; axis++)
            assert_near(normal[axis], g->facets[facet].normal[axis], 1e-6); /* of 15,000 m2 */
    }
    assert_string_equal(status_warnings(), "");
    geometry_file_free(g);
}

static void a_polygon_that_already_runs_with_its_normal_stays(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file_with(printed, "-8.99", "8.99"));
    double normal[3];

    right_hand(g, 0, normal);
    assert_near(normal[2], 9000.0, 1e-6);
    geometry_file_free(g);
}

static void a_normal_off_its_plane_is_a_warning_with_count_and_first_line(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file_with(
        printed, "-0.000000000000000000e+00 1.499999999999999940000e+02", "15.0 150.0"));

    assert_non_null(strstr(status_warnings(), "file:47: here the printed normal is more than 5"));
    geometry_file_free(g);
}

static void a_polygon_without_area_is_kept(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file_with(
        printed, "3.600000e+02 -6.000000e+01 -1.000000e+00\n3.600000e+02 -3.000000e+01",
        "6.000000e+01 -6.000000e+01 -1.000000e+00\n6.000000e+01 -3.000000e+01"));

    assert_int_equal(g->facet_count, 4);
    assert_string_equal(status_warnings(), "");
    geometry_file_free(g);
}

static void assert_same_facet(const geometry_facet *a, const geometry_facet *b)
{
    assert_string_equal(a->name, b->name);
    assert_string_equal(a->material_name, b->material_name);
    assert_string_equal(a->attribute, b->attribute);
    assert_memory_equal(a->id, b->id, sizeof a->id);
    assert_int_equal(a->part, b->part);
    assert_int_equal(a->material_code, b->material_code);
    assert_near(a->stated_temperature_k, b->stated_temperature_k, 0.0);
    assert_near(a->thickness_m, b->thickness_m, 0.0);
    assert_near(a->power_w_m2, b->power_w_m2, 0.0);
    assert_int_equal(a->first_vertex, b->first_vertex);
    assert_int_equal(a->vertex_count, b->vertex_count);
    for (int axis = 0; axis < 3; axis++) assert_near(a->normal[axis], b->normal[axis], 0.0);
    assert_near(a->azimuth_deg, b->azimuth_deg, 0.0);
    assert_near(a->last_number, b->last_number, 0.0);
}

static void a_written_geometry_reads_as_it_was(void **state)
{
    (void)state;
    geometry_file *g = read_geometry(text_file_with(printed, "\n-1\n", "\n20.5\n"));
    assert_int_equal(geometry_file_write(g, text_file_at), STATUS_OK);
    geometry_file *h = read_geometry(text_file_at);

    assert_int_equal(h->object_count, 2);
    assert_string_equal(h->parts[1].name, "GRASS_ATTS");
    assert_int_equal(h->facet_count, 4);
    for (int i = 0; i < 4; i++) assert_same_facet(&h->facets[i], &g->facets[i]);
    for (int i = 0; i < 48; i++) assert_near(h->position_m[i], g->position_m[i], 0.0);
    geometry_file_free(g);
    geometry_file_free(h);
}

static void a_geometry_is_written_in_the_axes_and_winding_of_1994(void **state)
{
    char text[1024] = "";

    (void)state;
    geometry_file *g = read_geometry(text_file(printed));
    assert_int_equal(geometry_file_write(g, text_file_at), STATUS_OK);
    FILE *stream = fopen(text_file_at, "rb");
    assert_true(fread(text, 1, sizeof text - 1, stream) > 0);
    fclose(stream);
    assert_non_null(strstr(text, "\n4\n6.000000000e+01 -3.000000000e+01 -1.000000000e+00\n"
                                 "6.000000000e+01 -6.000000000e+01 -1.000000000e+00\n"
                                 "3.600000000e+02 -6.000000000e+01 -1.000000000e+00\n"));
    geometry_file_free(g);
}

static void a_wrong_geometry_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"OBJECT\nRUNWAY2_OBJ\n1-0-0\n", "", 1, "OBJECT before the first PART"},
        {"PART\nRUNWAY2_ATTS\n1-1-0\n", "", 4, "PART before the first FACE"},
        {"PART\nGRASS_ATTS\n24-1-0\n", "", 54, "PART before the first FACE of an object"},
        {"1-0-0", "1-0", 3, "an id such as 1-1-1"},
        {"1-1-0", "2-1-0", 6, "an id of object 1"},
        {"1-1-2", "1-2-2", 31, "an id of part 1-1"},
        {"\n22\n", "\nconcrete\n", 11, "a material's code"},
        {"35.56", "0", 14, "the thickness in cm"},
        {"\n1.0\n", "\n1.5\n", 16, "the default shape factor from 0 to 1"},
        {"\n4\n6.0", "\n2\n6.0", 20, "the number of vertices from 3"},
        {"\n4\n6.0", "\n5\n6.0", 26, "the outward normal"},
        {"\n4\n6.0", "\n3\n6.0", 25, "the slope in degrees"},
        {"-6.000000e+01 -1.000000e+00", "-6.000000e+01", 22, "x, y and z of a vertex"},
        {"6.000000e+01 -3.0", "nan -3.0", 21, "x, y and z of a vertex"},
        {"6.000000e+01 -3.0", "6e8 -3.0", 21, "a vertex within 1e+07 m"},
        {"1.800000e+02", "1.900000e+02", 26, "the slope in degrees from 0 to 180"},
        {"0.000000e+00\nFACE", "0.000000e+00\nFACET", 29, "OBJECT, PART or FACE"},
        {"9.000000e+01\n1.800000e+02\n2.500000e-01\n", "", 98, "the file ends"},
    };
    geometry_file *g = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(geometry_file_read(&g, text_file_with(printed, wrong[i].old, wrong[i].new)),
                       wrong[i].line, wrong[i].expected);
    assert_refused(geometry_file_read(&g, text_file("OBJECT\na\n1-0-0\n")), 4, "expected FACE");
    assert_refused(geometry_file_read(&g, text_file("")), 1, "the file ends, expected OBJECT");
    assert_null(g);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_hierarchy_is_read),
        cmocka_unit_test(the_printed_attributes_turn_to_si),
        cmocka_unit_test(a_stated_temperature_is_in_celsius),
        cmocka_unit_test(north_and_west_turn_to_east_and_north),
        cmocka_unit_test(the_right_hand_normal_is_the_printed_one),
        cmocka_unit_test(a_polygon_that_already_runs_with_its_normal_stays),
        cmocka_unit_test_setup(a_normal_off_its_plane_is_a_warning_with_count_and_first_line,
                               forget_warnings),
        cmocka_unit_test_setup(a_polygon_without_area_is_kept, forget_warnings),
        cmocka_unit_test(a_written_geometry_reads_as_it_was),
        cmocka_unit_test(a_geometry_is_written_in_the_axes_and_winding_of_1994),
        cmocka_unit_test(a_wrong_geometry_is_refused_at_its_line),
    };

    return cmocka_run_group_tests_name("geometry_file", tests, text_file_setup, text_file_teardown);
}
