/* Spectral grid: the knots, samples of spectra at which what reaches a surface is computed; between them it is taken as
 * straight, as the tables are that it comes from. */
#ifndef SPECTRAL_GRID_H
#define SPECTRAL_GRID_H

#include "radiance/spectra.h"

/* Most samples from a knot to the next: 10 cm-1 in the infrared, where Planck's law bends by 6e-5 of its
 * value between them at 10 um, by 1.3e-4 at 3 um. */
enum { KNOT_STEPS = 5 };

typedef struct spectral_grid {
    spectra *spectra; /* the rows at the knots, padded with the last; there are no bands in it */
    uint32_t *sample; /* shape (at->sample_count): which samples these are */
    /* How samples lie between knots: a block of SPECTRA_BLOCK between `span` of them, from first[block]
     * on; at each of its samples they count share[block][knot][sample]. */
    uint32_t span; /* 0: all samples are knots, and the two arrays NULL */
    uint32_t *first;
    float *fraction;
} spectral_grid;

/* Finds knots: where a table can bend, that is at points of the database, and at those of emissivities
 * where the database's are closer; where spectra of materials bend; at ends of runs of samples; and no more than KNOT_STEPS apart. The weights of samples go to the knots that
 * they lie between.
 *   all   every sample: where extinction bends spectra
 * Fails with STATUS_MEMORY. */
status spectral_grid_find(spectral_grid **out, const spectra *s, const atmosphere *air, bool all);
void spectral_grid_free(spectral_grid *k);

/* Takes columns of rows at the knots.
 *   rows   shape (row_count, sample_count of the spectra)
 *   out    shape (row_count, k->spectra->sample_count) */
void spectral_grid_pick(const spectral_grid *k, const float *rows, size_t row_count,
                        uint32_t sample_count, float *out);

#endif
