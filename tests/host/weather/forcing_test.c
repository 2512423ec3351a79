#include "../assert_near.h"

#include "kernels/constants.h"
#include "kernels/thermal/convection.h"
#include "weather/forcing.h"
#include "weather/weather_synthesis.h"

#define KELVIN 273.15

static const sun_position at_30_deg = {M_PI / 6, M_PI, 1};

/* 20 C, a vapour pressure of 10 mbar, 1000 mbar, 6 in the morning. */
static weather_record mild(void)
{
    return (weather_record){.time_h = 6,
                            .air_temperature_k = 20 + KELVIN,
                            .dew_point_k = 6.9889 + KELVIN, /* Magnus: ln(10 / 6.112) inverted */
                            .pressure_pa = 1e5,
                            .wind_m_s = 3,
                            .direct_w_m2 = 900,
                            .diffuse_w_m2 = 100,
                            .sky_exposure = 1};
}

static double emissivity(const weather_record *w, forcing_sky sky)
{
    const forcing_laws laws = {.sky = sky};
    const forcing_record f = forcing_of(w, at_30_deg, &laws, false);

    return (double)f.sky_longwave_w_m2 / (5.670374419e-8 * pow(w->air_temperature_k, 4));
}

static void clear_skies_have_the_emissivity_of_their_laws(void **state)
{
    (void)state;
    const weather_record w = mild();

    assert_near(emissivity(&w, FORCING_BRUNT), 0.605 + 0.048 * sqrt(10), 2e-5);
    assert_near(emissivity(&w, FORCING_BRUTSAERT), 1.24 * pow(10 / 293.15, 1.0 / 7), 2e-5);
    assert_near(emissivity(&w, FORCING_BERDAHL_MARTIN),
                0.711 + 0.56 * 0.069889 + 0.73 * 0.069889 * 0.069889, 2e-5);
}

static void berdahl_s_sky_is_colder_at_noon_and_warmer_under_pressure(void **state)
{
    (void)state;
    weather_record w = mild();
    const double morning = emissivity(&w, FORCING_BERDAHL_MARTIN);

    w.time_h = 12;
    assert_near(emissivity(&w, FORCING_BERDAHL_MARTIN), morning - 0.013, 1e-6);
    w.time_h = 6;
    w.pressure_pa = 9e4;
    assert_near(emissivity(&w, FORCING_BERDAHL_MARTIN), morning - 0.012, 1e-6);
}

static void clouds_raise_every_law_and_measured_longwave_none(void **state)
{
    (void)state;
    weather_record w = mild();
    const double clear = emissivity(&w, FORCING_BRUTSAERT);

    w.sky_exposure = 0.5;
    w.cloud_type = 4;
    assert_near(emissivity(&w, FORCING_BRUTSAERT), clear * (1 + 0.20 * 0.25), 1e-6);
    w.longwave_w_m2 = 333;
    assert_near(emissivity(&w, FORCING_BRUNT) * 5.670374419e-8 * pow(293.15, 4), 333, 1e-3);
}

static void the_longwave_of_fog_is_that_of_black_air(void **state)
{
    (void)state;
    weather_record w = mild();
    w.cloud_type = 8;
    const double clear = emissivity(&w, FORCING_BRUNT);

    w.sky_exposure = 0;
    assert_near(emissivity(&w, FORCING_BRUNT), 1, 1e-6);
    w.sky_exposure = 0.5;
    assert_near(emissivity(&w, FORCING_BRUNT), clear + 0.25 * (1 - clear), 1e-6);
}

static void clouds_without_a_type_count_as_altostratus(void **state)
{
    (void)state;
    weather_record w = mild();
    const double clear = emissivity(&w, FORCING_BRUNT);

    w.sky_exposure = 0.5;
    assert_near(emissivity(&w, FORCING_BRUNT), clear * (1 + 0.20 * 0.25), 1e-6);
}

static void thesis_mode_keeps_its_fog_and_its_clouds_without_a_type(void **state)
{
    (void)state;
    const forcing_laws laws = {.thesis = true};
    weather_record w = mild();
    const double clear = emissivity(&w, FORCING_BRUNT), black = 5.670374419e-8 * pow(293.15, 4);

    w.sky_exposure = 0;
    assert_near((double)forcing_of(&w, at_30_deg, &laws, false).sky_longwave_w_m2 / black, clear,
                1e-6);
    w.cloud_type = 8;
    assert_near((double)forcing_of(&w, at_30_deg, &laws, false).sky_longwave_w_m2 / black,
                clear * 1.25, 1e-6);
}

