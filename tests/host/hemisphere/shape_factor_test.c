#include "../assert_near.h"

#include "hemisphere/shape_factor.h"

#include <setjmp.h>
#include <stdarg.h>
#include <stddef.h>
#include <stdlib.h>

#include <cmocka.h>

/* A grid's cells on the host, and those of it that stay when it is thinned. */
typedef struct grids {
    uint32_t count, thinned_count;
    float (*cell)[4], (*thinned)[4];
} grids;

static float (*download(device *dev, const hemisphere_grid *grid))[4]
{
    const uint32_t count = hemisphere_grid_cell_count(grid);
    float(*cell)[4] = malloc(count * sizeof *cell);

    assert_non_null(cell);
    assert_int_equal(device_download(dev, hemisphere_grid_cells(grid), 4 * count, cell[0]),
                     STATUS_OK);
    return cell;
}

static grids open_both(double azimuth_step_deg)
{
    device *dev = NULL;
    hemisphere_grid *grid = NULL, *thinned = NULL;
    grids out;

    assert_int_equal(device_open(&dev, -1), STATUS_OK);
    assert_int_equal(hemisphere_grid_open(&grid, dev, SHAPE_FACTOR_COSINE, 15.0, azimuth_step_deg),
                     STATUS_OK);
    assert_int_equal(hemisphere_grid_open_thinned(&thinned, dev, grid), STATUS_OK);
    out = (grids){hemisphere_grid_cell_count(grid), hemisphere_grid_cell_count(thinned),
                  download(dev, grid), download(dev, thinned)};
    hemisphere_grid_free(thinned);
    hemisphere_grid_free(grid);
    device_free(dev);
    return out;
}

static void free_both(grids g)
{
    free(g.thinned);
    free(g.cell);
}

/* The sum of weight x component^power over cells; component 3: of weights alone. */
static double moment(float (*cell)[4], uint32_t count, int component, int power)
{
    double sum = 0.0;

    for (uint32_t i = 0; i < count; i++) {
        double term = (double)cell[i][3];
        for (int p = 0; p < power; p++) term *= (double)cell[i][component];
        sum += term;
    }
    return sum;
}

static void a_sixth_of_the_cells_stays(void **state)
{
    grids g = open_both(30.0);

    (void)state;
    assert_int_equal(g.count, 72);
    assert_int_equal(g.thinned_count, 12);
    free_both(g);
}

/* In a hemisphere by cosine the means of upslope and across are 0, and of their squares those of the grid. */
static void thinned_cells_weigh_the_hemisphere_evenly(void **state)
{
    grids g = open_both(30.0);

    (void)state;
    assert_near(moment(g.thinned, 12, 3, 0), 1.0, 1e-6);
    for (int k = 0; k < 2; k++) {
        assert_near(moment(g.thinned, 12, k, 1), 0.0, 1e-6);
        assert_near(moment(g.thinned, 12, k, 2), moment(g.cell, 72, k, 2), 1e-6);
    }
    assert_near(moment(g.thinned, 12, 2, 1), moment(g.cell, 72, 2, 1), 1e-6);
    free_both(g);
}

/* A wall under an open sky sees it with half of its hemisphere. */
static void half_of_the_weights_are_upslope(void **state)
{
    grids g = open_both(30.0);
    double up = 0.0;

    (void)state;
    for (uint32_t i = 0; i < g.thinned_count; i++)
        if (g.thinned[i][0] > 0.0f) up += (double)g.thinned[i][3];
    assert_near(up, 0.5, 1e-6);
    free_both(g);
}

static void rings_of_few_cells_stay_whole(void **state)
{
    grids g = open_both(45.0), six = open_both(60.0);

    (void)state;
    assert_int_equal(g.thinned_count, g.count);
    assert_int_equal(six.thinned_count, six.count);
    assert_near(moment(six.thinned, six.count, 3, 0), 1.0, 1e-6);
    free_both(six);
    free_both(g);
}

/* Rings of 24 keep 4 cells and then all of them. */
static void a_thinned_grid_can_be_thinned(void **state)
{
    device *dev = NULL;
    hemisphere_grid *grid = NULL, *thinned = NULL, *part = NULL, *twice = NULL;
    float(*cell)[4];

    (void)state;
    assert_int_equal(device_open(&dev, -1), STATUS_OK);
    assert_int_equal(hemisphere_grid_open(&grid, dev, SHAPE_FACTOR_COSINE, 15.0, 15.0), STATUS_OK);
    assert_int_equal(hemisphere_grid_open_thinned(&thinned, dev, grid), STATUS_OK);
    assert_int_equal(hemisphere_grid_open_thinned(&twice, dev, thinned), STATUS_OK);
    assert_int_equal(hemisphere_grid_cell_count(twice), 6 * 4);
    cell = download(dev, twice);
    assert_near(moment(cell, 6 * 4, 3, 0), 1.0, 1e-6);
    free(cell);
    hemisphere_grid_free(twice);
    assert_int_equal(hemisphere_grid_open_part(&part, dev, grid, 0, 4), STATUS_OK);
    assert_int_equal(hemisphere_grid_open_thinned(&twice, dev, part), STATUS_OK);
    hemisphere_grid_free(twice);
    hemisphere_grid_free(part);
    hemisphere_grid_free(thinned);
    hemisphere_grid_free(grid);
    device_free(dev);
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(a_sixth_of_the_cells_stays),
        cmocka_unit_test(thinned_cells_weigh_the_hemisphere_evenly),
        cmocka_unit_test(half_of_the_weights_are_upslope),
        cmocka_unit_test(rings_of_few_cells_stay_whole),
        cmocka_unit_test(a_thinned_grid_can_be_thinned),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
