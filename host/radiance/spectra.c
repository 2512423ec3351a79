#include "radiance/spectra.h"

#include "sky/planck.h"

#include <math.h>
#include <stdlib.h>

#define SMALLEST_TRANSMISSION 1e-30 /* has a logarithm, and is none */
#define SLACK 1e-6                  /* of a step between samples, for its rounding */

uint32_t spectra_padded(uint32_t count)
{
    return (count + SPECTRA_BLOCK - 1) / SPECTRA_BLOCK * SPECTRA_BLOCK;
}

/* Altitudes and ranges of the air, with those that need no table: ground and sensor, and range 0. */
static uint32_t altitudes_of(const atmosphere *air)
{
    return air->target_count ? (uint32_t)air->target_count + 2u : 0u;
}

static uint32_t ranges_of(const atmosphere *air)
{
    return air->range_count ? (uint32_t)air->range_count + 1u : 0u;
}

static uint32_t air_first_row(const atmosphere *air)
{
    return SPECTRA_PATHS + 2u * (uint32_t)air->path_count +
           (uint32_t)air->zenith_count * (uint32_t)air->azimuth_count;
}

static status allocate(spectra *s, uint32_t band_count, const atmosphere *air)
{
    const uint32_t sample_count = s->sample_count;
    status rc = STATUS_OK;

    s->band_count = band_count;
    s->row_count =
        air_first_row(air) + 2u * (altitudes_of(air) * (uint32_t)air->path_count + ranges_of(air));
    s->bands = calloc(band_count, sizeof *s->bands);
    s->centre_um = calloc(band_count, sizeof(double));
    s->width_um = calloc(band_count, sizeof(double));
    s->rows = calloc((size_t)s->row_count * sample_count, sizeof(float));
    NEED(s->bands && s->centre_um && s->width_um && s->rows, STATUS_MEMORY,
         "no memory for the spectra of %u bands", band_count);
out:
    return rc;
}

static float *row(spectra *s, uint32_t index)
{
    return s->rows + (size_t)index * s->sample_count;
}

static void fill_row(spectra *s, uint32_t index, const atmosphere *air, const double *value,
                     const double *added)
{
    for (uint32_t i = 0; i < s->sample_count; i++) {
        const double nu = s->wavenumber_cm1[i];
        row(s, index)[i] =
            (float)(band_look_up(air, value, nu) + (added ? band_look_up(air, added, nu) : 0.0));
    }
}

static void fill_depth(spectra *s, uint32_t index, const atmosphere *air, const double *tau)
{
    for (uint32_t i = 0; i < s->sample_count; i++)
        row(s, index)[i] =
            (float)-log(fmax(band_look_up(air, tau, s->wavenumber_cm1[i]), SMALLEST_TRANSMISSION));
}

/* Rows of the ground and of the targets; the sensor's stay 0. */
static void fill_altitudes(spectra *s, const atmosphere *air)
{
    const uint32_t paths = (uint32_t)air->path_count, first = air_first_row(air);
    const uint32_t count = altitudes_of(air);
    const size_t n = (size_t)air->point_count;

    for (uint32_t i = 0; i + 1 < count; i++)
        for (uint32_t p = 0; p < paths; p++) {
            const size_t from = ((i > 0 ? i - 1 : 0) * paths + p) * n;
            const uint32_t to = first + i * paths + p;
            fill_depth(s, to, air, (i > 0 ? air->target_tau : air->tau2) + from);
            fill_row(s, to + count * paths, air,
                     (i > 0 ? air->target_emitted : air->path_emitted) + from,
                     (i > 0 ? air->target_scattered : air->path_scattered) + from);
        }
}

