/* Neighbours across edges, and the faces that cannot have any. */
#include "meshio/mesh_connect.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#include <cmocka.h>

#define LENGTH(ARRAY) (sizeof(ARRAY) / sizeof *(ARRAY))

static const uint32_t cube_corner[24] = {0, 3, 2, 1, 4, 5, 6, 7, 0, 1, 5, 4,
                                         1, 2, 6, 5, 2, 3, 7, 6, 3, 0, 4, 7};
static char message[256];

/* Connects `face_count` faces of `side` corners each. */
static mesh_connection *connect(uint32_t vertex_count, const double (*position)[3],
                                uint32_t face_count, uint32_t side, const uint32_t *corner)
{
    mesh_connection *connection = NULL;
    uint32_t first[32];

    for (uint32_t i = 0; i <= face_count; i++) first[i] = i * side;
    if (mesh_connect(&connection, vertex_count, position, face_count, first, corner, message,
                     sizeof message))
        fail_msg("%s", message);
    return connection;
}

/* The corners of a unit cube whose lowest one is at (x, y, z). */
static void place_cube(double position[8][3], double x, double y, double z)
{
    static const int step[8][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0},
                                   {0, 0, 1}, {1, 0, 1}, {1, 1, 1}, {0, 1, 1}};

    for (int i = 0; i < 8; i++) {
        position[i][0] = x + step[i][0];
        position[i][1] = y + step[i][1];
        position[i][2] = z + step[i][2];
    }
}

static mesh_connection *two_cubes(double x, double y, double z)
{
    double position[16][3];
    uint32_t corner[48];

    place_cube(position, 0, 0, 0);
    place_cube(position + 8, x, y, z);
    for (int i = 0; i < 48; i++) corner[i] = cube_corner[i % 24] + (i < 24 ? 0 : 8);
    return connect(16, (const double(*)[3])position, 12, 4, corner);
}

static void every_edge_of_a_cube_has_a_neighbour(void **state)
{
    double position[8][3];
    mesh_connection *connection;
    (void)state;

    place_cube(position, 0, 0, 0);
    connection = connect(8, (const double(*)[3])position, 6, 4, cube_corner);
    for (int i = 0; i < 24; i++) assert_in_range(connection->neighbour[i], 0, 5);
    assert_int_equal(connection->neighbour[0], 5); /* bottom 0-3-2-1: beyond 0-3 the face x = 0 */
    assert_int_equal(connection->neighbour[1], 4);
    assert_int_equal(connection->neighbour[2], 3);
    assert_int_equal(connection->neighbour[3], 2);
    assert_int_equal(connection->non_manifold_count, 0);
    mesh_connect_free(connection);
}

static void two_cubes_apart_are_two_closed_bodies(void **state)
{
    mesh_connection *connection = two_cubes(2, 0, 0);
    (void)state;

    for (int i = 0; i < 48; i++)
        assert_in_range(connection->neighbour[i], i < 24 ? 0 : 6, i < 24 ? 5 : 11);
    mesh_connect_free(connection);
}

/* Each end of the edge is surrounded by the first cube; of the second cube two faces meet the whole
 * edge and one more each of its ends. */
static void four_faces_of_the_second_of_two_cubes_at_an_edge_are_non_manifold(void **state)
{
    mesh_connection *connection = two_cubes(1, 1, 0);
    (void)state;

    assert_int_equal(connection->non_manifold_count, 4);
    for (int i = 0; i < 24; i++) assert_in_range(connection->neighbour[i], 0, 5);
    mesh_connect_free(connection);
}

/* The face between them is the back of the first one's. */
static void a_face_between_two_cubes_is_counted_as_reversed(void **state)
{
    mesh_connection *connection = two_cubes(1, 0, 0);
    (void)state;

    assert_int_equal(connection->duplicate_count, 0);
    assert_int_equal(connection->reversed_count, 1);
    mesh_connect_free(connection);
}

static void of_twins_those_that_face_the_same_way_are_duplicates(void **state)
{
    const double position[4][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
    const uint32_t corner[] = {0, 1, 2, 3,  /* a sheet */
                               3, 2, 1, 0,  /* its back */
                               2, 3, 0, 1,  /* the sheet again */
                               1, 0, 3, 2}; /* the back again */
    mesh_connection *connection = connect(4, position, LENGTH(corner) / 4, 4, corner);
    (void)state;

    assert_int_equal(connection->duplicate_count, 2);
    assert_int_equal(connection->reversed_count, 1);
    mesh_connect_free(connection);
}

static void the_third_face_at_an_edge_is_non_manifold(void **state)
{
    const double position[5][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, -1, 0}, {0, 0, 1}};
    const uint32_t corner[] = {0, 1, 2, 1, 0, 3, 0, 1, 4};
    const int32_t expected[] = {1, -1, -1, 0, -1, -1, -1, -1, -1};
    mesh_connection *connection = connect(5, position, 3, 3, corner);
    (void)state;

    assert_int_equal(connection->non_manifold_count, 1);
    assert_memory_equal(connection->neighbour, expected, sizeof expected);
    mesh_connect_free(connection);
}

