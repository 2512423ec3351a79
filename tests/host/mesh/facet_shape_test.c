#include "../assert_near.h"

#include "mesh/facet_shape.h"

#include <stdlib.h>
#include <string.h>

#define DEGREE (M_PI / 180.0)

/* Shapes one facet of `count` corners; the caller frees what facet_shape_set allocates. */
static geometry *shape(const double (*position)[3], uint32_t count, const uint32_t corner[4])
{
    geometry *g = calloc(1, sizeof *g);

    g->facet_count = 1;
    g->vertex_count = count;
    g->corner = malloc(sizeof *g->corner);
    memcpy(g->corner[0], corner, sizeof *g->corner);
    if (facet_shape_set(g, position) != STATUS_OK) fail_msg("%s", status_message());
    return g;
}

static geometry *triangle(const double (*position)[3])
{
    return shape(position, 3, (const uint32_t[4]){0, 1, 2, UINT32_MAX});
}

static geometry *quad(const double (*position)[3])
{
    return shape(position, 4, (const uint32_t[4]){0, 1, 2, 3});
}

static void a_level_square_faces_up(void **state)
{
    const double square[4][3] = {{0, 0, 1}, {3, 0, 1}, {3, 2, 1}, {0, 2, 1}};

    (void)state;
    geometry *g = quad(square);
    assert_near((double)g->area_m2[0], 6.0, 1e-6);
    assert_near((double)g->normal[0][2], 1.0, 0.0);
    assert_near((double)g->slope_rad[0], 0.0, 0.0);
    assert_near((double)g->azimuth_rad[0], 0.0, 0.0);
    geometry_free(g);
}

static void a_ceiling_has_a_slope_of_180_degrees(void **state)
{
    const double down[3][3] = {{0, 0, 0}, {0, 1, 0}, {1, 0, 0}};

    (void)state;
    geometry *g = triangle(down);
    assert_near((double)g->slope_rad[0], M_PI, 1e-6); /* float */
    assert_near((double)g->area_m2[0], .5, 1e-7);
    geometry_free(g);
}

/* Walls that face north, east, south and west, and a roof of 30 degrees that faces south-west. */
static void azimuths_run_clockwise_from_north(void **state)
{
    static const double facing[5][2] = {{0, 1}, {1, 0}, {0, -1}, {-1, 0}, {-M_SQRT1_2, -M_SQRT1_2}};
    static const double azimuth_deg[5] = {0, 90, 180, 270, 225};

    (void)state;
    for (int i = 0; i < 5; i++) {
        const double n[2] = {facing[i][0], facing[i][1]};
        const double slope = i < 4 ? 90.0 * DEGREE : 30.0 * DEGREE;
        /* One edge level, to the left of the normal; the other up the slope, against it. */
        const double left[3] = {-n[1], n[0], 0};
        const double up[3] = {-cos(slope) * n[0], -cos(slope) * n[1], sin(slope)};
        const double corners[3][3] = {{0, 0, 0}, {left[0], left[1], 0}, {up[0], up[1], up[2]}};
        geometry *g = triangle(corners);
        assert_near((double)g->azimuth_rad[0] / DEGREE, azimuth_deg[i], 2e-5); /* float */
        assert_near((double)g->slope_rad[0] / DEGREE, slope / DEGREE, 1e-5);
        assert_near((double)g->normal[0][2], cos(slope), 1e-7);
        geometry_free(g);
    }
}

static void coordinates_of_a_map_keep_their_millimetres(void **state)
{
    const double east = 433123.0, north = 4402123.0;
    const double corners[4][3] = {{east, north, 250.0},
                                  {east + .001, north, 250.0},
                                  {east + .001, north + .003, 250.0},
                                  {east, north + .003, 250.0}};

    (void)state;
    geometry *g = quad(corners);
    assert_near(g->origin_m[0], east, 0.0); /* whole metres */
    assert_near(g->origin_m[1], north, 0.0);
    assert_near((double)(g->position[2][0] - g->position[0][0]), .001, 1e-9); /* double at 4e6 m */
    assert_near((double)(g->position[2][1] - g->position[0][1]), .003, 1e-9);
    assert_near((double)g->area_m2[0], 3e-6, 1e-11);
    assert_near((double)g->high[1], .003, 1e-9);
    geometry_free(g);
}

