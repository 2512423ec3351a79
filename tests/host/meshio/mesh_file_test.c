/* Meshes as they are read: order, names, numbers, and what is refused. */
#include "meshio/mesh_file.h"

#include "../skip.h"

#include <math.h>
#include <setjmp.h>
#include <stdarg.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include <cmocka.h>

#define CUBE                                                                                       \
    "v 0 0 0\nv 1 0 0\nv 1 1 0\nv 0 1 0\nv 0 0 1\nv 1 0 1\nv 1 1 1\nv 0 1 1\n"                     \
    "f 1 4 3 2\nf 5 6 7 8\nf 1 2 6 5\nf 2 3 7 6\nf 3 4 8 7\nf 4 1 5 8\n"

static char folder[] = P_tmpdir "/radsig-mesh-XXXXXX", path[256], message[512];

static void write_file(const char *name, const void *bytes, size_t size)
{
    FILE *file;

    snprintf(path, sizeof path, "%s/%s", folder, name);
    file = fopen(path, "wb");
    assert_non_null(file);
    assert_int_equal(fwrite(bytes, 1, size, file), size);
    assert_int_equal(fclose(file), 0);
}

static mesh_file *read_text(const char *name, const char *text)
{
    mesh_file *mesh = NULL;

    write_file(name, text, strlen(text));
    if (mesh_file_read(&mesh, path, message, sizeof message)) fail_msg("%s", message);
    return mesh;
}

/* Asserts that the file is refused with `path` and then `expected`. */
static void assert_refused(const char *name, const char *text, const char *expected)
{
    mesh_file *mesh = NULL;
    char whole[512];

    write_file(name, text, strlen(text));
    assert_int_not_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    assert_null(mesh);
    snprintf(whole, sizeof whole, "%s%s", path, expected);
    assert_string_equal(message, whole);
}

static void a_cube_of_quads_has_six_faces_of_four_corners(void **state)
{
    mesh_file *mesh = read_text("cube.obj", CUBE);
    (void)state;

    assert_int_equal(mesh->vertex_count, 8);
    assert_int_equal(mesh->face_count, 6);
    for (uint32_t i = 0; i <= 6; i++) assert_int_equal(mesh->first[i], 4 * i);
    assert_int_equal(mesh->corner[5], 5); /* `f 5 6 7 8`, counted from 0 */
    assert_true(mesh->position[6][0] == 1 && mesh->position[6][1] == 1 &&
                mesh->position[6][2] == 1);
    assert_null(mesh->thickness_cm);
    mesh_file_free(mesh);
}

static void a_face_without_names_gets_the_stem_part_and_an_empty_material(void **state)
{
    mesh_file *mesh = read_text("cube.obj", CUBE);
    (void)state;

    assert_int_equal(mesh->object_count, 1);
    assert_string_equal(mesh->object_name[mesh->object[5]], "cube");
    assert_string_equal(mesh->part_name[mesh->part[5]], "part");
    assert_string_equal(mesh->material_name[mesh->material[5]], "");
    mesh_file_free(mesh);
}

static void an_obj_face_keeps_its_object_part_and_material(void **state)
{
    mesh_file *mesh = read_text("names.obj", "mtllib absent.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\n"
                                             "o jet\ng left wing\nusemtl Hard Paint \nf 1 2 3\n"
                                             "g tail\nf 1 2 3\no van\nusemtl glass\nf 1 2 3\n"
                                             "g left wing\nusemtl Hard Paint\nf 1 2 3\n");
    (void)state;

    assert_int_equal(mesh->object_count, 2);
    assert_int_equal(mesh->part_count, 2);
    assert_int_equal(mesh->material_count, 2);
    assert_string_equal(mesh->object_name[mesh->object[0]], "jet");
    assert_string_equal(mesh->part_name[mesh->part[0]], "left wing");
    assert_string_equal(mesh->material_name[mesh->material[0]], "Hard Paint");
    assert_string_equal(mesh->part_name[mesh->part[1]], "tail");
    assert_string_equal(mesh->object_name[mesh->object[2]], "van");
    assert_string_equal(mesh->material_name[mesh->material[2]], "glass");
    assert_int_equal(mesh->part[3], mesh->part[0]);
    assert_int_equal(mesh->material[3], mesh->material[0]);
    mesh_file_free(mesh);
}

