#include "hemisphere/hemisphere_strata.h"

#include "../assert_near.h"

#include <math.h>

enum {
    RINGS = 3,
    AZIMUTHS = 5,
    CELLS = RINGS * AZIMUTHS,
    ROUNDS = 3,
    SETS = ROUNDS * HEMISPHERE_SETS
};

static float cell[SETS][CELLS][4];

/* Where a direction lies in its cell, 0 .. 1: down the ring, along it. */
static void place_in(const float direction[4], uint32_t c, double out[2])
{
    const double level =
        (double)direction[0] * (double)direction[0] + (double)direction[1] * (double)direction[1];
    const double turn = atan2((double)direction[1], (double)direction[0]) / (2 * M_PI);

    out[0] = level * RINGS - (RINGS - 1 - c / AZIMUTHS);
    out[1] = (turn < 0 ? turn + 1 : turn) * AZIMUTHS - c % AZIMUTHS;
}

static void every_direction_is_a_unit_vector_in_its_cell(void **state)
{
    (void)state;
    hemisphere_strata_fill(cell[0], RINGS, AZIMUTHS, SETS, 7);

    for (uint32_t s = 0; s < SETS; s++)
        for (uint32_t c = 0; c < CELLS; c++) {
            const float *d = cell[s][c];
            double at[2], square = 0;
            for (int k = 0; k < 3; k++) square += (double)d[k] * (double)d[k];
            assert_near(square, 1.0, 1e-6); /* float32 */
            assert_near((double)d[3], 1.0 / CELLS, 1e-8);
            assert_true(d[2] > 0);
            place_in(d, c, at);
            for (int k = 0; k < 2; k++) assert_true(at[k] > -1e-5 && at[k] < 1 + 1e-5);
        }
}

/* A (0,2)-sequence: 16 points put one into each of 16 equal parts, however those are shaped. */
static void sixteen_sets_fill_every_cell_evenly(void **state)
{
    static const int across[5] = {1, 2, 4, 8, 16};

    (void)state;
    hemisphere_strata_fill(cell[0], RINGS, AZIMUTHS, SETS, 7);

    for (uint32_t c = 0; c < CELLS; c++)
        for (uint32_t round = 0; round < ROUNDS; round++)
            for (int shape = 0; shape < 5; shape++) {
                int count[16] = {0};
                for (uint32_t s = 0; s < HEMISPHERE_SETS; s++) {
                    double at[2];
                    place_in(cell[round * HEMISPHERE_SETS + s][c], c, at);
                    const int i = (int)(at[0] * across[shape]),
                              j = (int)(at[1] * (16 / across[shape]));
                    count[i * (16 / across[shape]) + j]++;
                }
                for (int i = 0; i < 16; i++) assert_int_equal(count[i], 1);
            }
}

static void the_middles_stand_in_the_middle(void **state)
{
    (void)state;
    hemisphere_strata_fill(cell[0], RINGS, AZIMUTHS, 0, 7);

    for (uint32_t c = 0; c < CELLS; c++) {
        double at[2];
        place_in(cell[0][c], c, at);
        for (int k = 0; k < 2; k++) assert_near(at[k], .5, 1e-5); /* float32 */
    }
}

static void the_samples_of_a_pixel_take_all_sets_and_a_square_shares_them(void **state)
{
    (void)state;
    for (uint32_t square = 0; square < 20; square++) {
        uint32_t seen[2] = {0, 0};
        for (uint32_t s = 0; s < 2 * HEMISPHERE_SETS; s++) {
            const uint32_t set = hemisphere_strata_set(8 * square, 8 * square + 7, s, 3);
            assert_int_equal(hemisphere_strata_set(8 * square + 7, 8 * square, s, 3), set);
            assert_int_equal(set / HEMISPHERE_SETS, s / HEMISPHERE_SETS);
            seen[set / HEMISPHERE_SETS] |= 1u << set % HEMISPHERE_SETS;
        }
        assert_int_equal(seen[0], 0xffff);
        assert_int_equal(seen[1], 0xffff);
    }
}

int main(void)
{
    const struct CMUnitTest tests[] = {
        cmocka_unit_test(every_direction_is_a_unit_vector_in_its_cell),
        cmocka_unit_test(sixteen_sets_fill_every_cell_evenly),
        cmocka_unit_test(the_middles_stand_in_the_middle),
        cmocka_unit_test(the_samples_of_a_pixel_take_all_sets_and_a_square_shares_them),
    };

    return cmocka_run_group_tests(tests, NULL, NULL);
}