static void convection_is_the_model_s_own_unless_stated(void **state)
{
    (void)state;
    const weather_record w = mild();
    const forcing_laws own = {0}, therm = {.convection = FORCING_THERM},
                       mcadams = {.convection = FORCING_MCADAMS};

    assert_near(forcing_of(&w, at_30_deg, &own, false).convection_w_m2_k, 9 + 1.2 * 3, 1e-5);
    assert_near(forcing_of(&w, at_30_deg, &own, true).convection_w_m2_k, 5.7 + 3.8 * 3, 1e-5);
    assert_near(forcing_of(&w, at_30_deg, &therm, true).convection_w_m2_k, 9 + 1.2 * 3, 1e-5);
    assert_near(forcing_of(&w, at_30_deg, &mcadams, false).convection_w_m2_k, 5.7 + 3.8 * 3, 1e-5);
}

static void tarp_s_wind_is_that_of_a_medium_rough_plate(void **state)
{
    (void)state;
    const weather_record w = mild();
    const forcing_laws laws = {.convection = FORCING_TARP};
    const forcing_record f = forcing_of(&w, at_30_deg, &laws, true);

    assert_int_equal(f.convection_law, CONVECTION_TARP);
    assert_near(f.convection_w_m2_k, 2.537 * 1.52 * sqrt(3 * 16.0 / 16), 1e-4); /* 4 m x 4 m */
}

/* rho cp k^2 V / (0.74 ln^2(z/z0)), g z / V^2 and 5.3 x 9.4 k^2 / ln^2(z/z0) (z/z0)^0.5. */
static void similarity_takes_the_logarithmic_wind_s_part(void **state)
{
    (void)state;
    const weather_record w = mild();
    const forcing_laws usual = {.convection = FORCING_SIMILARITY};
    const forcing_laws stated = {
        .convection = FORCING_SIMILARITY, .roughness_length_m = 0.05, .wind_height_m = 3};
    const forcing_record f = forcing_of(&w, at_30_deg, &usual, false);
    const forcing_record g = forcing_of(&w, at_30_deg, &stated, false);
    const double humidity = 0.622 * 10 / (1000 - 0.378 * 10);
    const double heat = 1005 * 1e5 / (287.05 * 293.15 * (1 + 0.608 * humidity));

    assert_int_equal(f.convection_law, CONVECTION_SIMILARITY);
    assert_near(f.convection_w_m2_k, heat * 0.16 * 3 / (0.74 * pow(log(10000), 2)), 1e-3);
    assert_near(f.buoyancy, 9.80665 * 10 / 9, 1e-4);
    assert_near(f.roughness, 5.3 * 9.4 * 0.16 / pow(log(10000), 2) * sqrt(10000), 1e-4);
    assert_near(g.convection_w_m2_k, heat * 0.16 * 3 / (0.74 * pow(log(60), 2)), 1e-3);
    assert_near(g.buoyancy, 9.80665 * 3 / 9, 1e-5);
    assert_near(f.plate_w_m2_k, 2.537 * 1.52 * sqrt(3), 1e-4);
}

/* A logarithmic wind: ln(10 / 0.01) / ln(2 / 0.01) times as fast at 10 m as at 2 m. */
static void the_wind_s_height_acts_in_every_law(void **state)
{
    (void)state;
    const weather_record w = mild();
    const double wind_m_s = 3 * log(1000) / log(200);
    forcing_laws laws = {.roughness_length_m = 0.01, .wind_height_m = 2};

    laws.convection = FORCING_THERM;
    assert_near(forcing_of(&w, at_30_deg, &laws, false).convection_w_m2_k, 9 + 1.2 * wind_m_s,
                1e-5);
    laws.convection = FORCING_MCADAMS;
    assert_near(forcing_of(&w, at_30_deg, &laws, false).convection_w_m2_k, 5.7 + 3.8 * wind_m_s,
                1e-5);
    laws.convection = FORCING_TARP;
    assert_near(forcing_of(&w, at_30_deg, &laws, false).convection_w_m2_k,
                2.537 * 1.52 * sqrt(wind_m_s), 1e-4);
    laws.thesis = true;
    laws.convection = FORCING_THERM;
    assert_near(forcing_of(&w, at_30_deg, &laws, false).convection_w_m2_k, 9 + 1.2 * 3, 1e-5);
}

static void free_convection_counts_but_in_thesis_mode(void **state)
{
    (void)state;
    const weather_record w = mild();
    const forcing_laws exact = {.convection = FORCING_MCADAMS};
    const forcing_laws thesis = {.convection = FORCING_MCADAMS, .thesis = true};
    const forcing_laws bare = {.convection = FORCING_SIMILARITY, .thesis = true};

    assert_int_equal(forcing_of(&w, at_30_deg, &exact, true).convection_law, CONVECTION_BLENDED);
    assert_int_equal(forcing_of(&w, at_30_deg, &thesis, true).convection_law, CONVECTION_WIND);
    assert_near(forcing_of(&w, at_30_deg, &bare, true).plate_w_m2_k, 0, 0);
}