static void a_negative_obj_index_counts_backwards_from_the_last_vertex(void **state)
{
    mesh_file *mesh = read_text("back.obj", "v 0 0 0\nv 1 0 0\nv 0 1 0\nf -3 -2 -1\nv 9 9 9\n"
                                            "f -1//-1 -4/1 -3/1/1\n");
    const uint32_t expected[] = {0, 1, 2, 3, 0, 1};
    (void)state;

    assert_memory_equal(mesh->corner, expected, sizeof expected);
    mesh_file_free(mesh);
}

static void an_obj_line_may_end_in_a_comment_or_go_on_after_a_backslash(void **state)
{
    mesh_file *mesh =
        read_text("lines.obj", "\xef\xbb\xbfv 0 0 0 # origin\r\nv 1 0 \\\r\n0\rv 0 1 0\n"
                               "f 1 2 \\\n\\\n 3 # last");
    (void)state;

    assert_int_equal(mesh->vertex_count, 3);
    assert_int_equal(mesh->face_count, 1);
    assert_true(mesh->position[1][0] == 1 && mesh->position[1][2] == 0);
    mesh_file_free(mesh);
}

static void an_obj_number_is_rounded_correctly_and_nan_is_kept(void **state)
{
    mesh_file *mesh = read_text("n.obj", "v 0.12345678901234567 +1e-3 -.5\nv nan inf -inf\n"
                                         "v 1 2 3\nf 1 2 3\n");
    (void)state;

    assert_true(mesh->position[0][0] == 0.12345678901234567); /* the compiler's rounding */
    assert_true(mesh->position[0][1] == 1e-3 && mesh->position[0][2] == -0.5);
    assert_true(isnan(mesh->position[1][0]) && isinf(mesh->position[1][1]));
    mesh_file_free(mesh);
}

static void a_bad_obj_line_is_named(void **state)
{
    (void)state;
    assert_refused("a.obj", CUBE "f 1 2 9\n", ":15: vertex 9, expected one of 8");
    assert_refused(
        "b.obj", CUBE "\nf 1 2 0\n",
        ":16: \"0\", expected a vertex index, which counts from 1 or, backwards, from -1");
    assert_refused("c.obj", CUBE "f 1 2 -9\n", ":15: vertex -9, expected one of the 8 before");
    assert_refused("d.obj", CUBE "f 1 2 3x\n", ":15: \"3x\", expected an integer");
    assert_refused("e.obj", "# 1\nv 0 0 O\n", ":2: \"O\", expected a number");
    assert_refused("f.obj", "v 1 2\n", ":1: nothing, expected a number");
    assert_refused("g.obj", CUBE "f 1 2\n", ":15: a face of 2 corners, expected 3 or more");
    assert_refused("j.obj", CUBE "f 1 2 3/1/1/4\n",
                   ":15: \"3/1/1/4\", expected at most three indices");
    assert_refused("h.obj", CUBE "f\n", ":15: a face of 0 corners, expected 3 or more");
    assert_refused("i.obj", "v 0 0 \\\n\\\n0\nv 1 \\\nx 0\n", ":5: \"x\", expected a number");
}

static void a_ply_face_keeps_its_material_and_thickness(void **state)
{
    mesh_file *mesh = read_text(
        "m.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty double x\n"
                 "property double y\nproperty int z\nelement face 2\n"
                 "property int material\nproperty list uchar uint vertex_indices\n"
                 "property float thickness\nproperty list uchar float texcoord\nend_header\n"
                 "4400000.125 0 0\n1 0 0\n1 1 7\n0 1 0\n"
                 "12 3 0 1 2 2.5 0\n-1 4 0 1 2 3 0.125 2 .5 .5\n");
    (void)state;

    assert_true(mesh->position[0][0] == 4400000.125); /* a float would hold 4400000 */
    assert_true(mesh->position[2][2] == 7);
    assert_string_equal(mesh->material_name[mesh->material[0]], "12");
    assert_string_equal(mesh->material_name[mesh->material[1]], "-1");
    assert_true(mesh->thickness_cm[0] == 2.5f && mesh->thickness_cm[1] == 0.125f);
    assert_int_equal(mesh->first[2] - mesh->first[1], 4);
    mesh_file_free(mesh);
}

