#include "../assert_near.h"
#include "../scratch_folder.h"

#include "thermal/conduction.h"

/* A row of four squares of a metre, the last of a second material. */
static const char row[] = "v 0 0 0\nv 1 0 0\nv 2 0 0\nv 3 0 0\nv 4 0 0\n"
                          "v 0 1 0\nv 1 1 0\nv 2 1 0\nv 3 1 0\nv 4 1 0\n"
                          "usemtl steel\nf 1 2 7 6\nf 2 3 8 7\nf 3 4 9 8\n"
                          "usemtl wood\nf 4 5 10 9\n";

/* Reads the row; facets are 0.1 m thick. Returns the patches of a conductivity. */
static conduction_map *find(float conductivity_w_m_k, facet_record *facet)
{
    const geometry_instance instance = {.path = scratch_path("row.obj"), .scale = 1.0};
    const material_record material[2] = {{.conductivity_w_m_k = conductivity_w_m_k},
                                         {.conductivity_w_m_k = conductivity_w_m_k}};
    FILE *stream = fopen(instance.path, "wb");
    geometry *g = NULL;
    conduction_map *map = NULL;

    assert_non_null(stream);
    fputs(row, stream);
    fclose(stream);
    assert_int_equal(geometry_read(&g, &instance, 1), STATUS_OK);
    for (uint32_t i = 0; i < 4; i++) {
        facet[i].material = g->material[i];
        facet[i].thickness_m = 0.1f;
    }
    assert_int_equal(conduction_find(&map, g, facet, material), STATUS_OK);
    geometry_free(g);
    return map;
}

static const conduction_record *link_of(const conduction_map *map, uint32_t facet, uint32_t *place)
{
    for (*place = 0; map->facet[*place] != facet; ++*place) assert_true(*place < map->count);
    return &map->link[*place];
}

static void squares_of_a_material_are_one_patch_filled_up_to_sixteen(void **state)
{
    facet_record facet[4] = {{.two_sided = 0}};
    conduction_map *map = find(50.0f, facet);

    (void)state;
    assert_int_equal(map->patch_count, 1);
    assert_int_equal(map->count, 16);
    conduction_free(map);
}

/* k d w / distance = 50 x 0.1 x 1 / 1 */
static void neighbours_are_linked_by_k_d_w_over_their_distance(void **state)
{
    facet_record facet[4] = {{.two_sided = 0}};
    conduction_map *map = find(50.0f, facet);
    uint32_t first, middle;
    const conduction_record *end = link_of(map, 0, &first), *between = link_of(map, 1, &middle);
    double sum = 0.0;

    (void)state;
    for (int k = 0; k < 4; k++) sum += (double)between->link_w_k[k];
    assert_near(sum, 10.0, 1e-5); /* float */
    for (int k = 0; k < 4; k++)
        if (end->neighbour[k] != RECORD_NONE) assert_int_equal(end->neighbour[k], middle);
    conduction_free(map);
}

static void a_material_that_hardly_conducts_makes_no_patch(void **state)
{
    facet_record facet[4] = {{.two_sided = 0}};
    conduction_map *map = find(0.1f, facet); /* 0.01 W/m2/K, half of what counts */

    (void)state;
    assert_int_equal(map->patch_count, 0);
    assert_int_equal(map->count, 0);
    conduction_free(map);
}

static void a_facet_that_states_a_temperature_parts_a_patch_and_is_felt(void **state)
{
    facet_record facet[4] = {[1] = {.stated_temperature_k = 350.0f}};
    conduction_map *map = find(50.0f, facet);
    uint32_t place;
    const conduction_record *end = link_of(map, 0, &place);

    (void)state;
    assert_int_equal(map->patch_count, 2);
    assert_near((double)end->stated_w_k, 5.0, 1e-5); /* float */
    assert_near((double)end->stated_k, 350.0, 1e-3);
    conduction_free(map);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(squares_of_a_material_are_one_patch_filled_up_to_sixteen),
        cmocka_unit_test(neighbours_are_linked_by_k_d_w_over_their_distance),
        cmocka_unit_test(a_material_that_hardly_conducts_makes_no_patch),
        cmocka_unit_test(a_facet_that_states_a_temperature_parts_a_patch_and_is_felt),
    };

    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
