#include "../assert_near.h"
#include "../text_file.h"

#include "weather/weather.h"

#define KELVIN 273.15

/* Thesis Appendix A item 9, the first six records; the thesis' count is 193. */
static const char printed_start[] =
    "6      0.25\n"
    "0.00    7.8    1.0156e+3    .930    -1    1      0    0      0.0    5    1    .025    7\n"
    "0.25    7.8    1.0156e+3    .930    -1    1      0    0      0.0    5    1    .025    7\n"
    "0.50    7.8    1.0157e+3    .930    -1    1      0    0      0.0    5    1    .025    7\n"
    "0.75    7.8    1.0158e+3    .930    -1    1      0    0      0.0    5    1    .025    7\n"
    "1.00    7.8    1.0158e+3    .930    -1    1      0    0      0.0    5    0    0      0\n"
    "1.25    7.8    1.0159e+3    .930    -1    1      0    0      0.0    5    0    0      0\n";

/* The same, its last three. */
static const char printed_end[] =
    "3      0.25\n"
    "47.50   13.5    1.0098e+3    .770    -1    0.01    0    0      0.0    6    0    0      0\n"
    "47.75   13.7    1.0098e+3    .710    -1    0.02    0    0      0.0    6    0    0      0\n"
    "48.00   13.9    1.0098e+3    .687    -1    0.00    0    0      0.0    6    0    0      0\n";

static const char run_together[] = "2 0.25\n"
                                   "0.00-15.00 1.0156e+3 .930-1.5 1 60 30 1.0 0 0 0 0\n"
                                   "0.25-15.00 1.0156e+3 .930-1.5 1 60 30 1.0 0 0 0 0\n";

static weather *read_text(const char *text)
{
    weather *w = NULL;

    if (weather_read(&w, text_file(text)) != STATUS_OK) fail_msg("%s", status_message());
    return w;
}

static void the_printed_history_is_read_in_si(void **state)
{
    (void)state;
    weather *w = read_text(printed_start);
    const weather_record *r = &w->record[3];

    assert_int_equal(w->count, 6);
    assert_near(w->interval_s, 900, 0);
    assert_near(r->time_h, 0.75, 1e-12);
    assert_near(r->air_temperature_k, 7.8 + KELVIN, 1e-4); /* 273.15 in single precision */
    assert_near(r->pressure_pa, 101580, 1e-6);
    assert_near(r->relative_humidity, 0.93, 0);
    assert_near(r->wind_m_s, 1, 0);
    assert_near(r->sky_exposure, 0, 0);
    assert_int_equal(r->cloud_type, 5);
    assert_int_equal(r->precipitation_type, 1);
    assert_near(r->precipitation_m_s, 0.00025 / 3600, 1e-15);
    assert_near(r->precipitation_temperature_k, 7 + KELVIN, 1e-4);
    weather_free(w);
}

static void a_dew_point_of_minus_one_is_computed_from_the_humidity(void **state)
{
    (void)state;
    weather *w = read_text(printed_start);

    assert_near(weather_saturation_pa(w->record[0].dew_point_k),
                0.93 * weather_saturation_pa(w->record[0].air_temperature_k), 1e-6);
    weather_free(w);
}

static void columns_that_run_together_are_told_apart(void **state)
{
    (void)state;
    weather *w = read_text(run_together);

    assert_near(w->record[0].air_temperature_k, KELVIN - 15, 1e-4);
    assert_near(w->record[0].dew_point_k, KELVIN - 1.5, 1e-4);
    weather_free(w);
}

static void a_langley_an_hour_is_11_622_w_m2(void **state)
{
    (void)state;
    weather *w = read_text(run_together);

    assert_near(w->record[0].direct_w_m2, 60 * 41840.0 / 3600, 1e-3); /* single precision */
    assert_near(w->record[0].diffuse_w_m2, 30 * 41840.0 / 3600, 1e-3);
    weather_free(w);
}

/* WMO-No. 8: 23.37 hPa; steam tables: 23.39. */
static void air_of_20_c_holds_23_4_hpa_of_vapour(void **state)
{
    (void)state;
    assert_near(weather_saturation_pa(20 + KELVIN), 2338, 8);
}

static void a_history_that_ends_at_48_h_has_its_day_from_24_h(void **state)
{
    (void)state;
    weather *w = read_text(printed_end);
    const site place = {.time_s = 709311600, .utc_offset_min = -240}; /* 1992-06-23T11:00-04:00 */

    assert_near(weather_day_start_h(w), 24, 0);
    assert_near(weather_origin_s(w, &place), 709185600, 0); /* 1992-06-22T00:00-04:00 */
    weather_free(w);
}

