#include "../assert_near.h"

#include "station/date_text.h"

static void dates_are_read_in_every_layout(void **state)
{
    static const struct {
        const char *text;
        weather_date date;
        double offset_h; /* not-a-number: none */
    } known[] = {
        {"2019-01-31", {2019, 1, 31, 0.0}, NAN},
        {"2019-01-31T12:30:00Z", {2019, 1, 31, 12.5}, 0.0},
        {"2019-01-31 12:30", {2019, 1, 31, 12.5}, NAN},
        {"2019-01-31 12:30:00-07:00", {2019, 1, 31, 12.5}, -7.0},
        {"2019-01-31T12:30+0530", {2019, 1, 31, 12.5}, 5.5},
        {"2019-01-31T24:00", {2019, 1, 31, 24.0}, NAN},
        {"2019/1/31 1:30", {2019, 1, 31, 1.5}, NAN},
        {"01/31/2019", {2019, 1, 31, 0.0}, NAN},
        {"20190131:1230", {2019, 1, 31, 12.5}, NAN},
        {"2020-02-29 00:00:00.000", {2020, 2, 29, 0.0}, NAN},
    };

    (void)state;
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        weather_date date;
        double offset_h;
        if (!date_text_read(known[i].text, &date, &offset_h)) fail_msg("'%s'", known[i].text);
        assert_int_equal(date.year, known[i].date.year);
        assert_int_equal(date.month, known[i].date.month);
        assert_int_equal(date.day, known[i].date.day);
        assert_near(date.hour, known[i].date.hour, 1e-12);
        assert_true(isnan(offset_h) ? isnan(known[i].offset_h) : offset_h == known[i].offset_h);
    }
}

static void what_is_no_date_is_not_read(void **state)
{
    static const char *const texts[] = {
        "",         "2019",       "2019-13-01", "2019-02-30",          "2019-01-31T25:00",
        "12:30",    "31/01/2019", "1e5",        "2019-01-31T24:30",    "2019-01-31 12:30 local",
        "19-01-31", "2019-1",     "tomorrow",   "2019-01-31T12:30+7x", "99999999999999999999",
    };
    weather_date date;
    double offset_h;

    (void)state;
    for (size_t i = 0; i < sizeof texts / sizeof *texts; i++)
        if (date_text_read(texts[i], &date, &offset_h)) fail_msg("'%s' is read", texts[i]);
}

static void a_time_is_added_to_a_date(void **state)
{
    weather_date date = {1988, 1, 1, 0.0};

    (void)state;
    assert_true(date_text_add_time("24:00", &date));
    assert_near(date.hour, 24.0, 0.0);
    assert_true(date_text_add_time("1:30", &date));
    assert_near(date.hour, 1.5, 0.0);
    assert_false(date_text_add_time("noon", &date));
    assert_false(date_text_add_time("12:75", &date));
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(dates_are_read_in_every_layout),
        cmocka_unit_test(what_is_no_date_is_not_read),
        cmocka_unit_test(a_time_is_added_to_a_date),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