/* One triangle, big-endian: three vertices of float32, then 3, 0, 1, 2. */
static size_t big_endian_ply(char out[256])
{
    static const char header[] = "ply\nformat binary_big_endian 1.0\nelement vertex 3\n"
                                 "property float x\nproperty float y\nproperty float z\n"
                                 "element face 1\nproperty list uchar short vertex_index\n"
                                 "end_header\n";
    static const unsigned char body[] = {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0x3f, 0x80, 0,
                                         0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0,    0x40, 0x20,
                                         0, 0, 0, 0, 0, 0, 3, 0, 0, 0, 1, 0, 2};

    memcpy(out, header, sizeof header - 1);
    memcpy(out + sizeof header - 1, body, sizeof body);
    return sizeof header - 1 + sizeof body;
}

static void a_big_endian_ply_is_turned(void **state)
{
    char bytes[256];
    mesh_file *mesh = NULL;
    (void)state;

    write_file("big.ply", bytes, big_endian_ply(bytes));
    assert_int_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    assert_true(mesh->position[1][0] == 1 && mesh->position[2][1] == 2.5);
    assert_int_equal(mesh->corner[2], 2);
    mesh_file_free(mesh);
}

static void a_ply_cut_anywhere_is_refused(void **state)
{
    char bytes[256];
    const size_t size = big_endian_ply(bytes);
    mesh_file *mesh = NULL;
    (void)state;

    for (size_t cut = 0; cut < size; cut++) {
        write_file("cut.ply", bytes, cut);
        assert_int_not_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    }
}

static void a_bad_ply_is_refused_with_its_line(void **state)
{
#define PLY(FACES)                                                                                 \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face " FACES "\nproperty list uchar int vertex_indices\n"           \
    "end_header\n0 0 0\n1 0 0\n0 1 0\n"
    (void)state;
    assert_refused("a.ply", PLY("1") "3 0 1 3\n", ":13: face 0: vertex 3, expected one of 0 to 2");
    assert_refused("b.ply", PLY("2") "3 0 1 2\n",
                   ":13: the file ends here, expected the rows that the header promises");
    assert_refused(
        "c.ply", PLY("1") "3 0 1 2\n3 0 1 2\n",
        ":14: \"3\", expected the end of the file after the rows that the header promises");
    assert_refused(
        "d.ply", PLY("4000000000"),
        ":7: \"4000000000\", expected a number of rows that a file of 181 bytes can hold");
    assert_refused("e.ply", PLY("1") "2 0 1\n", ":13: a face of 2 corners, expected 3 or more");
    assert_refused("f.ply", PLY("0"), ": no faces, but 3 points: expected faces between them");
    assert_refused("h.ply", PLY("1") "3 0 1\n",
                   ":13: the line ends here, expected the properties that the header promises");
    assert_refused("g.ply", "plx\n", ":1: expected a first line \"ply\"");
#undef PLY
}

#define FACET(A, B, C)                                                                             \
    "facet normal 0 0 1\nouter loop\nvertex " A "\nvertex " B "\nvertex " C "\nendloop\nendfacet"  \
    "\n"

static void a_degenerate_stl_facet_keeps_its_number(void **state)
{
    mesh_file *mesh = read_text("d.stl", "solid facet outer\n" FACET("0 0 0", "1 0 0", "0 1 0")
                                             FACET("0 0 0", "0 0 0", "0 1 0")
                                                 FACET("0 0 5", "1 0 0", "0 1 0") "endsolid\n");
    (void)state;

    assert_int_equal(mesh->face_count, 3);
    assert_true(mesh->position[mesh->corner[mesh->first[2]]][2] == 5);
    mesh_file_free(mesh);
}

