#include "material/layered.h"

#include "../assert_near.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>

#include <cmocka.h>

static const material_record asphalt = {
    .density_kg_m3 = 2000.0f, .specific_heat_j_kg_k = 900.0f, .conductivity_w_m_k = 0.7f};

static layered_record filled(const layered_matter *matter, const material_record *material)
{
    const facet_record facet = {.normal = {0.0f, 0.0f, 1.0f}, .thickness_m = 0.05f};
    layered_record out;

    layered_fill(&out, &facet, material, matter, 288.0);
    return out;
}

static double capacity(const layered_record *r)
{
    double sum = 0.0;

    for (int i = 0; i < FACET_NODES; i++) sum += (double)r->capacity_j_m2_k[i];
    return sum;
}

static double resistance(const layered_record *r)
{
    double sum = 0.0;

    for (int i = 0; i <= FACET_NODES; i++) sum += 1.0 / (double)r->conductance_w_m2_k[i];
    return sum;
}

static void a_ladder_holds_the_capacity_and_resistance_of_its_layers(void **state)
{
    layered_matter matter = layered_matter_default();

    (void)state;
    matter.layer_count = 2;
    matter.layer[0] = (layered_layer){0.02, 0.04, 5e4};
    matter.layer[1] = (layered_layer){0.30, 1.2, 2e6};
    const layered_record r = filled(&matter, &asphalt);

    assert_near(capacity(&r), 0.05 * 1.8e6 + 0.02 * 5e4 + 0.30 * 2e6, 1.0);
    assert_near(resistance(&r), 0.05 / 0.7 + 0.02 / 0.04 + 0.30 / 1.2, 1e-6);
}

static void a_node_is_half_as_thick_again_as_the_one_before(void **state)
{
    const layered_matter matter = layered_matter_default();
    const layered_record r = filled(&matter, &asphalt);

    (void)state;
    for (int i = 1; i < FACET_NODES; i++)
        assert_near((double)(r.capacity_j_m2_k[i] / r.capacity_j_m2_k[i - 1]), 1.5, 1e-5);
}

static void ground_reaches_to_a_metre_and_keeps_the_mean_of_the_air(void **state)
{
    layered_matter matter = layered_matter_default();

    (void)state;
    matter.back = LAYERED_BACK_GROUND;
    const layered_record r = filled(&matter, &asphalt);

    assert_near(capacity(&r), 1.8e6, 2.0);
    assert_int_equal(r.back, LAYERED_STATED);
    assert_near((double)r.back_k, 288.0, 1e-4);
}

static void matter_without_conductivity_is_one_lump(void **state)
{
    const layered_matter matter = layered_matter_default();
    material_record water = asphalt;

    (void)state;
    water.conductivity_w_m_k = 0.0f;
    const layered_record r = filled(&matter, &water);

    assert_true(resistance(&r) < 1e-3);
    assert_near(capacity(&r), 0.05 * 1.8e6, 0.1);
}

static void the_back_is_in_air_where_both_sides_are_exposed(void **state)
{
    const layered_matter matter = layered_matter_default();
    material_record sheet = asphalt;

    (void)state;
    sheet.exposed_area = 0.53f;
    assert_int_equal(filled(&matter, &sheet).back, LAYERED_ADIABATIC);
    sheet.exposed_area = -0.9f;
    assert_int_equal(filled(&matter, &sheet).back, LAYERED_AIR);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_ladder_holds_the_capacity_and_resistance_of_its_layers),
        cmocka_unit_test(a_node_is_half_as_thick_again_as_the_one_before),
        cmocka_unit_test(ground_reaches_to_a_metre_and_keeps_the_mean_of_the_air),
        cmocka_unit_test(matter_without_conductivity_is_one_lump),
        cmocka_unit_test(the_back_is_in_air_where_both_sides_are_exposed),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
