#include "radiance/spectral_grid.h"

#include "material/wavenumber_rows.h"
#include "sky/planck.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SLACK 1e-6 /* of a step, for its rounding */

/* The samples without those that pad, which repeat one. */
typedef struct distinct_samples {
    uint32_t count;
    uint32_t *sample; /* shape (count) */
    double *nu_cm1;   /* shape (count), descends */
    bool *is_knot;    /* shape (count) */
} distinct_samples;

static void free_distinct(distinct_samples *d)
{
    free(d->is_knot);
    free(d->nu_cm1);
    free(d->sample);
}

static status find_distinct(distinct_samples *d, const spectra *s)
{
    status rc = STATUS_OK;

    d->sample = malloc(s->sample_count * sizeof *d->sample);
    d->nu_cm1 = malloc(s->sample_count * sizeof *d->nu_cm1);
    d->is_knot = calloc(s->sample_count, sizeof *d->is_knot);
    NEED(d->sample && d->nu_cm1 && d->is_knot, STATUS_MEMORY, "no memory for %u samples",
         s->sample_count);
    for (uint32_t i = 0; i < s->sample_count; i++) {
        if (i > 0 && s->wavenumber_cm1[i] == s->wavenumber_cm1[i - 1]) continue;
        d->sample[d->count] = i;
        d->is_knot[d->count] = s->bends && s->bends[i];
        d->nu_cm1[d->count++] = s->wavenumber_cm1[i];
    }
out:
    return rc;
}

/* Marks samples at the points of a regular table, and those on both sides of one. */
static void mark_points(distinct_samples *d, double first_cm1, double step_cm1)
{
    for (uint32_t i = 0; i + 1 < d->count; i++) {
        const double from = (first_cm1 - d->nu_cm1[i]) / step_cm1;
        const double to = (first_cm1 - d->nu_cm1[i + 1]) / step_cm1;
        d->is_knot[i] |= ceil(to - SLACK) > ceil(from - SLACK);
        d->is_knot[i + 1] |= floor(to + SLACK) > floor(from + SLACK);
    }
}

/* Marks the ends of runs of samples. */
static void mark_ends(distinct_samples *d)
{
    d->is_knot[0] = d->is_knot[d->count - 1] = true;
    for (uint32_t i = 0; i + 1 < d->count; i++)
        if (d->nu_cm1[i] - d->nu_cm1[i + 1] > planck_step_cm1(d->nu_cm1[i]) * (1.0 + SLACK))
            d->is_knot[i] = d->is_knot[i + 1] = true;
}

/* Marks what lies too far from the knot before; the first sample is one. */
static void mark_far(distinct_samples *d)
{
    double last_cm1 = d->nu_cm1[0];

    for (uint32_t i = 1; i + 1 < d->count; i++) {
        const double next_cm1 = d->nu_cm1[i + 1];
        const double most_cm1 = KNOT_STEPS * planck_step_cm1(next_cm1) * (1.0 + SLACK);
        d->is_knot[i] |= last_cm1 - next_cm1 > most_cm1;
        if (d->is_knot[i]) last_cm1 = d->nu_cm1[i];
    }
}

/* Lists the samples that are knots: all, those that pad too, where that is no more. */
static status list(spectral_grid *k, const distinct_samples *d, uint32_t sample_count, bool all)
{
    status rc = STATUS_OK;
    uint32_t count = 0, padded = sample_count;

    for (uint32_t i = 0; i < d->count; i++) count += d->is_knot[i];
    if (!all) padded = spectra_padded(count);
    all = padded >= sample_count;
    k->spectra = calloc(1, sizeof *k->spectra);
    k->sample = malloc(padded * sizeof *k->sample);
    NEED(k->spectra && k->sample, STATUS_MEMORY, "no memory for %u knots", padded);
    k->spectra->sample_count = padded;
    count = 0;
    for (uint32_t i = 0; i < d->count && !all; i++)
        if (d->is_knot[i]) k->sample[count++] = d->sample[i];
    for (uint32_t i = count; i < padded; i++) k->sample[i] = all ? i : k->sample[count - 1];
out:
    return rc;
}

/* A sample between two knots. */
typedef struct knot_place {
    uint32_t low, high;
    double fraction; /* of `high` */
} knot_place;

/* Finds it from the place of a sample before, or none yet. */
static knot_place find_place(const spectral_grid *k, const double *nu_cm1, uint32_t sample,
                             uint32_t low)
{
    const uint32_t last = k->spectra->sample_count - 1;

    while (low < last && nu_cm1[k->sample[low + 1]] >= nu_cm1[sample] &&
           k->sample[low + 1] != k->sample[low])
        low++;
    knot_place at = {low, low < last ? low + 1 : low, 0.0};
    const double from = nu_cm1[k->sample[low]], to = nu_cm1[k->sample[at.high]];
    if (from > to) at.fraction = (from - nu_cm1[sample]) / (from - to);
    if (at.fraction <= 0.0) at.high = low;
    return at;
}

