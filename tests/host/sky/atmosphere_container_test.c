#include "../assert_near.h"
#include "../text_file.h"

#include "sky/atmosphere.h"
#include "sky/atmosphere_container.h"

#include <stdlib.h>

static const char shipped[] = "scenes/airport/june24_1500z.rad";

static void the_database_of_appendix_a_holds_the_printed_sky(void **state)
{
    (void)state;
    /* Zenith 0, azimuth 0; zenith 90, azimuth 330; zenith 90, azimuth 360: emitted, scattered. */
    static const double printed[3][6][2] = {{{5.640259e-04, 3.054148e-08},
                                             {2.682229e-04, 1.725970e-07},
                                             {3.587178e-04, 5.711591e-08},
                                             {2.350089e-04, 8.457958e-08},
                                             {3.196508e-04, 3.774817e-08},
                                             {5.941062e-04, 3.755530e-09}},
                                            {{7.817543e-04, 9.089405e-09},
                                             {8.279369e-04, 2.169033e-07},
                                             {8.600907e-04, 7.488151e-08},
                                             {8.496127e-04, 1.125547e-07},
                                             {8.146524e-04, 3.458716e-08},
                                             {7.261701e-04, 2.290112e-09}},
                                            {{7.817543e-04, 9.447878e-09},
                                             {8.279369e-04, 2.216825e-07},
                                             {8.600907e-04, 7.631789e-08},
                                             {8.496127e-04, 1.144063e-07},
                                             {8.146524e-04, 3.539452e-08},
                                             {7.261701e-04, 2.378127e-09}}};
    static const int direction[3] = {0, 6 * 13 + 11, 6 * 13 + 12};
    atmosphere *a = NULL;

    assert_int_equal(atmosphere_read(&a, "scenes/atmosphere/appendix_a.rad"), STATUS_OK);

    for (int d = 0; d < 3; d++)
        for (int i = 0; i < 6; i++) {
            const int at = direction[d] * a->point_count + i;
            /* seven digits are printed; another compiler moved float32 sums by 6e-6 */
            assert_near(a->sky_emitted_direction[at], 1e4 * printed[d][i][0],
                        1e-5 * 1e4 * printed[d][i][0]);
            assert_near(a->sky_scattered_direction[at], 1e4 * printed[d][i][1],
                        1e-5 * 1e4 * printed[d][i][1]);
        }
    assert_near(a->sky_emitted[4], 4.244644, 4.3e-5);
    assert_near(a->sky_emitted[5], 6.339446, 6.4e-5);
    assert_near(a->sky_scattered[4], 1.888577e-4, 1.9e-9);
    assert_near(a->sky_scattered[5], 1.547239e-5, 1.6e-10);
    atmosphere_free(a);
}

static void a_container_gives_back_what_was_written(void **state)
{
    (void)state;
    const char *const path = text_file_at;
    atmosphere *a = NULL, *b = NULL;

    assert_int_equal(atmosphere_read(&a, shipped), STATUS_OK);
    assert_int_equal(atmosphere_container_write(a, path), STATUS_OK);
    assert_int_equal(atmosphere_read(&b, path), STATUS_OK);

    assert_string_equal(b->header, a->header);
    assert_int_equal(b->point_count, a->point_count);
    for (int i = 0; i < a->zenith_count * a->azimuth_count * a->point_count; i++)
        assert_near(b->sky_emitted_direction[i], a->sky_emitted_direction[i],
                    1e-7 * a->sky_emitted_direction[i]); /* float32 */
    for (int i = 0; i < a->path_count * a->point_count; i++)
        assert_near(b->tau2[i], a->tau2[i], 1e-7);
    assert_near(b->level_temperature_k[0], 294.2, 2e-5); /* half a float32 step */
    atmosphere_free(a);
    atmosphere_free(b);
}

static void a_container_cut_short_is_refused(void **state)
{
    (void)state;
    const char *const path = text_file_at;
    atmosphere *a = NULL;

    assert_int_equal(atmosphere_read(&a, shipped), STATUS_OK);
    assert_int_equal(atmosphere_container_write(a, path), STATUS_OK);
    atmosphere_free(a);
    a = NULL;
    assert_int_equal(truncate(path, 40000), 0);

    assert_int_equal(atmosphere_read(&a, path), STATUS_FORMAT);
    assert_non_null(strstr(status_message(), "bytes of numbers"));
    assert_null(a);
}

