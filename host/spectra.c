#include "spectra.h"

#include "planck.h"

#include <math.h>
#include <stdlib.h>

enum { PAD = 16 };

static uint32_t padded(int count)
{
    return ((uint32_t)count + PAD - 1) / PAD * PAD;
}

static status allocate(spectra *s, uint32_t band_count, uint32_t sample_count,
                       const atmosphere *air)
{
    status rc = STATUS_OK;

    s->band_count = band_count;
    s->sample_count = sample_count;
    s->row_count = SPECTRA_PATHS + 2u * (uint32_t)air->path_count +
                   (uint32_t)air->zenith_count * (uint32_t)air->azimuth_count;
    s->wavenumber_cm1 = calloc(sample_count, sizeof(double));
    s->bands = calloc(band_count, sizeof *s->bands);
    s->centre_um = calloc(band_count, sizeof(double));
    s->width_um = calloc(band_count, sizeof(double));
    s->rows = calloc((size_t)s->row_count * sample_count, sizeof(float));
    NEED(s->wavenumber_cm1 && s->bands && s->centre_um && s->width_um && s->rows, STATUS_MEMORY,
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
}

static void place_band(spectra *s, uint32_t index, const band *b, const band_samples *samples,
                       uint32_t first)
{
    const uint32_t count = padded(samples->count);

    for (uint32_t i = 0; i < count; i++) {
        const int from = (int)i < samples->count ? (int)i : samples->count - 1;
        s->wavenumber_cm1[first + i] = samples->wavenumber_cm1[from];
        if ((int)i < samples->count)
            row(s, SPECTRA_WEIGHT)[first + i] = (float)samples->weight_um[i];
    }
    s->bands[index] = (band_record){.first_sample = first,
                                    .sample_count = count,
                                    .gain = (float)b->gain,
                                    .offset = (float)b->offset,
                                    .width_um = (float)samples->width_um,
                                    .is_mean = b->is_mean};
    s->centre_um[index] = samples->centre_um;
    s->width_um[index] = samples->width_um;
}

static void free_samples(band_samples *samples, uint32_t count)
{
    for (uint32_t i = 0; samples && i < count; i++) band_samples_free(&samples[i]);
    free(samples);
}

status spectra_build(spectra **out, const band *bands, uint32_t band_count, const atmosphere *air,
                     bool by_points, bool thesis)
{
    status rc = STATUS_OK;
    spectra *s = calloc(1, sizeof *s);
    band_samples *samples = calloc(band_count, sizeof *samples);
    uint32_t total = 0;

    NEED(s && samples, STATUS_MEMORY, "no memory for the spectra");
    for (uint32_t i = 0; i < band_count; i++) {
        TRY(band_sample(&samples[i], &bands[i], air, by_points));
        total += padded(samples[i].count);
    }
    TRY(allocate(s, band_count, total, air));
    for (uint32_t i = 0, first = 0; i < band_count; i++) {
        place_band(s, i, &bands[i], &samples[i], first);
        first += padded(samples[i].count);
    }
    fill_rows(s, air, thesis);
    *out = s;
    s = NULL;
out:
    free_samples(samples, band_count);
    spectra_free(s);
    return rc;
}

void spectra_free(spectra *s)
{
    if (!s) return;
    free(s->wavenumber_cm1);
    free(s->bands);
    free(s->centre_um);
    free(s->width_um);
    free(s->rows);
    free(s);
}

void spectra_sample_emissivity(const spectra *s, const emissivity *table, float *out)
{
    for (uint32_t i = 0; i < s->sample_count; i++) {
        double place = (EMISSIVITY_FIRST_CM1 - s->wavenumber_cm1[i]) / EMISSIVITY_STEP_CM1;
        place = fmax(0.0, fmin(place, EMISSIVITY_WAVENUMBERS - 1));
        const int low =
            place >= EMISSIVITY_WAVENUMBERS - 1 ? EMISSIVITY_WAVENUMBERS - 2 : (int)place;
        for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++) {
            const double a = (double)table->value[angle][low];
            const double b = (double)table->value[angle][low + 1];
            out[(size_t)angle * s->sample_count + i] = (float)(a + (place - low) * (b - a));
        }
    }
}