/* Rows of the level paths, those of range 0 stay 0. What is transmitted never grows with range. */
static void fill_ranges(spectra *s, const atmosphere *air)
{
    const uint32_t count = ranges_of(air);
    const uint32_t first = air_first_row(air) + 2u * altitudes_of(air) * (uint32_t)air->path_count;

    for (uint32_t i = 1; i < count; i++) {
        const size_t from = (i - 1) * (size_t)air->point_count;
        fill_depth(s, first + i, air, air->range_tau + from);
        for (uint32_t k = 0; k < s->sample_count; k++)
            row(s, first + i)[k] = fmaxf(row(s, first + i)[k], row(s, first + i - 1)[k]);
        fill_row(s, first + count + i, air, air->range_emitted + from, air->range_scattered + from);
    }
}

static void fill_rows(spectra *s, const atmosphere *air, bool thesis)
{
    const uint32_t paths = (uint32_t)air->path_count;
    const uint32_t directions = (uint32_t)(air->zenith_count * air->azimuth_count);
    const size_t n = (size_t)air->point_count;

    for (uint32_t i = 0; i < s->sample_count; i++) {
        const double nu = s->wavenumber_cm1[i];
        const planck_terms planck = planck_at(1e4 / nu, thesis);
        row(s, SPECTRA_PLANCK_FIRST)[i] = (float)planck.first;
        row(s, SPECTRA_PLANCK_SECOND)[i] = (float)planck.second;
        row(s, SPECTRA_SUN)[i] = (float)(band_look_up(air, air->solar_irradiance, nu) *
                                         band_look_up(air, air->tau1, nu));
    }
    fill_row(s, SPECTRA_SKY, air, air->sky_emitted, air->sky_scattered);
    for (uint32_t p = 0; p < paths; p++) {
        fill_row(s, SPECTRA_PATHS + p, air, air->tau2 + p * n, NULL);
        fill_row(s, SPECTRA_PATHS + paths + p, air, air->path_emitted + p * n,
                 air->path_scattered + p * n);
    }
    for (uint32_t d = 0; d < directions; d++)
        fill_row(s, SPECTRA_PATHS + 2 * paths + d, air, air->sky_emitted_direction + d * n,
                 air->sky_scattered_direction + d * n);
    fill_altitudes(s, air);
    fill_ranges(s, air);
}

static int descending(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;

    return (first < second) - (first > second);
}

/* Lays the samples of all bands in one row, those at the same wavenumber once. A block does not go
 * over a gap between bands: means over blocks would mix what lies far apart.
 *   step_cm1   the longest within a band; 0: planck_step_cm1 */
static status lay_row(spectra *s, const band_samples *samples, uint32_t band_count, double step_cm1)
{
    status rc = STATUS_OK;
    size_t count = 0, total = 0;
    double *all = NULL;

    for (uint32_t b = 0; b < band_count; b++) total += (size_t)samples[b].count;
    all = malloc(total * sizeof *all);
    s->wavenumber_cm1 = malloc(total * SPECTRA_BLOCK * sizeof(double));
    NEED(all && s->wavenumber_cm1, STATUS_MEMORY, "no memory for %zu samples", total);
    for (uint32_t b = 0; b < band_count; b++)
        for (int i = 0; i < samples[b].count; i++) all[count++] = samples[b].wavenumber_cm1[i];
    qsort(all, total, sizeof *all, descending);
    for (size_t i = 0; i < total; i++) {
        const double step = step_cm1 > 0.0 ? step_cm1 : planck_step_cm1(all[i]);
        if (i > 0 && all[i] == all[i - 1]) continue;
        while (i > 0 && all[i - 1] - all[i] > step * (1.0 + SLACK) &&
               s->sample_count % SPECTRA_BLOCK)
            s->wavenumber_cm1[s->sample_count++] = all[i - 1];
        s->wavenumber_cm1[s->sample_count++] = all[i];
    }
    while (s->sample_count % SPECTRA_BLOCK) s->wavenumber_cm1[s->sample_count++] = all[total - 1];
out:
    free(all);
    return rc;
}

