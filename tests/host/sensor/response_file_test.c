#include "../assert_near.h"
#include "../text_file.h"

#include "sensor/response_file.h"

/* Thesis Appendix A item 5: it announces 6 points and prints 7. */
static const char printed[] = "6\n1.0\n0.0\n1.0000000\n1.0000000\n1.0000000\n1.0000000\n1.0000000\n"
                              "1.0000000\n1.0000000\n";

static int forget_warnings(void **state)
{
    (void)state;
    status_warnings();
    return 0;
}

static void the_printed_response_has_as_many_points_as_it_announces(void **state)
{
    response_file *s = NULL;

    (void)state;
    assert_int_equal(response_file_read(&s, text_file(printed)), STATUS_OK);

    assert_int_equal(s->count, 6);
    for (int i = 0; i < 6; i++) assert_near(s->response[i], 1.0, 0.0);
    assert_near(s->offset, 0.0, 0.0);
    response_file_free(s);
}

static void a_surplus_response_is_a_warning_with_its_line(void **state)
{
    response_file *s = NULL;

    (void)state;
    assert_int_equal(response_file_read(&s, text_file(printed)), STATUS_OK);

    assert_non_null(strstr(status_warnings(), "file:10: 1 responses more than the 6"));
    response_file_free(s);
}

static void the_gain_is_turned_to_watts_per_square_metre(void **state)
{
    response_file *s = NULL;

    (void)state;
    assert_int_equal(response_file_read(&s, text_file("2\n5e4\n-3\n.5\n1\n")), STATUS_OK);

    assert_near(s->gain, 5.0, 1e-12); /* 1 W/m2 is 1e-4 W/cm2; double */
    assert_near(s->offset, -3.0, 0.0);
    assert_string_equal(status_warnings(), "");
    response_file_free(s);
}

static void a_wrong_response_is_refused_at_its_line(void **state)
{
    response_file *s = NULL;

    (void)state;
    assert_refused(response_file_read(&s, text_file("0\n1\n0\n")), 1, "the number of points");
    assert_refused(response_file_read(&s, text_file("2\nx\n0\n")), 2, "the gain");
    assert_refused(response_file_read(&s, text_file("2\n1\n0\n1\n1.2\n")), 5,
                   "a response from 0 to 1");
    assert_refused(response_file_read(&s, text_file("3\n1\n0\n1\n1\n")), 6, "the file ends");
    assert_refused(response_file_read(&s, text_file("1\n1\n0\n1\n7\n")), 5,
                   "a response from 0 to 1");
    assert_null(s);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test_setup(the_printed_response_has_as_many_points_as_it_announces,
                               forget_warnings),
        cmocka_unit_test_setup(a_surplus_response_is_a_warning_with_its_line, forget_warnings),
        cmocka_unit_test_setup(the_gain_is_turned_to_watts_per_square_metre, forget_warnings),
        cmocka_unit_test_setup(a_wrong_response_is_refused_at_its_line, forget_warnings),
    };

    return cmocka_run_group_tests_name("sensor", tests, text_file_setup, text_file_teardown);
}