/* Puts the places of samples into blocks; the knots of one begin where all of its span are there. */
static void fill_blocks(spectral_grid *k, const knot_place *place, uint32_t sample_count)
{
    const uint32_t most = k->spectra->sample_count - k->span;

    for (uint32_t b = 0; b < sample_count / SPECTRA_BLOCK; b++) {
        const uint32_t low = place[b * SPECTRA_BLOCK].low;
        float *fraction = k->fraction + (size_t)b * k->span * SPECTRA_BLOCK;
        k->first[b] = low < most ? low : most;
        for (uint32_t i = 0; i < SPECTRA_BLOCK; i++) {
            const knot_place at = place[b * SPECTRA_BLOCK + i];
            fraction[(at.low - k->first[b]) * SPECTRA_BLOCK + i] += (float)(1.0 - at.fraction);
            fraction[(at.high - k->first[b]) * SPECTRA_BLOCK + i] += (float)at.fraction;
        }
    }
}

/* Adds the weights of samples to the knots that they lie between. */
static void weigh(const spectral_grid *k, const knot_place *place, const spectra *s)
{
    const float *own = s->rows + (size_t)SPECTRA_WEIGHT * s->sample_count;
    float *weight = k->spectra->rows + (size_t)SPECTRA_WEIGHT * k->spectra->sample_count;

    memset(weight, 0, k->spectra->sample_count * sizeof *weight);
    for (uint32_t i = 0; i < s->sample_count; i++) {
        weight[place[i].low] += own[i] * (float)(1.0 - place[i].fraction);
        weight[place[i].high] += own[i] * (float)place[i].fraction;
    }
}

/* Tells how samples lie between the knots. */
static status tie(spectral_grid *k, const spectra *s)
{
    status rc = STATUS_OK;
    const uint32_t blocks = s->sample_count / SPECTRA_BLOCK;
    knot_place *place = malloc(s->sample_count * sizeof *place);

    NEED(place, STATUS_MEMORY, "no memory for %u samples", s->sample_count);
    for (uint32_t i = 0; i < s->sample_count; i++)
        place[i] = find_place(k, s->wavenumber_cm1, i, i > 0 ? place[i - 1].low : 0);
    for (uint32_t b = 0; b < blocks; b++) {
        const knot_place *own = place + b * SPECTRA_BLOCK;
        const uint32_t span = own[SPECTRA_BLOCK - 1].high - own[0].low + 1;
        if (span > k->span) k->span = span;
    }
    k->first = malloc(blocks * sizeof *k->first);
    k->fraction = calloc((size_t)blocks * k->span * SPECTRA_BLOCK, sizeof *k->fraction);
    NEED(k->first && k->fraction, STATUS_MEMORY, "no memory for %u samples", s->sample_count);
    fill_blocks(k, place, s->sample_count);
    weigh(k, place, s);
out:
    free(place);
    return rc;
}

/* Takes the rows at the knots. */
static status fill_rows(spectral_grid *k, const spectra *s)
{
    status rc = STATUS_OK;
    const uint32_t count = k->spectra->sample_count;

    k->spectra->row_count = s->row_count;
    k->spectra->rows = malloc((size_t)s->row_count * count * sizeof *k->spectra->rows);
    k->spectra->wavenumber_cm1 = malloc(count * sizeof *k->spectra->wavenumber_cm1);
    NEED(k->spectra->rows && k->spectra->wavenumber_cm1, STATUS_MEMORY, "no memory for %u knots",
         count);
    for (uint32_t i = 0; i < count; i++)
        k->spectra->wavenumber_cm1[i] = s->wavenumber_cm1[k->sample[i]];
    spectral_grid_pick(k, s->rows, s->row_count, s->sample_count, k->spectra->rows);
out:
    return rc;
}

status spectral_grid_find(spectral_grid **out, const spectra *s, const atmosphere *air, bool all)
{
    status rc = STATUS_OK;
    spectral_grid *k = calloc(1, sizeof *k);
    distinct_samples d = {0};

    NEED(k, STATUS_MEMORY, "no memory for knots");
    TRY(find_distinct(&d, s));
    mark_points(&d, air->wavenumber_cm1[0], air->wavenumber_step_cm1);
    if (air->wavenumber_step_cm1 < WAVENUMBER_ROWS_STEP_CM1)
        mark_points(&d, WAVENUMBER_ROWS_FIRST_CM1, WAVENUMBER_ROWS_STEP_CM1);
    mark_ends(&d);
    mark_far(&d);
    TRY(list(k, &d, s->sample_count, all));
    TRY(fill_rows(k, s));
    if (k->spectra->sample_count < s->sample_count) TRY(tie(k, s));
    *out = k;
    k = NULL;
out:
    free_distinct(&d);
    spectral_grid_free(k);
    return rc;
}

void spectral_grid_free(spectral_grid *k)
{
    if (!k) return;
    spectra_free(k->spectra);
    free(k->sample);
    free(k->first);
    free(k->fraction);
    free(k);
}

void spectral_grid_pick(const spectral_grid *k, const float *rows, size_t row_count,
                        uint32_t sample_count, float *out)
{
    const uint32_t count = k->spectra->sample_count;

    for (size_t r = 0; r < row_count; r++)
        for (uint32_t i = 0; i < count; i++)
            out[r * count + i] = rows[r * sample_count + k->sample[i]];
}
