#include "../assert_near.h"

#include "sky/sun.h"

#define DEGREES (M_PI / 180.0)

/* date -u -d 2000-06-21T01:48Z +%s and so on: the Almanac's instants. */
static const double june_solstice_s = 961552080, march_equinox_s = 953537700;
static const double perihelion_s = 946876680, aphelion_s = 962668800;

static double zenith_deg(double time_s, double latitude_deg, double longitude_deg)
{
    return sun_at(time_s, latitude_deg, longitude_deg).zenith_rad / DEGREES;
}

/* The time of the smallest zenith angle within twelve hours. */
static double noon_s(double near_s, double latitude_deg, double longitude_deg)
{
    double best_s = near_s;

    for (double t = near_s - 43200; t < near_s + 43200; t += 10)
        if (zenith_deg(t, latitude_deg, longitude_deg) <
            zenith_deg(best_s, latitude_deg, longitude_deg))
            best_s = t;
    return best_s;
}

/* NREL/TP-560-34302, Table A5.1: elevation without refraction 39.872046. */
static void the_sun_stands_where_the_worked_example_of_spa_has_it(void **state)
{
    (void)state;
    const sun_position sun = sun_at(1066419030, 39.742476, -105.1786);

    assert_near(sun.zenith_rad / DEGREES, 90 - 39.872046, 0.01); /* PSA's greatest error */
    assert_near(sun.azimuth_rad / DEGREES, 194.340241, 0.01);
    assert_near(sun.distance_au, 0.9965422974, 1e-4);
}

static void at_the_june_solstice_noon_is_the_obliquity_from_the_latitude(void **state)
{
    (void)state;
    const double noon = noon_s(june_solstice_s, 40, -80);

    assert_near(zenith_deg(noon, 40, -80), 40 - 23.4393, 0.01); /* obliquity of 2000 */
}

static void at_the_equinox_the_sun_is_on_the_horizon_of_the_pole(void **state)
{
    (void)state;
    assert_near(zenith_deg(march_equinox_s, 90, 0), 90,
                0.012); /* 0.01 and the parallax of 0.0024 */
}

static void a_solstice_day_is_symmetric_about_noon(void **state)
{
    (void)state;
    const double noon = noon_s(june_solstice_s, 43, 10);

    assert_near(zenith_deg(noon - 14400, 43, 10), zenith_deg(noon + 14400, 43, 10), 0.1); /* 10 s */
}

static void the_sun_is_east_before_noon_and_west_after(void **state)
{
    (void)state;
    const double noon = noon_s(june_solstice_s, 43, 10);
    double east[3], west[3];

    sun_direction(sun_at(noon - 7200, 43, 10), east);
    sun_direction(sun_at(noon + 7200, 43, 10), west);

    assert_true(east[0] > 0.3 && west[0] < -0.3 && east[1] < 0 && west[1] < 0);
}

static void south_of_the_tropics_noon_is_north(void **state)
{
    (void)state;
    const double noon = noon_s(june_solstice_s, -33.9, 18.4);
    const double azimuth_deg = sun_at(noon, -33.9, 18.4).azimuth_rad / DEGREES;
    double direction[3];

    sun_direction(sun_at(noon, -33.9, 18.4), direction);

    assert_near(fmin(azimuth_deg, 360 - azimuth_deg), 0, 0.1); /* noon is found to 10 s */
    assert_true(direction[1] > 0.5);
}

static void the_direction_is_a_unit_vector(void **state)
{
    (void)state;
    double d[3];

    sun_direction(sun_at(june_solstice_s, 12, 34), d);

    assert_near(d[0] * d[0] + d[1] * d[1] + d[2] * d[2], 1, 1e-12); /* double */
}

static void the_distance_has_its_extremes_at_perihelion_and_aphelion(void **state)
{
    (void)state;
    assert_near(sun_at(perihelion_s, 0, 0).distance_au, 0.983321, 1e-4); /* short series */
    assert_near(sun_at(aphelion_s, 0, 0).distance_au, 1.016741, 1e-4);
}

static void equinox_days_last_twelve_hours(void **state)
{
    (void)state;
    double rise_h = 0, set_h = 0;

    /* Midnight in UTC at longitude 0. */
    assert_true(sun_rise_and_set(953510400, 40, 0, &rise_h, &set_h));

    assert_near(set_h - rise_h, 12, 0.03); /* declination moves by 0.2 degrees in half a day */
    assert_near((set_h + rise_h) / 2, 12 + 7.5 / 60, 0.02); /* equation of time -7.5 min */
}

static void a_solstice_day_at_43_degrees_lasts_as_long_as_its_hour_angle(void **state)
{
    (void)state;
    const double hour_angle = acos(-tan(43 * DEGREES) * tan(23.4393 * DEGREES));
    double rise_h = 0, set_h = 0;

    assert_true(sun_rise_and_set(961545600, 43, 0, &rise_h, &set_h));

    assert_near(set_h - rise_h, hour_angle / DEGREES / 7.5, 0.01); /* 0.01 degrees and the search */
}

static void nothing_rises_in_the_polar_day(void **state)
{
    (void)state;
    double rise_h = -5, set_h = -5;

    assert_false(sun_rise_and_set(961545600, 80, 0, &rise_h, &set_h));

    assert_near(rise_h, -5, 0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_sun_stands_where_the_worked_example_of_spa_has_it),
        cmocka_unit_test(at_the_june_solstice_noon_is_the_obliquity_from_the_latitude),
        cmocka_unit_test(at_the_equinox_the_sun_is_on_the_horizon_of_the_pole),
        cmocka_unit_test(a_solstice_day_is_symmetric_about_noon),
        cmocka_unit_test(the_sun_is_east_before_noon_and_west_after),
        cmocka_unit_test(south_of_the_tropics_noon_is_north),
        cmocka_unit_test(the_direction_is_a_unit_vector),
        cmocka_unit_test(the_distance_has_its_extremes_at_perihelion_and_aphelion),
        cmocka_unit_test(equinox_days_last_twelve_hours),
        cmocka_unit_test(a_solstice_day_at_43_degrees_lasts_as_long_as_its_hour_angle),
        cmocka_unit_test(nothing_rises_in_the_polar_day),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
