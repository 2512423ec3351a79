#include "../assert_near.h"

#include "material/emissivity_law.h"

/* Water at 10 um (Hale and Querry), n 1.2180, k 0.0508, and glass of n 1.5: Fresnel's formulas in double, by hand:
 * at the normal 1 - ((n-1)^2 + k^2) / ((n+1)^2 + k^2). */
static void optical_constants_give_fresnels_emissivity(void **state)
{
    (void)state;
    assert_near(emissivity_law_optical(1.218, .0508, 0.0), .98982, 5e-6);
    assert_near(emissivity_law_optical(1.218, .0508, 60.0), .96124, 5e-6);
    assert_near(emissivity_law_optical(1.218, .0508, 80.0), .69723, 5e-6);
    assert_near(emissivity_law_optical(1.5, 0.0, 0.0), .96, 1e-12);
    assert_near(emissivity_law_optical(1.5, 0.0, 80.0), .612296, 1e-6);
    assert_near(emissivity_law_optical(1.5, 0.0, 90.0), 0.0, 0.0);
}

/* n 1.5 has the normal emissivity 0.96. */
static void a_dielectric_is_known_by_its_normal_emissivity(void **state)
{
    (void)state;
    for (double angle = 0.0; angle <= 90.0; angle += 10.0)
        assert_near(emissivity_law_fresnel(.96, angle), emissivity_law_optical(1.5, 0.0, angle),
                    1e-12);
    assert_near(emissivity_law_fresnel(0.0, 30.0), 0.0, 0.0);
    assert_near(emissivity_law_fresnel(1.0, 30.0), 1.0, 1e-12);
}

static void rough_ground_keeps_its_emissivity(void **state)
{
    (void)state;
    for (double angle = 0.0; angle <= 65.0; angle += 5.0)
        assert_true(emissivity_law_rough(.9, angle) > .97 * .9);
    assert_true(emissivity_law_rough(.9, 85.0) > .9 * .9);
    assert_near(emissivity_law_rough(.9, 0.0), .9, 0.0);
}

static void the_thesis_law_falls_to_0(void **state)
{
    (void)state;
    assert_near(emissivity_law_thesis(.9, 60.0), .9, 1e-12);
    assert_near(emissivity_law_thesis(.9, 80.0), .45, 1e-12); /* cos 60 */
    assert_near(emissivity_law_thesis(.9, 90.0), 0.0, 0.0);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(optical_constants_give_fresnels_emissivity),
        cmocka_unit_test(a_dielectric_is_known_by_its_normal_emissivity),
        cmocka_unit_test(rough_ground_keeps_its_emissivity),
        cmocka_unit_test(the_thesis_law_falls_to_0),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
