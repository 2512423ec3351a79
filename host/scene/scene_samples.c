#include "base/array.h"
#include "scene/scene_parts.h"

#include <math.h>
#include <stdlib.h>

#define BAND_ERROR                                                                                 \
    5e-5 /* of a band's mean emissivity, by samples between which it counts as straight */
#define PIECE_ERROR 1e-7 /* of it, below which the points between two samples are left out */

/* Further samples of a band. */
typedef struct sample_points {
    size_t count;
    double *cm1;
} sample_points;

/* By how much the straight line between two samples misses the spectrum's integral. */
static double piece_error(const emissivity *e, double high_cm1, double low_cm1)
{
    const double from_um = 1e4 / high_cm1, to_um = 1e4 / low_cm1;
    const double straight =
        .5 * (to_um - from_um) * (emissivity_at(e, high_cm1, 0.0) + emissivity_at(e, low_cm1, 0.0));

    return emissivity_integral(e, from_um, to_um) - straight;
}

/* Adds the spectrum's own wavelengths between two samples. */
static status add_points(sample_points *to, const wavelength_grid *grid, double high_cm1,
                         double low_cm1)
{
    status rc = STATUS_OK;
    const double from_um = 1e4 / high_cm1, to_um = 1e4 / low_cm1;

    for (size_t i = wavelength_grid_find(grid, high_cm1).low;
         i < grid->count && grid->wavelength_um[i] < to_um; i++) {
        if (!(grid->wavelength_um[i] > from_um)) continue;
        NEED(array_add(&to->cm1, to->count, sizeof *to->cm1), STATUS_MEMORY,
             "no memory for samples");
        to->cm1[to->count++] = 1e4 / grid->wavelength_um[i];
    }
out:
    return rc;
}

/* Adds what one spectrum needs in a band: nothing where the samples that are there do. */
static status add_spectrum(sample_points *to, const emissivity *e, const band_samples *samples)
{
    status rc = STATUS_OK;
    const double *nu = samples->wavenumber_cm1;
    const double width_um = 1e4 / nu[samples->count - 1] - 1e4 / nu[0];
    double error = 0.0;

    for (int i = 0; i + 1 < samples->count; i++) error += piece_error(e, nu[i], nu[i + 1]);
    if (fabs(error) <= BAND_ERROR * width_um) goto out;
    for (int i = 0; i + 1 < samples->count; i++)
        if (fabs(piece_error(e, nu[i], nu[i + 1])) > PIECE_ERROR * width_um)
            TRY(add_points(to, &e->grid, nu[i], nu[i + 1]));
out:
    return rc;
}

static int descending(const void *a, const void *b)
{
    const double first = *(const double *)a, second = *(const double *)b;

    return (first < second) - (first > second);
}

static status place(const scene *s, band *b)
{
    status rc = STATUS_OK;
    band_samples samples = {0};
    sample_points points = {0};

    TRY(band_sample(&samples, b, s->air, BAND_FINE));
    for (uint32_t i = 0; i < s->material_count; i++) {
        const emissivity *e = s->materials[i].table;
        if (e && e->grid.wavelength_um) TRY(add_spectrum(&points, e, &samples));
    }
    if (points.count > 0) qsort(points.cm1, points.count, sizeof *points.cm1, descending);
    b->point_cm1 = points.cm1;
    b->point_count = points.count;
    points.cm1 = NULL;
out:
    free(points.cm1);
    band_samples_free(&samples);
    return rc;
}

double scene_uncovered(const scene *s, const wavelength_grid *grid, const band **out_band)
{
    for (uint32_t i = 0; s->air && i < s->band_count; i++) {
        const band *b = &s->bands[i];
        const double low_um = b->sensor ? s->air->wavelength_um[0] : b->low_um;
        const double high_um =
            b->sensor ? s->air->wavelength_um[s->air->point_count - 1] : b->high_um;
        const double um = wavelength_grid_uncovered(grid, low_um, high_um);
        *out_band = b;
        if (!isnan(um)) return um;
    }
    return NAN;
}

void scene_place_samples(scene_reader *reader)
{
    scene *s = reader->s;

    if (scene_quadrature(s) != BAND_FINE) return;
    for (uint32_t i = 0; s->air && i < s->band_count; i++)
        if (!scene_took(reader, place(s, &s->bands[i]))) return;
}