static void a_bad_stl_is_refused(void **state)
{
    char binary[134] = "solid in name only";
    mesh_file *mesh = NULL;
    (void)state;

    binary[80] = 2; /* facets, of which one is there */
    write_file("cut.stl", binary, sizeof binary);
    assert_int_not_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    assert_non_null(strstr(message, "134 bytes, expected 184 for the 2 facets"));
    assert_refused("a.stl", "Dear reader,\n", ":1: \"Dear\", expected solid");
    assert_refused("b.stl", "solid\n" FACET("0 0 0", "1 0 0", "0 1 0"),
                   ":8: the file ends here, expected facet or endsolid");
    assert_refused("c.stl", "solid\nfacet\nouter loop\nvertex 0 0 0\nvertex 1 0 0\nendloop\n",
                   ":6: a facet of 2 vertices, expected 3 or more");
    assert_refused("d.stl", "solid\nendsolid\n", ": no faces");
    assert_refused("e.stl", "", ": no faces");
}

static void an_off_file_may_hold_comments_and_colours(void **state)
{
    mesh_file *mesh = read_text("c.off", "# by hand\nOFF # here\n\n3 1 0\n0 0 0\n1 0 0 # x\n0 1 0\n"
                                         "3 2 1 0 255 0 0\n");
    (void)state;

    assert_int_equal(mesh->face_count, 1);
    assert_int_equal(mesh->corner[0], 2);
    mesh_file_free(mesh);
}

static void a_bad_off_is_refused_with_its_line(void **state)
{
    (void)state;
    assert_refused("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 3\n",
                   ":5: \"3\", expected a vertex from 0 to 2");
    assert_refused("b.off", "OFF 3 2 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n",
                   ":5: the file ends here, expected 2 faces");
    assert_refused("c.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n3 0 1 2\n",
                   ":6: \"3 0 1 2\", expected the end of the file");
    assert_refused("d.off", "4OFF\n", ":1: \"4OFF\", expected OFF with three coordinates");
}

#define TEXT_PLY(X)                                                                                \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n0 0 "   \
    "0\n" X " 0 0\n0 1 0\n3 0 1 2\n"

static void a_coordinate_beyond_1e9_m_is_refused_by_every_reader(void **state)
{
#define EXPECTED ", expected a coordinate from -1e9 to 1e9 m"
    char bytes[256] = "";
    const float far[3] = {0.0f, -0x1p67f, 0.0f};
    size_t size;
    mesh_file *mesh = NULL;
    (void)state;

    assert_refused("far.obj", "v 0 0 0\nv 1e20 0 0\nv 0 1 0\nf 1 2 3\n", ":2: \"1e20\"" EXPECTED);
    assert_refused("far.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 -1000000001 0\n3 0 1 2\n",
                   ":4: \"-1000000001\"" EXPECTED);
    assert_refused("far.stl", "solid\n" FACET("0 0 0", "1 0 2e9", "0 1 0") "endsolid\n",
                   ":5: \"2e9\"" EXPECTED);
    assert_refused("far.ply", TEXT_PLY("1e300"), ":11: vertex 1: x is 1e+300" EXPECTED);

    bytes[80] = 1;
    memcpy(bytes + 84 + 12 + 12, far, sizeof far);
    write_file("far.stl", bytes, 134);
    assert_int_not_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    assert_non_null(strstr(message, "far.stl: facet 0: found -1.475739526e+20" EXPECTED));

    size = big_endian_ply(bytes);
    bytes[strstr(bytes, "end_header\n") - bytes + 11] = 0x7f; /* the highest byte of a float's x */
    write_file("far.ply", bytes, size);
    assert_int_not_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    assert_non_null(strstr(message, "far.ply: vertex 0: x is 1.701411835e+38" EXPECTED));
#undef EXPECTED
}

static void a_coordinate_of_1e9_m_is_read(void **state)
{
    mesh_file *mesh = read_text("edge.obj", "v 0 0 0\nv 1e9 0 0\nv 0 -1e9 0\nf 1 2 3\n");
    (void)state;

    assert_true(mesh->position[1][0] == 1e9 && mesh->position[2][1] == -1e9);
    mesh_file_free(mesh);
}