static void the_origin_is_the_middle_in_whole_metres(void **state)
{
    const double corners[3][3] = {{0, 0, 0}, {100.5, 0, 0}, {0, 41, -9}};

    (void)state;
    geometry *g = triangle(corners);
    assert_near(g->origin_m[0], 50.0, 0.0);
    assert_near(fabs(g->origin_m[1] - 20.5), .5, 0.0);
    assert_near((double)g->low[0], -50.0, 0.0);
    assert_near((double)g->high[0], 50.5, 0.0);
    assert_near((double)g->position[2][2] + g->origin_m[2], -9.0, 0.0);
    geometry_free(g);
}

static void a_concave_quad_has_its_own_area(void **state)
{
    const double arrow[4][3] = {{0, 0, 0}, {2, -1, 0}, {1, 0, 0}, {2, 1, 0}};

    (void)state;
    geometry *g = quad(arrow);
    assert_near((double)g->area_m2[0], 1.0, 1e-7); /* two triangles of 1/2 */
    assert_near((double)g->normal[0][2], 1.0, 0.0);
    geometry_free(g);
}

static void a_facet_without_area_has_no_normal(void **state)
{
    const double line[3][3] = {{0, 0, 0}, {1, 1, 1}, {3, 3, 3}};

    (void)state;
    geometry *g = triangle(line);
    assert_near((double)g->area_m2[0], 0.0, 0.0);
    for (int k = 0; k < 3; k++) assert_near((double)g->normal[0][k], 0.0, 0.0);
    geometry_free(g);
}

static void a_coordinate_that_is_no_number_spoils_its_facet_alone(void **state)
{
    const double corners[3][3] = {{0, 0, 0}, {1, 0, NAN}, {4, 8, 0}};

    (void)state;
    geometry *g = triangle(corners);
    assert_near((double)g->area_m2[0], 0.0, 0.0);
    assert_near((double)g->normal[0][0], 0.0, 0.0);
    assert_near((double)g->azimuth_rad[0], 0.0, 0.0);
    assert_near((double)g->high[1] + g->origin_m[1], 8.0, 0.0);
    assert_near((double)g->high[2], 0.0, 0.0);
    geometry_free(g);
}

static void no_vertices_make_an_empty_box(void **state)
{
    geometry *g = calloc(1, sizeof *g);

    (void)state;
    assert_int_equal(facet_shape_set(g, NULL), STATUS_OK);
    for (int k = 0; k < 3; k++) assert_near((double)(g->high[k] - g->low[k]), 0.0, 0.0);
    geometry_free(g);
}

/* The least float above 0 is 1.4e-45. */
static void an_area_that_a_float_cannot_hold_is_none(void **state)
{
    const double least[3][3] = {{0, 0, 0}, {1e-23, 0, 0}, {0, 1e-23, 0}};
    const double largest[3][3] = {{0, 0, 0}, {1e20, 0, 0}, {0, 1e20, 0}};

    (void)state;
    for (int i = 0; i < 2; i++) {
        geometry *g = triangle(i ? largest : least);
        assert_true(g->area_m2[0] == 0.0f);
        assert_true(g->normal[0][2] == 0.0f);
        geometry_free(g);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_level_square_faces_up),
        cmocka_unit_test(a_ceiling_has_a_slope_of_180_degrees),
        cmocka_unit_test(azimuths_run_clockwise_from_north),
        cmocka_unit_test(coordinates_of_a_map_keep_their_millimetres),
        cmocka_unit_test(the_origin_is_the_middle_in_whole_metres),
        cmocka_unit_test(a_concave_quad_has_its_own_area),
        cmocka_unit_test(a_facet_without_area_has_no_normal),
        cmocka_unit_test(a_coordinate_that_is_no_number_spoils_its_facet_alone),
        cmocka_unit_test(no_vertices_make_an_empty_box),
        cmocka_unit_test(an_area_that_a_float_cannot_hold_is_none),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
