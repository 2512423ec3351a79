#include "material/lobe.h"

#include "../assert_near.h"
#include "kernels/radiance/lobe.h"
#include "material/emissivity.h"

enum { RINGS = 6 };

static const double radian = 0.017453292519943295;

/* One sample; e as a function of the angle. */
static void fill(double (*of_angle)(double theta_rad), float *out)
{
    float table[EMISSIVITY_ANGLES];

    for (int a = 0; a < EMISSIVITY_ANGLES; a++) table[a] = (float)of_angle(a * radian);
    lobe_fill(table, 1, RINGS, out);
}

static double grey(double theta_rad)
{
    (void)theta_rad;
    return .7;
}

static double black(double theta_rad)
{
    (void)theta_rad;
    return 1.0;
}

/* It reflects the cosine of the angle. */
static double falling(double theta_rad)
{
    return 1.0 - cos(theta_rad);
}

static void a_surface_without_angles_is_lambertian(void **state)
{
    float rows[LOBE_ROWS + RINGS];

    (void)state;
    fill(grey, rows);

    for (int r = 0; r < RINGS; r++)
        assert_near((double)rows[LOBE_ROWS + r], 1.0, 1e-6); /* float32 */
    assert_near((double)rows[0], 1.0 / .3, 1e-5);
}

static void a_black_surface_divides_by_nothing(void **state)
{
    float rows[LOBE_ROWS + RINGS];

    (void)state;
    fill(black, rows);

    for (int r = 0; r < RINGS; r++) assert_near((double)rows[LOBE_ROWS + r], 1.0, 0.0);
    assert_near((double)rows[0], 0.0, 0.0);
}

static void rings_are_integrals_over_equal_parts_of_the_hemisphere(void **state)
{
    float rows[LOBE_ROWS + RINGS];

    (void)state;
    fill(falling, rows);

    /* 1 - e_hemi = 2 integral cos^2 sin = 2/3; between degrees a line is 4e-5 below the cosine. */
    assert_near((double)rows[0], 1.5, 1e-4);
    for (int r = 0; r < RINGS; r++) {
        const double high = sqrt((r + 1.0) / RINGS), low = sqrt((double)r / RINGS);
        const double mean =
            (2.0 / 3.0) * (pow(high, 3) - pow(low, 3)) / (pow(high, 2) - pow(low, 2));
        assert_near((double)rows[LOBE_ROWS + r], 1.5 * mean, 1e-4);
    }
}

static void rings_of_equal_weights_make_up_one(void **state)
{
    float rows[LOBE_ROWS + RINGS];
    double sum = 0.0;

    (void)state;
    fill(falling, rows);

    for (int r = 0; r < RINGS; r++) sum += (double)rows[LOBE_ROWS + r] / RINGS;
    assert_near(sum, 1.0, 1e-6); /* float32 rows */
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_surface_without_angles_is_lambertian),
        cmocka_unit_test(a_black_surface_divides_by_nothing),
        cmocka_unit_test(rings_are_integrals_over_equal_parts_of_the_hemisphere),
        cmocka_unit_test(rings_of_equal_weights_make_up_one),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