static void a_ply_list_of_more_numbers_than_fit_is_refused(void **state)
{
#define LIST(COUNT)                                                                                \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list double int vertex_indices\nend_header\n"      \
    "0 0 0\n1 0 0\n0 1 0\n" COUNT " 0 1 2\n"
    (void)state;
    assert_refused("a.ply", LIST("1e300"), ":13: a list of 1e+300 numbers");
    assert_refused("b.ply", LIST("inf"), ":13: a list of inf numbers");
    assert_refused("c.ply", LIST("nan"), ":13: a list of nan numbers");
    assert_refused("d.ply", LIST("-3"), ":13: a list of -3 numbers");
#undef LIST
}

static void a_ply_thickness_is_not_stated_or_1e_4_to_1e4_cm(void **state)
{
#define THICK(CM)                                                                                  \
    "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\n"                \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\n"                   \
    "property float thickness\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2 " CM "\n"
#define EXPECTED ", expected 0.0001 to 10000 cm or 0: not stated"
    static const char *const good[] = {"0", "0.0001", "2.5", "10000"};
    (void)state;

    for (int i = 0; i < 4; i++) {
        const char *text[] = {THICK("0"), THICK("0.0001"), THICK("2.5"), THICK("10000")};
        mesh_file *mesh = read_text("good.ply", text[i]);
        assert_true(mesh->thickness_cm[0] == strtof(good[i], NULL));
        mesh_file_free(mesh);
    }
    assert_refused("a.ply", THICK("-1"), ":14: face 0: thickness -1" EXPECTED);
    assert_refused("b.ply", THICK("nan"), ":14: face 0: thickness nan" EXPECTED);
    assert_refused("c.ply", THICK("1e-5"), ":14: face 0: thickness 1e-05" EXPECTED);
    assert_refused("d.ply", THICK("inf"), ":14: face 0: thickness inf" EXPECTED);
#undef EXPECTED
#undef THICK
}

/* Asserts that a mesh is read, with as many faces and with this warning. */
static void assert_taken(const char *name, const void *bytes, size_t size, uint32_t face_count,
                         const char *warning)
{
    mesh_file *mesh = NULL;

    write_file(name, bytes, size);
    if (mesh_file_read(&mesh, path, message, sizeof message)) fail_msg("%s", message);
    assert_int_equal(mesh->face_count, face_count);
    assert_string_equal(mesh->warnings, warning);
    mesh_file_free(mesh);
}

static void assert_text_taken(const char *name, const char *text, uint32_t face_count,
                              const char *warning)
{
    assert_taken(name, text, strlen(text), face_count, warning);
}

#define TRIANGLE "v 0 0 0\nv 1 0 0\nv 0 1 0\n"

static void a_comment_of_an_obj_begins_anywhere_in_vertices_and_faces(void **state)
{
    (void)state;
    assert_text_taken("a.obj", "v 0 0 0# c\nv 1 0 0\t# c\nv 0 1 0 #c\nf 1 2 3\t# c\nf 1 2 3#\n", 2,
                      "");
    assert_text_taken("a.obj", "# c\n\t# c\n" TRIANGLE "f 1 2 3", 1, "");
}

static void what_an_obj_holds_beside_polygons_is_told(void **state)
{
    (void)state;
    assert_text_taken("a.obj",
                      TRIANGLE "cstype bezier\ndeg 1 1\nsurf 0 1 0 1 1 2 \\\n  3 1\nparm u 0 1\n"
                               "end\nbzp 1 2 3 1\nf 1 2 3\n",
                      1, "2 free-form surfaces are left out");
    assert_text_taken("a.obj", TRIANGLE "l 1 2\np 1\ncurv 0 1 1 2\nf 1 2 3\n", 1,
                      "3 lines, curves and points have no area and are left out");
    assert_text_taken("a.obj", TRIANGLE "call rest.obj\nF 1 2 3\nface 1 2 3\nf 1 2 3\n", 1,
                      "1 files that it calls are left out\n"
                      "2 lines that are none of OBJ are passed over, the first is line 5");
    assert_refused("a.obj", TRIANGLE "surf 0 1 0 1 1 2 3 1\n",
                   ": no faces, but 1 free-form surfaces are left out");
}

