#include "../assert_near.h"
#include "../scratch_folder.h"

#include "hemisphere/view_factor.h"
#include "tree/bvh.h"

enum { SIDE = 6, EACH = SIDE * SIDE }; /* facets of a unit square */

/* Writes a unit square of SIDE x SIDE facets: corner + (i along + j across) / SIDE; its front looks
 * along the product of both. */
static void write_square(FILE *stream, const double corner[3], const double along[3],
                         const double across[3], int first)
{
    const int row = SIDE + 1;

    for (int j = 0; j <= SIDE; j++)
        for (int i = 0; i <= SIDE; i++) {
            fprintf(stream, "v");
            for (int k = 0; k < 3; k++)
                fprintf(stream, " %.9g", corner[k] + (i * along[k] + j * across[k]) / SIDE);
            fprintf(stream, "\n");
        }
    fprintf(stream, "usemtl plate\n");
    for (int j = 0; j < SIDE; j++)
        for (int i = 0; i < SIDE; i++) {
            const int at = first + j * row + i + 1;
            fprintf(stream, "f %d %d %d %d\n", at, at + 1, at + row + 1, at + row);
        }
}

/* The views in a scene of a level unit square that looks up, and another one. */
static view_factors *trace(const double corner[3], const double along[3], const double across[3])
{
    static const double origin[3] = {0, 0, 0}, east[3] = {1, 0, 0}, north[3] = {0, 1, 0};
    const geometry_instance instance = {.path = scratch_path("squares.obj"), .scale = 1.0};
    FILE *stream = fopen(instance.path, "wb");
    geometry *g = NULL;
    bvh *tree = NULL;
    device *dev = NULL;
    ray_scene *rays = NULL;
    hemisphere_grid *grid = NULL;
    view_factors *f = NULL;

    assert_non_null(stream);
    write_square(stream, origin, east, north, 0);
    write_square(stream, corner, along, across, (SIDE + 1) * (SIDE + 1));
    fclose(stream);
    assert_int_equal(geometry_read(&g, &instance, 1), STATUS_OK);
    const bvh_source source = {.facet_count = g->facet_count,
                               .corner = (const uint32_t(*)[4])g->corner,
                               .position = (const float(*)[3])g->position};
    assert_int_equal(bvh_build(&tree, &source), STATUS_OK);
    assert_int_equal(device_open(&dev, -1), STATUS_OK);
    assert_int_equal(ray_scene_open(&rays, dev, &tree), STATUS_OK);
    assert_int_equal(hemisphere_grid_open(&grid, dev, SHAPE_FACTOR_COSINE, 2.0, 3.0), STATUS_OK);
    if (view_factor_trace(&f, rays, grid, g, g->facet_count) != STATUS_OK)
        fail_msg("%s", status_message());
    hemisphere_grid_free(grid);
    ray_scene_free(rays);
    device_free(dev);
    bvh_free(tree);
    geometry_free(g);
    return f;
}

/* The view factor from one square to the other: the mean over its facets, which are equal. */
static double mean_factor(const view_factors *f, uint32_t from)
{
    double sum = 0.0;

    for (uint32_t i = from; i < from + EACH; i++)
        for (uint32_t k = 0; k < f->view[i].count; k++)
            sum += (double)f->fraction[f->view[i].first + k] / EACH;
    return sum;
}

/* 0.199825 and 0.200044, closed forms; 2 % is what 5400 rays are trusted for. */
static void unit_squares_a_unit_apart_see_a_fifth_of_each_other(void **state)
{
    static const double corner[3] = {0, 0, 1}, along[3] = {0, 1, 0}, across[3] = {1, 0, 0};
    view_factors *f = trace(corner, along, across);

    (void)state;
    assert_near(mean_factor(f, 0), 0.199825, 0.02 * 0.199825);
    assert_near(mean_factor(f, EACH), 0.199825, 0.02 * 0.199825);
    view_factor_free(f);
}

static void unit_squares_with_a_common_edge_see_a_fifth_of_each_other(void **state)
{
    /* On the west edge, looking east. */
    static const double corner[3] = {0, 0, 0}, along[3] = {0, 1, 0}, across[3] = {0, 0, 1};
    view_factors *f = trace(corner, along, across);

    (void)state;
    assert_near(mean_factor(f, 0), 0.200044, 0.02 * 0.200044);
    assert_near(mean_factor(f, EACH), 0.200044, 0.02 * 0.200044);
    view_factor_free(f);
}

static void sky_below_and_facets_fill_the_view(void **state)
{
    static const double corner[3] = {0, 0, 0}, along[3] = {0, 1, 0}, across[3] = {0, 0, 1};
    view_factors *f = trace(corner, along, across);

    (void)state;
    for (uint32_t i = 0; i < 2 * EACH; i++) {
        const view_record *v = &f->view[i];
        double sum = (double)v->sky + (double)v->below;
        for (uint32_t k = 0; k < v->count; k++) sum += (double)f->fraction[v->first + k];
        assert_near(sum, 1.0, 1e-3); /* the notes' bound */
    }
    /* A level facet sees nothing below, a wall half of its view if nothing stands there. */
    assert_near((double)f->view[0].below, 0.0, 1e-6);
    assert_true((double)f->view[EACH].below > 0.1);
    view_factor_free(f);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(unit_squares_a_unit_apart_see_a_fifth_of_each_other),
        cmocka_unit_test(unit_squares_with_a_common_edge_see_a_fifth_of_each_other),
        cmocka_unit_test(sky_below_and_facets_fill_the_view),
    };

    return cmocka_run_group_tests(tests, scratch_setup, scratch_teardown);
}
