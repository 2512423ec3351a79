#include "hemisphere/hemisphere_strata.h"

#include "kernels/random.h"

#include <math.h>

/* Digits of a point's number among HEMISPHERE_SETS, and of what the squares of pixels take. */
enum { DIGITS = 4, OF_SQUARES = 0xff };

/* A random word for what four numbers name. */
static uint32_t draw(uint32_t seed, uint32_t cell, uint32_t round, uint32_t digit, uint32_t prefix)
{
    const uint32_t key[2] = {seed, RANDOM_HEMISPHERE};
    uint32_t word[4] = {cell, round, digit, prefix};

    random_words(key, word);
    return word[0];
}

/* Permutes binary digits, each by those before it; behind them the word is random. Returns 0 .. 1.
 *   axis   0 or 1 */
static double scramble(uint32_t digits, uint32_t axis, uint32_t seed, uint32_t cell, uint32_t round)
{
    uint32_t word = draw(seed, cell, round, 2 * DIGITS + axis, digits) >> DIGITS;

    for (uint32_t k = 0; k < DIGITS; k++) {
        const uint32_t prefix = digits >> (DIGITS - k), digit = digits >> (DIGITS - 1 - k);
        const uint32_t turned = (digit ^ draw(seed, cell, round, 2 * k + axis, prefix)) & 1;
        word |= turned << (31 - k);
    }
    return (word + 0.5) / 4294967296.0;
}

/* Point `n` of the sequence, in its two axes' digits: van der Corput's, and that of x + 1. */
static void sobol(uint32_t n, uint32_t digits[2])
{
    static const uint32_t direction[2][DIGITS] = {{8, 4, 2, 1}, {8, 12, 10, 15}};

    for (int axis = 0; axis < 2; axis++) {
        digits[axis] = 0;
        for (int k = 0; k < DIGITS; k++)
            if (n >> k & 1) digits[axis] ^= direction[axis][k];
    }
}

/* Fills a cell of a ring, counted from the lowest.
 *   down, along   where in the cell, 0 .. 1 */
static void fill_cell(float cell[4], uint32_t ring, uint32_t rings, double down, double along,
                      uint32_t azimuth, uint32_t azimuths)
{
    const double level = (rings - 1 - ring + down) / rings; /* the zenith angle's squared sine */
    const double turn = 2 * M_PI * (azimuth + along) / azimuths;

    cell[0] = (float)(sqrt(level) * cos(turn));
    cell[1] = (float)(sqrt(level) * sin(turn));
    cell[2] = (float)sqrt(1 - level);
    cell[3] = (float)(1.0 / ((double)rings * azimuths));
}

void hemisphere_strata_fill(float (*cell)[4], uint32_t rings, uint32_t azimuths, uint32_t set_count,
                            uint32_t seed)
{
    const uint32_t cells = rings * azimuths;

    for (uint32_t c = 0; set_count == 0 && c < cells; c++)
        fill_cell(cell[c], c / azimuths, rings, .5, .5, c % azimuths, azimuths);
    for (uint32_t set = 0; set < set_count; set++)
        for (uint32_t c = 0; c < cells; c++) {
            const uint32_t round = set / HEMISPHERE_SETS;
            uint32_t digits[2];
            sobol(set % HEMISPHERE_SETS, digits);
            fill_cell(cell[(uint64_t)set * cells + c], c / azimuths, rings,
                      scramble(digits[0], 0, seed, c, round),
                      scramble(digits[1], 1, seed, c, round), c % azimuths, azimuths);
        }
}

uint32_t hemisphere_strata_set(uint32_t column, uint32_t row, uint32_t sample, uint32_t seed)
{
    const uint32_t turned = draw(seed, column / HEMISPHERE_SQUARE, row / HEMISPHERE_SQUARE,
                                 OF_SQUARES, sample / HEMISPHERE_SETS);

    return sample ^ turned % HEMISPHERE_SETS;
}
