#include "../assert_near.h"
#include "../text_file.h"

#include "material/material.h"

#define CLOUD                                                                                      \
    "cloud\n0\n1.0\n5.0\n1.0\n0.0\n0.5\n0.96\n-0.5\ncumulus_cloud.ems\ncumulus_cloud.ext\n"
#define ROOF                                                                                       \
    "painted_steel_roof\n1\n.1111\n464.4\n7.833\n1.0\n0.60\n0.90\n0.50\nradome_paint6.ems\n"       \
    "radome_paint6.ext\n"
#define WATER "water\n2\n1.0\n5.13\n1.0\n1.0\n0.50\n0.96\n-0.40\nwater.ems\nwater.ext\n"

/* The first records of thesis Appendix A item 10; the thesis' count is 48. */
static const char printed[] = "3\n" CLOUD ROOF WATER;

static material_library *read_printed(void)
{
    material_library *library = NULL;

    assert_int_equal(material_library_read(&library, text_file(printed)), STATUS_OK);
    return library;
}

static void the_printed_steel_has_the_properties_of_steel(void **state)
{
    (void)state;
    material_library *library = read_printed();
    const material *steel = material_by_code(library, 1);

    assert_string_equal(steel->name, "painted_steel_roof");
    assert_near(steel->specific_heat_j_kg_k, 464.84, 0.01); /* 0.1111 x 4184 J/kg/K */
    assert_near(steel->conductivity_w_m_k, 53.97, 0.01);    /* 464.4 x 0.11622 W/m/K */
    assert_near(steel->density_kg_m3, 7833.0, 1e-9);        /* double */
    assert_near(steel->specular_share, 1.0, 0.0);
    assert_near(steel->solar_absorptance, 0.6, 0.0);
    assert_near(steel->thermal_emissivity, 0.9, 0.0);
    assert_near(steel->exposed_area, 0.5, 0.0);
    assert_string_equal(steel->emissivity_file, "radome_paint6.ems");
    assert_string_equal(steel->extinction_file, "radome_paint6.ext");
    material_library_free(library);
}

static void materials_are_found_by_name_and_by_code(void **state)
{
    (void)state;
    material_library *library = read_printed();

    assert_int_equal(library->count, 3);
    assert_ptr_equal(material_by_name(library, "water"), material_by_code(library, 2));
    assert_near(material_by_name(library, "water")->exposed_area, -0.4, 0.0);
    assert_null(material_by_name(library, "Water"));
    assert_null(material_by_code(library, 3));
    material_library_free(library);
}

static void a_name_or_code_that_came_before_is_refused_at_its_second_line(void **state)
{
    material_library *library = NULL;

    (void)state;
    assert_refused(material_library_read(&library, text_file_with(printed, "water", "cloud")), 24,
                   "a name that no earlier material has");
    assert_refused(material_library_read(&library, text_file_with(printed, "water\n2", "water\n0")),
                   25, "a code that no earlier material has");
}

static void a_wrong_record_is_refused_at_its_line(void **state)
{
    static const struct {
        const char *old, *new;
        int line;
        const char *expected;
    } wrong[] = {
        {"3\ncloud", "4\ncloud", 35, "the file ends, expected a material's name"},
        {"3\ncloud", "2\ncloud", 24, "the end of the file"},
        {"cloud\n0", "cloud\nx", 3, "a material's code"},
        {".1111", "464.8", 15, "the specific heat in cal/g/C from 0.001 to 10"},
        {"7.833", "7833", 17, "the density in g/cm3"},
        {"0.60", "60", 19, "the visible emissivity from 0 to 1"},
        {"-0.40", "-1.40", 32, "the exposed area from -1 to 1"},
    };
    material_library *library = NULL;

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof wrong[0]; i++)
        assert_refused(
            material_library_read(&library, text_file_with(printed, wrong[i].old, wrong[i].new)),
            wrong[i].line, wrong[i].expected);
    assert_null(library);
}

static void a_name_that_is_too_long_is_refused(void **state)
{
    material_library *library = NULL;
    char name[MATERIAL_NAME_SIZE + 1];

    (void)state;
    memset(name, 'a', MATERIAL_NAME_SIZE);
    name[MATERIAL_NAME_SIZE] = '\0';
    assert_refused(material_library_read(&library, text_file_with(printed, "cloud", name)), 2,
                   "fewer than 64 letters");
}

static void a_name_with_control_characters_is_refused(void **state)
{
    material_library *library = NULL;

    (void)state;
    assert_refused(material_library_read(&library, text_file_with(printed, "cloud", "clo\33[2Jud")),
                   2, "a material's name without control characters");
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_steel_has_the_properties_of_steel),
        cmocka_unit_test(materials_are_found_by_name_and_by_code),
        cmocka_unit_test(a_name_or_code_that_came_before_is_refused_at_its_second_line),
        cmocka_unit_test(a_wrong_record_is_refused_at_its_line),
        cmocka_unit_test(a_name_that_is_too_long_is_refused),
        cmocka_unit_test(a_name_with_control_characters_is_refused),
    };

    return cmocka_run_group_tests_name("material", tests, text_file_setup, text_file_teardown);
}
