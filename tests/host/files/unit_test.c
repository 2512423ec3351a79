#include "../assert_near.h"

#include "files/unit.h"

#include <stddef.h>

static void a_unit_is_found_by_its_spellings(void **state)
{
    static const char *const spellings[][2] = {
        {"C", "C"},
        {"\xc2\xb0"
         "C",
         "C"},
        {"degC", "C"},
        {"deg. C", "C"},
        {"Celsius", "C"},
        {"degrees Celsius", "C"},
        {"K", "K"},
        {"kelvin", "K"},
        {"W/m2", "W/m2"},
        {"w/m^2", "W/m2"},
        {"W m-2", "W/m2"},
        {"W/m\xc2\xb2", "W/m2"},
        {"W m**-2", "W/m2"},
        {"W\xc2\xb7m\xe2\x81\xbb\xc2\xb2", "W/m2"},
        {"Wh/m^2", "Wh/m2"},
        {"J m**-2", "J/m2"},
        {"%", "%"},
        {"percent", "%"},
        {"1", "1"},
        {"-", "1"},
        {"hPa", "hPa"},
        {"mb", "mbar"},
        {"m s-1", "m/s"},
        {"m s**-1", "m/s"},
        {"km/h", "km/h"},
        {"knots", "kn"},
        {"mm per hour", "mm/h"},
        {"tenths", "tenths"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++) {
        const unit *found = unit_find(spellings[i][0], NULL);
        if (!found) fail_msg("'%s' is no unit", spellings[i][0]);
        assert_string_equal(found->name, spellings[i][1]);
    }
}

static void what_is_no_unit_is_not_found(void **state)
{
    static const char *const spellings[] = {
        "",        " ", "|",     "c|celsius",
        "furlong", "w", "m/s/s", "a unit that is longer than any unit that is known here"};

    (void)state;
    for (size_t i = 0; i < sizeof spellings / sizeof *spellings; i++)
        assert_null(unit_find(spellings[i], NULL));
}

static void values_become_si(void **state)
{
    static const struct {
        const char *unit;
        double value, si;
    } known[] = {
        {"F", 212.0, 373.15},                            /* water boils */
        {"kn", 1.0, 1852.0 / 3600.0},                    /* the nautical mile */
        {"J/m2", 3.6e6, 1000.0},                         /* of an hour */
        {"kWh/m2", 0.5, 500.0},       {"mm", 3.6, 1e-6}, /* of an hour */
        {"ft", 10000.0, 3048.0},      {"km", 1.5, 1500.0},
        {"oktas", 8.0, 1.0},          {"mbar", 1013.25, 101325.0},
    };

    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        const unit *u = unit_find(known[i].unit, NULL);
        assert_near(u->scale * known[i].value + u->offset, known[i].si,
                    2e-8 * known[i].si); /* 273.15 K is a float */
    }
}

static void a_unit_of_two_quantities_is_the_one_that_is_asked_for(void **state)
{
    (void)state;
    assert_near(unit_find("m", "length")->scale, 1.0, 0.0);
    assert_near(unit_find("m", "rain")->scale, 1.0 / 3600.0, 1e-18); /* of an hour */
    assert_null(unit_find("m", "pressure"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_unit_is_found_by_its_spellings),
        cmocka_unit_test(what_is_no_unit_is_not_found),
        cmocka_unit_test(values_become_si),
        cmocka_unit_test(a_unit_of_two_quantities_is_the_one_that_is_asked_for),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