static void keywords_of_an_obj_that_say_nothing_of_shape_are_no_oddity(void **state)
{
    (void)state;
    assert_text_taken(
        "a.obj",
        "mtllib a.mtl\no a\ng b c\ns off\nmg 1 1\nusemtl d\nlod 1\nbevel off\n" TRIANGLE
        "vt 0 0\nvn 0 0 1\nvp 0 0\nc_interp on\nd_interp on\nf 1/1/1 2//1 3\n",
        1, "");
}

/* U+1F9F1 is a pair of surrogates. */
static void a_text_in_utf_16_is_read(void **state)
{
    const char text[] = TRIANGLE "usemtl \xd8\x3e\xdd\xf1\nf 1 2 3\n";
    char bytes[256] = "\xfe\xff", turned[256];
    size_t size = 2;
    mesh_file *mesh = NULL;
    (void)state;

    for (const char *c = text; *c; c++) {
        bytes[size++] = '\0';
        bytes[size++] = *c;
        if (*c != '\xd8' && *c != '\xdd') continue;
        bytes[size - 2] = *c; /* the high byte of a unit */
        bytes[size - 1] = *++c;
    }
    for (size_t i = 0; i < size; i++) turned[i] = bytes[i ^ 1];
    for (int i = 0; i < 2; i++) {
        write_file("utf16.obj", i ? turned : bytes, size);
        if (mesh_file_read(&mesh, path, message, sizeof message)) fail_msg("%s", message);
        assert_string_equal(mesh->material_name[0], "\xf0\x9f\xa7\xb1");
        mesh_file_free(mesh);
    }
}

static void a_line_of_a_text_stl_may_be_a_comment(void **state)
{
    (void)state;
    assert_text_taken(
        "a.stl", "# c\nsolid\n# c\n" FACET("0 0 0", "1 0 0", "0 1 0") "# c\nendsolid\n", 1, "");
}

static void padding_behind_a_text_is_no_text(void **state)
{
    (void)state;
    assert_taken("a.obj", TRIANGLE "f 1 2 3\n\x1a", sizeof TRIANGLE + 8, 1, "");
    assert_taken("a.obj", TRIANGLE "f 1 2 3\n\0\0\0", sizeof TRIANGLE + 10, 1, "");
    assert_text_taken("a.off", "OFF 3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n\x1a", 1, "");
}

static void a_header_of_an_off_may_be_glued_or_missing(void **state)
{
    (void)state;
    assert_text_taken("a.off", "OFF3 1 0 # glued\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 1,
                      "the number of vertices is glued to OFF");
    assert_text_taken("a.off", "3 1 0\n0 0 0\n1 0 0\n0 1 0\n3 0 1 2\n", 1, "");
    assert_text_taken("a.off", "COFF\n3 1\n0 0 0 1 1 1 1\n1 0 0 1 1 1 1\n0 1 0 1 1 1 1\n3 0 1 2\n",
                      1, "");
    assert_refused("a.off", "OOPS3 1 0\n", ":1: \"OOPS\", expected OFF with three coordinates");
}

static void a_count_of_a_binary_stl_that_is_none_is_taken_from_the_size(void **state)
{
    char bytes[84 + 2 * 50 + 16] = "exported";
    (void)state;

    for (int i = 0; i < 2; i++)
        bytes[84 + 50 * i + 12 + 12 + 3] = bytes[84 + 50 * i + 36 + 6] = 0x3f;
    assert_taken("a.stl", bytes, 184, 2, "2 facets are there, the header promises 0");
    bytes[80] = 1;
    assert_taken("a.stl", bytes, 184, 2, "2 facets are there, the header promises 1");
    memset(bytes + 80, 0xff, 4);
    assert_taken("a.stl", bytes, 184, 2, "2 facets are there, the header promises 4294967295");
    memset(bytes + 80, 0, 4);
    bytes[80] = 2;
    assert_taken("a.stl", bytes, 184, 2, "");
    assert_taken("a.stl", bytes, 200, 2, "16 bytes follow the 2 facets that the header promises");
    bytes[80] = 1;
    memset(bytes + 134, 0, 50);
    assert_taken("a.stl", bytes, 184, 1, "50 bytes follow the 1 facets that the header promises");
}