/* Where in the row a wavenumber stands that is one of its samples. */
static uint32_t find_sample(const spectra *s, double wavenumber_cm1)
{
    uint32_t low = 0, high = s->sample_count - 1;

    while (low < high) {
        const uint32_t middle = (low + high) / 2;
        if (s->wavenumber_cm1[middle] > wavenumber_cm1)
            low = middle + 1;
        else
            high = middle;
    }
    return low;
}

/* Finds the samples that a band is in. */
static void place_band(spectra *s, uint32_t index, const band *b, const band_samples *samples)
{
    const double *nu = samples->wavenumber_cm1;
    const uint32_t first = find_sample(s, nu[0]);
    const uint32_t count = find_sample(s, nu[samples->count - 1]) + 1 - first;

    s->bands[index] = (band_record){.first_sample = first,
                                    .sample_count = count,
                                    .gain = (float)b->gain,
                                    .offset = (float)b->offset,
                                    .width_um = (float)samples->width_um,
                                    .is_mean = b->is_mean,
                                    .first_weight = s->weight_count};
    s->weight_count += count;
    s->centre_um[index] = samples->centre_um;
    s->width_um[index] = samples->width_um;
}

static status place_weights(spectra *s, const band_samples *samples)
{
    status rc = STATUS_OK;

    s->weight_um = calloc(s->weight_count, sizeof *s->weight_um);
    NEED(s->weight_um, STATUS_MEMORY, "no memory for the weights of %u bands", s->band_count);
    for (uint32_t b = 0; b < s->band_count; b++) {
        float *own = s->weight_um + s->bands[b].first_weight;
        for (int i = 0; i < samples[b].count; i++) {
            const uint32_t at = find_sample(s, samples[b].wavenumber_cm1[i]);
            own[at - s->bands[b].first_sample] = (float)samples[b].weight_um[i];
            row(s, SPECTRA_WEIGHT)[at] += (float)samples[b].weight_um[i];
        }
    }
out:
    return rc;
}

/* Marks the samples that bands have for spectra of materials. */
static status mark_bends(spectra *s, const band *bands)
{
    status rc = STATUS_OK;

    for (uint32_t b = 0; b < s->band_count; b++) {
        if (bands[b].point_count > 0 && !s->bends) {
            s->bends = calloc(s->sample_count, sizeof *s->bends);
            NEED(s->bends, STATUS_MEMORY, "no memory for %u samples", s->sample_count);
        }
        for (size_t i = 0; i < bands[b].point_count; i++)
            s->bends[find_sample(s, bands[b].point_cm1[i])] = true;
    }
out:
    return rc;
}

static void free_samples(band_samples *samples, uint32_t count)
{
    for (uint32_t i = 0; samples && i < count; i++) band_samples_free(&samples[i]);
    free(samples);
}

status spectra_build(spectra **out, const band *bands, uint32_t band_count, const atmosphere *air,
                     band_quadrature rule, bool thesis)
{
    status rc = STATUS_OK;
    spectra *s = calloc(1, sizeof *s);
    band_samples *samples = calloc(band_count, sizeof *samples);

    NEED(s && samples, STATUS_MEMORY, "no memory for the spectra");
    for (uint32_t i = 0; i < band_count; i++) TRY(band_sample(&samples[i], &bands[i], air, rule));
    TRY(lay_row(s, samples, band_count,
                rule == BAND_DATABASE_POINTS ? air->wavenumber_step_cm1 : 0.0));
    TRY(allocate(s, band_count, air));
    for (uint32_t i = 0; i < band_count; i++) place_band(s, i, &bands[i], &samples[i]);
    TRY(place_weights(s, samples));
    TRY(mark_bends(s, bands));
    fill_rows(s, air, thesis);
    *out = s;
    s = NULL;
out:
    free_samples(samples, band_count);
    spectra_free(s);
    return rc;
}