static void a_history_of_one_day_has_its_day_from_its_start(void **state)
{
    (void)state;
    weather *w = NULL;

    assert_int_equal(weather_allocate(&w, 24, 3600), STATUS_OK);
    for (int i = 0; i < 24; i++) w->record[i].time_h = i;

    assert_near(weather_day_start_h(w), 0, 0);
    weather_free(w);
}

static void five_minutes_may_be_written_with_two_decimals(void **state)
{
    (void)state;
    weather *w =
        read_text("4 0.0833\n0.00 5 1e3 .5 -1 1 0 0 1 0 0 0 0\n0.08 5 1e3 .5 -1 1 0 0 1 0 0 0 "
                  "0\n0.17 5 1e3 .5 -1 1 0 0 1 0 0 0 0\n0.25 5 1e3 .5 -1 1 0 0 1 0 0 0 0\n");

    assert_near(w->interval_s, 300, 1e-9);
    assert_near(w->record[1].time_h, 1.0 / 12, 1e-12);
    weather_free(w);
}

static void what_is_written_reads_the_same(void **state)
{
    (void)state;
    weather *w = read_text(run_together), *again = NULL;

    w->record[1].dew_point_k = KELVIN - 1.0;
    assert_int_equal(weather_write(w, text_file_at), STATUS_OK);
    assert_int_equal(weather_read(&again, text_file_at), STATUS_OK);

    assert_int_equal(again->count, 2);
    for (int i = 0; i < 2; i++) {
        const weather_record *a = &w->record[i], *b = &again->record[i];
        assert_near(b->air_temperature_k, a->air_temperature_k, 6e-4); /* three decimals */
        assert_near(b->dew_point_k, a->dew_point_k, 1.1e-3);
        assert_near(b->direct_w_m2, a->direct_w_m2, 1e-3);
        assert_near(b->pressure_pa, a->pressure_pa, 1);
    }
    weather_free(w);
    weather_free(again);
}

static void assert_line_refused(const char *old, const char *new, int line, const char *expected)
{
    weather *w = NULL;

    assert_refused(weather_read(&w, text_file_with(printed_start, old, new)), line, expected);
    assert_null(w);
}

static void wrong_histories_are_refused_at_their_line(void **state)
{
    (void)state;
    assert_line_refused("6      0.25", "6 0.4", 1, "divides an hour");
    assert_line_refused("6      0.25", "6.5 0.25", 1, "number of records");
    assert_line_refused("6      0.25", "6", 1, "number of records");
    assert_line_refused("6      0.25", "5 0.25", 7, "the end of the file");
    assert_line_refused("6      0.25", "7 0.25", 8, "record 7 of 7: 13 numbers");
    assert_line_refused("0.75 ", "0.80 ", 5, "0.75 h");
    assert_line_refused(".025    7\n0.25", "7\n0.25", 2, "record 1 of 6: 13 numbers");
    assert_line_refused(".025    7\n0.25", ".025 7 7\n0.25", 2, "record 1 of 6: 13 numbers");
    assert_line_refused(".930", "93.0", 2, "relative humidity from 0 to 1 in column 4");
    assert_line_refused("1.0156e+3", "101560", 2, "pressure in mbar");
    assert_line_refused("5    1", "5.5 1", 2, "cloud type in column 10, a whole number");
    assert_line_refused("7.8 ", "warm", 2, "13 numbers");
    assert_line_refused("7.8 ", "-99.9 ", 2, "a flag of missing values");
}

static void a_file_that_is_not_there_is_named(void **state)
{
    (void)state;
    weather *w = NULL;

    assert_int_equal(weather_read(&w, "absent.wth"), STATUS_FILE);
    assert_non_null(strstr(status_message(), "absent.wth"));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_printed_history_is_read_in_si),
        cmocka_unit_test(a_dew_point_of_minus_one_is_computed_from_the_humidity),
        cmocka_unit_test(columns_that_run_together_are_told_apart),
        cmocka_unit_test(a_langley_an_hour_is_11_622_w_m2),
        cmocka_unit_test(air_of_20_c_holds_23_4_hpa_of_vapour),
        cmocka_unit_test(a_history_that_ends_at_48_h_has_its_day_from_24_h),
        cmocka_unit_test(a_history_of_one_day_has_its_day_from_its_start),
        cmocka_unit_test(five_minutes_may_be_written_with_two_decimals),
        cmocka_unit_test(what_is_written_reads_the_same),
        cmocka_unit_test(wrong_histories_are_refused_at_their_line),
        cmocka_unit_test(a_file_that_is_not_there_is_named),
    };

    return cmocka_run_group_tests(tests, text_file_setup, text_file_teardown);
}