static void rows_and_headers_of_a_ply_that_are_off_are_told(void **state)
{
#define HEAD(MORE)                                                                                 \
    "ply\nformat ascii 1.0\n" MORE "element vertex 3\nproperty float x\nproperty float y\n"        \
    "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"
#define BODY "0 0 0\n1 0 0\n0 1 0\n"
    (void)state;
    assert_text_taken("a.ply", HEAD("Created by hand\n") BODY "3 0 1 2\n", 1,
                      "1 lines of the header are none of PLY, and passed over");
    assert_text_taken("a.ply", HEAD("comment\nobj_info a\n\n") BODY "3 0 1 2\n", 1, "");
    assert_text_taken("a.ply", HEAD("") BODY "3 0 1 2 255 255 255\n", 1,
                      "1 rows hold more than the header promises: the rest is passed over");
    assert_text_taken("a.ply", HEAD("") "comment c\n0 0 0\n# c\n1 0 0\n\n0 1 0\n3 0 1 2\n", 1, "");
    assert_text_taken("a.ply", HEAD("") "0 0 0 1 0 0 0 1 0 3 0 1 2\n", 1, "");
#undef BODY
#undef HEAD
}

static void bytes_without_a_meaning_behind_a_binary_ply_are_told(void **state)
{
    char bytes[256] = "";
    const size_t size = big_endian_ply(bytes);
    (void)state;

    memset(bytes + size, 0, 4);
    assert_taken("a.ply", bytes, size + 4, 1, "4 bytes without a meaning follow the rows");
    bytes[size + 3] = 7;
    write_file("a.ply", bytes, size + 4);
    assert_int_not_equal(mesh_file_read(&(mesh_file *){NULL}, path, message, sizeof message), 0);
    assert_non_null(strstr(message, "4 bytes after the rows that the header promises"));
}

static void strips_of_a_ply_are_triangles_that_turn_alike(void **state)
{
    mesh_file *mesh =
        read_text("a.ply", "ply\nformat ascii 1.0\nelement vertex 4\nproperty float x\n"
                           "property float y\nproperty float z\nelement tristrips 1\n"
                           "property list int int vertex_indices\nend_header\n"
                           "0 0 0\n1 0 0\n0 1 0\n1 1 0\n8 0 1 2 3 -1 2 1 3\n");
    const uint32_t expected[] = {0, 1, 2, 2, 1, 3, 2, 1, 3};
    (void)state;

    assert_int_equal(mesh->face_count, 3);
    for (int i = 0; i < 9; i++) assert_int_equal(mesh->corner[i], expected[i]);
    mesh_file_free(mesh);
}

static void what_is_no_mesh_file_is_refused(void **state)
{
    mesh_file *mesh = NULL;
    (void)state;

    assert_refused("a.fbx", "", ": extension \".fbx\", expected .gdb, .obj, .ply, .stl or .off");
    assert_refused("empty.obj", "# nothing\n", ": no faces");
    assert_int_not_equal(mesh_file_read(&mesh, folder, message, sizeof message), 0);
    assert_non_null(strstr(message, "a folder, expected a file"));
    assert_int_not_equal(mesh_file_read(&mesh, "nonesuch.obj", message, sizeof message), 0);
    assert_string_equal(message, "nonesuch.obj: No such file or directory");
    write_file("zero.obj", "v 1\0 2", 6);
    assert_int_not_equal(mesh_file_read(&mesh, path, message, sizeof message), 0);
    assert_non_null(strstr(message, ":1: a zero byte, expected text"));
}

static void a_message_is_cut_to_the_buffer(void **state)
{
    char little[8] = "xxxxxxx";
    mesh_file *mesh = NULL;
    (void)state;

    assert_int_not_equal(mesh_file_read(&mesh, "nonesuch.obj", little, sizeof little), 0);
    assert_string_equal(little, "nonesuc");
}