static void still_air_keeps_a_breath_of_wind_over_a_roughness(void **state)
{
    (void)state;
    weather_record w = mild();
    w.wind_m_s = 0;
    const forcing_laws laws = {.convection = FORCING_SIMILARITY};

    assert_near(forcing_of(&w, at_30_deg, &laws, false).buoyancy, 9.80665 * 10 / 0.01, 0.01);
}

static void hay_and_davies_move_the_sun_s_share_into_the_beam(void **state)
{
    (void)state;
    const weather_record w = mild();
    const forcing_laws laws = {.diffuse = FORCING_HAY_DAVIES};
    const forcing_record f = forcing_of(&w, at_30_deg, &laws, false);
    const double fraction = 900.0 / 1367;

    assert_near(f.diffuse_w_m2, 100 * (1 - fraction), 1e-3);
    assert_near(f.direct_w_m2, 900 + 100 * fraction / cos(M_PI / 6), 1e-3);
    /* What falls on a level plane stays. */
    assert_near((double)f.direct_w_m2 * cos(M_PI / 6) + (double)f.diffuse_w_m2,
                900 * cos(M_PI / 6) + 100, 1e-3);
}

static void without_a_beam_all_skies_are_isotropic(void **state)
{
    (void)state;
    weather_record w = mild();
    w.direct_w_m2 = 0;
    const forcing_laws laws = {.diffuse = FORCING_HAY_DAVIES};

    assert_near(forcing_of(&w, at_30_deg, &laws, false).diffuse_w_m2, 100, 0);
    assert_near(forcing_of(&w, at_30_deg, &laws, false).direct_w_m2, 0, 0);
}

/* kWh/m2 that fall on a wall to the east on the clear 23 June 1992 at 43.083 N, 77.667 W; the ground
 * reflects 0.2 as in the numbers that it is compared with. */
static double east_wall_kwh(forcing_diffuse diffuse)
{
    const site rochester = {43.083, -77.667, 709311600, -240};
    const forcing_laws laws = {.diffuse = diffuse};
    weather_summary summary = weather_summary_default();
    weather *w = NULL;
    double sum = 0;

    summary.air_temperature_sunrise_k = 9 + KELVIN;
    summary.air_temperature_peak_k = 21 + KELVIN;
    summary.peak_time_h = 15.5;
    summary.relative_humidity_sunrise = 0.9;
    summary.wind_m_s = 2;
    if (weather_synthesise(&w, &summary, &rochester) != STATUS_OK) fail_msg("no weather");
    for (size_t i = 96; i < 192; i++) {
        const double time_s = weather_origin_s(w, &rochester) + 900.0 * (double)i;
        const forcing_record f =
            forcing_of(&w->record[i], sun_at(time_s, 43.083, -77.667), &laws, false);
        const double up = fmax(0, f.sun[2]);
        sum += fmax(0, f.sun[0]) * (double)f.direct_w_m2 + 0.5 * (double)f.diffuse_w_m2 +
               0.1 * (up * (double)f.direct_w_m2 + (double)f.diffuse_w_m2);
    }
    weather_free(w);
    return sum * 0.25 / 1000;
}

/* pvlib gives 4.87 (isotropic) and 4.92 kWh/m2 on that day; its air was not quite this. */
static void an_east_wall_gets_what_another_library_gives_it(void **state)
{
    (void)state;
    const double isotropic = east_wall_kwh(FORCING_ISOTROPIC);
    const double hay_davies = east_wall_kwh(FORCING_HAY_DAVIES);

    assert_near(isotropic, 4.87, 0.02 * 4.87);
    assert_near(hay_davies - isotropic, 0.05, 0.05);
    assert_true(hay_davies > isotropic);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(clear_skies_have_the_emissivity_of_their_laws),
        cmocka_unit_test(berdahl_s_sky_is_colder_at_noon_and_warmer_under_pressure),
        cmocka_unit_test(clouds_raise_every_law_and_measured_longwave_none),
        cmocka_unit_test(the_longwave_of_fog_is_that_of_black_air),
        cmocka_unit_test(clouds_without_a_type_count_as_altostratus),
        cmocka_unit_test(thesis_mode_keeps_its_fog_and_its_clouds_without_a_type),
        cmocka_unit_test(convection_is_the_model_s_own_unless_stated),
        cmocka_unit_test(tarp_s_wind_is_that_of_a_medium_rough_plate),
        cmocka_unit_test(similarity_takes_the_logarithmic_wind_s_part),
        cmocka_unit_test(the_wind_s_height_acts_in_every_law),
        cmocka_unit_test(free_convection_counts_but_in_thesis_mode),
        cmocka_unit_test(still_air_keeps_a_breath_of_wind_over_a_roughness),
        cmocka_unit_test(hay_and_davies_move_the_sun_s_share_into_the_beam),
        cmocka_unit_test(without_a_beam_all_skies_are_isotropic),
        cmocka_unit_test(an_east_wall_gets_what_another_library_gives_it),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