/* The mean of one block of a row; of samples without weight, the plain one. */
static double block_mean(const spectra *s, const float *from, uint32_t block)
{
    double sum = 0.0, weights = 0.0, plain = 0.0;

    for (uint32_t i = block * LIGHT_BLOCK; i < (block + 1) * LIGHT_BLOCK; i++) {
        const double weight = (double)s->rows[SPECTRA_WEIGHT * s->sample_count + i];
        sum += weight * (double)from[i];
        weights += weight;
        plain += (double)from[i] / LIGHT_BLOCK;
    }
    return weights > 0.0 ? sum / weights : plain;
}

/* These means of rows.
 *   rows   shape (row_count, s->sample_count); out: (row_count, coarse->sample_count) */
static void average(const spectra *s, const spectra *coarse, const float *rows, size_t row_count,
                    float *out)
{
    const uint32_t blocks = s->sample_count / LIGHT_BLOCK;

    for (size_t r = 0; r < row_count; r++)
        for (uint32_t b = 0; b < coarse->sample_count; b++)
            out[r * coarse->sample_count + b] =
                (float)block_mean(s, rows + r * s->sample_count, b < blocks ? b : blocks - 1);
}

status spectra_coarsen(spectra **out, const spectra *s)
{
    status rc = STATUS_OK;
    spectra *coarse = calloc(1, sizeof *coarse);
    float *wavelength_um = malloc(s->sample_count * sizeof *wavelength_um);

    NEED(coarse && wavelength_um, STATUS_MEMORY, "no memory for coarse spectra");
    coarse->sample_count = spectra_padded(s->sample_count / LIGHT_BLOCK);
    coarse->row_count = s->row_count;
    coarse->wavenumber_cm1 = calloc(coarse->sample_count, sizeof(double));
    coarse->rows = calloc((size_t)s->row_count * coarse->sample_count, sizeof(float));
    NEED(coarse->wavenumber_cm1 && coarse->rows, STATUS_MEMORY, "no memory for coarse spectra");
    average(s, coarse, s->rows, s->row_count, coarse->rows);
    for (uint32_t i = 0; i < s->sample_count; i++)
        wavelength_um[i] = (float)(1e4 / s->wavenumber_cm1[i]);
    average(s, coarse, wavelength_um, 1, row(coarse, SPECTRA_PLANCK_FIRST));
    for (uint32_t b = 0; b < coarse->sample_count; b++) {
        const double um = (double)row(coarse, SPECTRA_PLANCK_FIRST)[b];
        const planck_terms planck = planck_at(um, false);
        coarse->wavenumber_cm1[b] = 1e4 / um;
        row(coarse, SPECTRA_PLANCK_FIRST)[b] = (float)planck.first;
        row(coarse, SPECTRA_PLANCK_SECOND)[b] = (float)planck.second;
    }
    *out = coarse;
    coarse = NULL;
out:
    free(wavelength_um);
    spectra_free(coarse);
    return rc;
}

void spectra_free(spectra *s)
{
    if (!s) return;
    free(s->wavenumber_cm1);
    free(s->bends);
    free(s->bands);
    free(s->centre_um);
    free(s->width_um);
    free(s->weight_um);
    free(s->rows);
    free(s);
}

air_record spectra_air(const atmosphere *air, double origin_z_m)
{
    const double ground_m = air->level_count ? air->level_altitude_m[0] : 0.0;
    air_record out = {.first_row = air_first_row(air),
                      .altitude_count = altitudes_of(air),
                      .range_count = ranges_of(air),
                      .ground_z_m = (float)-origin_z_m};

    out.altitude_z_m[0] = out.ground_z_m;
    for (int i = 0; i < air->target_count; i++)
        out.altitude_z_m[i + 1] = (float)(air->target_altitude_m[i] - ground_m - origin_z_m);
    out.altitude_z_m[air->target_count + 1] =
        (float)(air->sensor_altitude_m - ground_m - origin_z_m);
    for (int i = 0; i < air->range_count; i++) out.range_m[i + 1] = (float)air->range_m[i];
    return out;
}