/* The shipped database as a container with one key of its object changed. */
static status read_changed(const char *key, const char *value)
{
    atmosphere *a = NULL;
    char *text = NULL, *at, stated[64];
    size_t size = 0;
    FILE *file;

    assert_int_equal(atmosphere_read(&a, shipped), STATUS_OK);
    assert_int_equal(atmosphere_container_write(a, text_file_at), STATUS_OK);
    atmosphere_free(a);
    file = fopen(text_file_at, "rb");
    assert_true(getdelim(&text, &size, '}', file) > 0);
    fclose(file);
    snprintf(stated, sizeof stated, "\"%s\": ", key);
    at = strstr(text, stated);
    assert_non_null(at);
    at += strlen(stated);
    file = fopen(text_file_at, "wb");
    fprintf(file, "%.*s%s%s", (int)(at - text), text, value,
            at + strcspn(at, *value == '[' ? "]" : ",\n") + (*value == '['));
    fputc('\n', file);
    fclose(file);
    free(text);
    a = NULL;
    const status rc = atmosphere_read(&a, text_file_at);
    assert_null(a);
    return rc;
}

static void a_number_of_a_container_has_its_range(void **state)
{
    static const struct {
        const char *key, *value, *expected;
    } wrong[] = {
        {"sensor_altitude_m", "nan", ":4: invalid token near 'nan'"},
        {"sensor_altitude_m", "1e300", "from 0 to 1e+06"},
        {"sensor_altitude_m", "-5", "from 0 to 1e+06"},
        {"path_zenith_meaningful_deg", "\"9\"", "expected a number"},
        {"path_zenith_meaningful_deg", "91", "from 0 to 90"},
        {"zenith_step_deg", "inf", "invalid token near 'inf'"},
        {"zenith_step_deg", "1e999", "real number overflow"},
        {"zenith_step_deg", "0x5", "expected"},
        {"zenith_step_deg", "5, \"zenith_step_deg\": 5", "duplicate object key"},
        {"header", "[1]", "expected a list of strings"},
        {"path_count", "2.5", "whole number"},
    };

    (void)state;
    for (size_t i = 0; i < sizeof wrong / sizeof *wrong; i++) {
        assert_int_equal(read_changed(wrong[i].key, wrong[i].value), STATUS_FORMAT);
        if (!strstr(status_message(), wrong[i].expected))
            fail_msg("'%s' lacks '%s'", status_message(), wrong[i].expected);
    }
}

static void the_object_of_a_container_may_be_laid_out_in_any_way(void **state)
{
    atmosphere *a = NULL;
    char *text = NULL;
    size_t size = 0;
    ssize_t length;
    FILE *file;

    (void)state;
    assert_int_equal(atmosphere_read(&a, shipped), STATUS_OK);
    a->header[0] = '#';
    a->header[1] = '\xe9'; /* Latin-1 */
    assert_int_equal(atmosphere_container_write(a, text_file_at), STATUS_OK);
    file = fopen(text_file_at, "rb+");
    length = getdelim(&text, &size, '}', file);
    assert_true(length > 0);
    for (char *c = strchr(text, '{') + 1; c < text + length; c++)
        if (*c == '\n') *c = ' ';
    rewind(file);
    fwrite(text, 1, (size_t)length, file);
    fclose(file);
    free(text);

    atmosphere *b = NULL;
    assert_int_equal(atmosphere_read(&b, text_file_at), STATUS_OK);

    assert_int_equal(b->point_count, a->point_count);
    assert_memory_equal(b->header, "#\xc3\xa9", 3);
    atmosphere_free(a);
    atmosphere_free(b);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(the_database_of_appendix_a_holds_the_printed_sky),
        cmocka_unit_test_setup_teardown(a_container_gives_back_what_was_written, text_file_setup,
                                        text_file_teardown),
        cmocka_unit_test_setup_teardown(a_container_cut_short_is_refused, text_file_setup,
                                        text_file_teardown),
        cmocka_unit_test_setup_teardown(a_number_of_a_container_has_its_range, text_file_setup,
                                        text_file_teardown),
        cmocka_unit_test_setup_teardown(the_object_of_a_container_may_be_laid_out_in_any_way,
                                        text_file_setup, text_file_teardown),
    };
    return cmocka_run_group_tests(tests, NULL, NULL);
}
