#include "thermal/thermal.h"
#include "weather/weather_synthesis.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdint.h>

#include <cmocka.h>
#include <math.h>

enum { SLOTS = 96, WORDS = 3 };

static device *dev;

static int open_device(void **state)
{
    (void)state;
    return device_open(&dev, -1) == STATUS_OK ? 0 : -1;
}

static int close_device(void **state)
{
    (void)state;
    device_free(dev);
    return 0;
}

/* 40 N, 80 W; 13:15 by a clock four hours behind UTC, which is a step of the weather. */
static const site place = {
    .latitude_deg = 40.0, .longitude_deg = -80.0, .time_s = 709146900.0, .utc_offset_min = -240};

static weather *clear_day(void)
{
    weather_summary summary = weather_summary_default();
    weather *w = NULL;

    summary.air_temperature_sunrise_k = 288.0;
    summary.air_temperature_peak_k = 302.0;
    summary.peak_time_h = 15.0;
    summary.relative_humidity_sunrise = .9;
    summary.wind_m_s = 2.0;
    if (weather_synthesise(&w, &summary, &place) != STATUS_OK) fail_msg("%s", status_message());
    return w;
}

/* A normal that is none of those at which temperatures are computed. */
static void assert_day_ends_at_temperature(const layered_matter *layered)
{
    const material_record material = {.density_kg_m3 = 2000.0f,
                                      .specific_heat_j_kg_k = 900.0f,
                                      .conductivity_w_m_k = 1.0f,
                                      .solar_absorptance = .9f,
                                      .thermal_emissivity = .9f,
                                      .exposed_area = .5f};
    const thermal_matter matter = {.material = &material, .layered = layered, .count = 1};
    const facet_record facet = {.normal = {.60003f, -.01234f, .79987f}, .thickness_m = .05f};
    uint32_t lit[WORDS] = {0xffffffffu, 0xffffffffu, 0xffffffffu};
    const thermal_subject subject = {&facet, 1, lit, WORDS, SLOTS};
    float at_time_k, day_k[SLOTS];
    weather *w = clear_day();
    thermal *t = NULL;

    if (thermal_open(&t, dev, &matter, w, &place) != STATUS_OK) fail_msg("%s", status_message());
    assert_int_equal(thermal_at_time(t, &subject, &at_time_k), STATUS_OK);
    assert_int_equal(thermal_day(t, &subject, 96 + 53, day_k), STATUS_OK); /* 37.25 h: 13:15 */
    assert_true(at_time_k > 290.0f);
    assert_memory_equal(&day_k[SLOTS - 1], &at_time_k, sizeof at_time_k);
    thermal_free(t);
    weather_free(w);
}

static void a_day_ends_at_the_point_s_temperature(void **state)
{
    (void)state;
    assert_day_ends_at_temperature(NULL);
}

static void a_day_of_layers_ends_at_the_point_s_temperature(void **state)
{
    const layered_matter layered = layered_matter_default();

    (void)state;
    assert_day_ends_at_temperature(&layered);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_day_ends_at_the_point_s_temperature),
        cmocka_unit_test(a_day_of_layers_ends_at_the_point_s_temperature),
    };

    return cmocka_run_group_tests(tests, open_device, close_device);
}