/* Face counts of the files' own headers, or of `grep -c '^f '`. */
static void real_files_have_the_faces_that_they_declare(void **state)
{
    static const struct {
        const char *name;
        uint32_t face_count;
    } file[] = {{"assimp/cube.ply", 6},
                {"assimp/cube_binary.ply", 12},
                {"trimesh/cycloidal.ply", 43368},
                {"trimesh/fuze.ply", 1000},
                {"trimesh/ballA.off", 3796},
                {"assimp/Spider_binary.stl", 1368},
                {"assimp/Spider_ascii.stl", 1368},
                {"assimp/spider.obj", 1368},
                {"trimesh/unit_sphere.STL", 1280},
                {"trimesh/quadknot.obj", 1440},
                {"trimesh/wallhole.obj", 13}};
    const char *shared = getenv("RADSIG_SHARED");
    (void)state;

    for (size_t i = 0; i < sizeof file / sizeof *file; i++) {
        mesh_file *mesh = NULL;
        snprintf(path, sizeof path, "%s/data/meshes/%s", shared ? shared : "../shared",
                 file[i].name);
        SKIP_IF(access(path, R_OK), "RADSIG_SHARED holds no meshes");
        if (mesh_file_read(&mesh, path, message, sizeof message)) fail_msg("%s", message);
        assert_int_equal(mesh->face_count, file[i].face_count);
        mesh_file_free(mesh);
    }
}

static int make_folder(void **state)
{
    (void)state;
    return !mkdtemp(folder);
}

static int remove_folder(void **state)
{
    char command[300];
    (void)state;

    snprintf(command, sizeof command, "rm -rf '%s'", folder);
    return system(command);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_cube_of_quads_has_six_faces_of_four_corners),
        cmocka_unit_test(a_face_without_names_gets_the_stem_part_and_an_empty_material),
        cmocka_unit_test(an_obj_face_keeps_its_object_part_and_material),
        cmocka_unit_test(a_negative_obj_index_counts_backwards_from_the_last_vertex),
        cmocka_unit_test(an_obj_line_may_end_in_a_comment_or_go_on_after_a_backslash),
        cmocka_unit_test(an_obj_number_is_rounded_correctly_and_nan_is_kept),
        cmocka_unit_test(a_bad_obj_line_is_named),
        cmocka_unit_test(a_ply_face_keeps_its_material_and_thickness),
        cmocka_unit_test(a_big_endian_ply_is_turned),
        cmocka_unit_test(a_ply_cut_anywhere_is_refused),
        cmocka_unit_test(a_bad_ply_is_refused_with_its_line),
        cmocka_unit_test(a_degenerate_stl_facet_keeps_its_number),
        cmocka_unit_test(a_bad_stl_is_refused),
        cmocka_unit_test(an_off_file_may_hold_comments_and_colours),
        cmocka_unit_test(a_bad_off_is_refused_with_its_line),
        cmocka_unit_test(a_coordinate_beyond_1e9_m_is_refused_by_every_reader),
        cmocka_unit_test(a_coordinate_of_1e9_m_is_read),
        cmocka_unit_test(a_ply_list_of_more_numbers_than_fit_is_refused),
        cmocka_unit_test(a_ply_thickness_is_not_stated_or_1e_4_to_1e4_cm),
        cmocka_unit_test(a_comment_of_an_obj_begins_anywhere_in_vertices_and_faces),
        cmocka_unit_test(what_an_obj_holds_beside_polygons_is_told),
        cmocka_unit_test(keywords_of_an_obj_that_say_nothing_of_shape_are_no_oddity),
        cmocka_unit_test(a_text_in_utf_16_is_read),
        cmocka_unit_test(a_line_of_a_text_stl_may_be_a_comment),
        cmocka_unit_test(padding_behind_a_text_is_no_text),
        cmocka_unit_test(a_header_of_an_off_may_be_glued_or_missing),
        cmocka_unit_test(a_count_of_a_binary_stl_that_is_none_is_taken_from_the_size),
        cmocka_unit_test(rows_and_headers_of_a_ply_that_are_off_are_told),
        cmocka_unit_test(bytes_without_a_meaning_behind_a_binary_ply_are_told),
        cmocka_unit_test(strips_of_a_ply_are_triangles_that_turn_alike),
        cmocka_unit_test(what_is_no_mesh_file_is_refused),
        cmocka_unit_test(a_message_is_cut_to_the_buffer),
        cmocka_unit_test(real_files_have_the_faces_that_they_declare),
    };

    return cmocka_run_group_tests(tests, make_folder, remove_folder);
}