static void vertices_at_the_same_place_are_one_and_minus_zero_is_zero(void **state)
{
    const double position[6][3] = {{0, 0, 0},    {1, 0, 0},    {0, 1, 0},
                                   {1, -0.0, 0}, {-0.0, 0, 0}, {0, -1, 0}};
    const uint32_t corner[] = {0, 1, 2, 3, 4, 5};
    mesh_connection *connection = connect(6, position, 2, 3, corner);
    (void)state;

    assert_int_equal(connection->neighbour[0], 1);
    assert_int_equal(connection->neighbour[3], 0);
    mesh_connect_free(connection);
}

static void vertices_a_last_bit_apart_are_two(void **state)
{
    const double position[6][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},
                                   {1, 0, 0}, {0, 0, 0}, {0, -1, 0}};
    const uint32_t corner[] = {0, 1, 2, 3, 4, 5};
    double moved[6][3];
    mesh_connection *connection;
    (void)state;

    memcpy(moved, position, sizeof moved);
    moved[3][0] = nextafter(1, 2);
    connection = connect(6, (const double(*)[3])moved, 2, 3, corner);
    assert_int_equal(connection->neighbour[0], -1);
    mesh_connect_free(connection);
}

static void bad_faces_are_counted_by_kind_and_have_no_neighbours(void **state)
{
    const double position[7][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0},       {NAN, 0, 0},
                                   {2, 0, 0}, {1, 1, 0}, {INFINITY, 1, 1}};
    const uint32_t corner[] = {0, 1, 2,  /* sound */
                               2, 0, 1,  /* the same again */
                               1, 0, 2,  /* and from behind */
                               0, 1, 3,  /* nan */
                               5, 2, 6,  /* inf */
                               0, 1, 4,  /* on a line */
                               1, 1, 5,  /* two vertices */
                               1, 5, 2}; /* sound, at 1-2 of the first */
    const uint32_t count = LENGTH(corner) / 3;
    mesh_connection *connection = connect(7, position, count, 3, corner);
    (void)state;

    assert_int_equal(connection->duplicate_count, 1);
    assert_int_equal(connection->reversed_count, 1);
    assert_int_equal(connection->non_finite_count, 2);
    assert_int_equal(connection->degenerate_count, 2);
    assert_int_equal(connection->non_manifold_count, 0);
    for (uint32_t i = 0; i < 3 * count; i++)
        assert_int_equal(connection->neighbour[i], i == 1 ? 7 : i == 23 ? 0 : -1);
    mesh_connect_free(connection);
}

static void a_collinear_face_far_from_the_origin_is_degenerate(void **state)
{
    const double position[3][3] = {{7162.4, -6951.7, 10.1},
                                   {7162.7, -6951.1, 10.4},
                                   {7163.0, -6950.5, 10.7}}; /* steps of (0.3, 0.6, 0.3) */
    const uint32_t corner[] = {0, 1, 2};
    mesh_connection *connection = connect(3, position, 1, 3, corner);
    (void)state;

    assert_int_equal(connection->degenerate_count, 1);
    mesh_connect_free(connection);
}

static void a_quad_with_a_corner_twice_is_connected_as_a_triangle(void **state)
{
    const double position[5][3] = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0, -1, 0}};
    const uint32_t corner[] = {0, 0, 1, 2, 0, 4, 1, 1};
    const int32_t expected[] = {-1, 1, -1, -1, -1, -1, -1, 0};
    mesh_connection *connection = connect(5, position, 2, 4, corner);
    (void)state;

    assert_memory_equal(connection->neighbour, expected, sizeof expected);
    mesh_connect_free(connection);
}

static void a_corner_that_is_no_vertex_is_refused(void **state)
{
    const double position[3][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}};
    const uint32_t first[] = {0, 3}, corner[] = {0, 1, 3};
    mesh_connection *connection = NULL;
    (void)state;

    assert_int_not_equal(
        mesh_connect(&connection, 3, position, 1, first, corner, message, sizeof message), 0);
    assert_string_equal(message, "face 0: vertex 3 of 3");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_edge_of_a_cube_has_a_neighbour),
        cmocka_unit_test(two_cubes_apart_are_two_closed_bodies),
        cmocka_unit_test(four_faces_of_the_second_of_two_cubes_at_an_edge_are_non_manifold),
        cmocka_unit_test(a_face_between_two_cubes_is_counted_as_reversed),
        cmocka_unit_test(of_twins_those_that_face_the_same_way_are_duplicates),
        cmocka_unit_test(the_third_face_at_an_edge_is_non_manifold),
        cmocka_unit_test(vertices_at_the_same_place_are_one_and_minus_zero_is_zero),
        cmocka_unit_test(vertices_a_last_bit_apart_are_two),
        cmocka_unit_test(bad_faces_are_counted_by_kind_and_have_no_neighbours),
        cmocka_unit_test(a_collinear_face_far_from_the_origin_is_degenerate),
        cmocka_unit_test(a_quad_with_a_corner_twice_is_connected_as_a_triangle),
        cmocka_unit_test(a_corner_that_is_no_vertex_is_refused),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
