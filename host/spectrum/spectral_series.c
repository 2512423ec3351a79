#include "spectrum/spectral_series.h"

#include "base/array.h"
#include "files/wavelength_column.h"

#include <math.h>
#include <stdlib.h>

static const double LEAST_UM = 0.1, MOST_UM = 200.0;
static const double MOST_INDEX = 1000.0;

#define NOISE 0.02     /* beyond 0 and 1, of what is measured against a standard */
#define GAP_RATIO 1.21 /* of neighbouring wavelengths: 10 % is held from either side */
enum { POINT_LIMIT = 1 << 20, POINTS_LEAST = 3 };

status spectral_series_add(spectral_series *s, spectral_point point)
{
    status rc = STATUS_OK;

    NEED(s->count < POINT_LIMIT, STATUS_FORMAT, "%s:%d: found more, expected at most %d points",
         s->path, point.line, POINT_LIMIT);
    NEED(array_add(&s->point, s->count, sizeof *s->point), STATUS_MEMORY,
         "%s: no memory for its points", s->path);
    s->point[s->count++] = point;
out:
    return rc;
}

void spectral_series_free(spectral_series *s)
{
    free(s->point);
}

static bool is_deleted(const spectral_series *s, const spectral_point *p)
{
    return s->scale * p->value < -NOISE;
}

static status check_place(const spectral_series *s, size_t i)
{
    status rc = STATUS_OK;
    const spectral_point *p = &s->point[i];
    const double um = wavelength_column_um(s->unit, p->place);

    NEED(um >= LEAST_UM && um <= MOST_UM, STATUS_FORMAT,
         "%s:%d: found %g %s, expected a wavelength of %g to %g um", s->path, p->line, p->place,
         s->unit->name, LEAST_UM, MOST_UM);
    if (i == 0) goto out;
    NEED(p->place != p[-1].place, STATUS_FORMAT,
         "%s:%d: found %g %s twice, expected every wavelength once", s->path, p->line, p->place,
         s->unit->name);
    NEED((p->place > p[-1].place) == (s->point[1].place > s->point[0].place), STATUS_FORMAT,
         "%s:%d: found %g %s behind %g, expected wavelengths that only rise or only fall", s->path,
         p->line, p->place, s->unit->name, p[-1].place);
out:
    return rc;
}

static status check_value(const spectral_series *s, const spectral_point *p, size_t *cut_count)
{
    status rc = STATUS_OK;
    const bool is_index = s->quantity == SPECTRAL_CONSTANTS;
    const double value = s->scale * p->value, most = is_index ? MOST_INDEX : 1.0 + NOISE;

    NEED(value <= most && p->absorption >= 0.0 && p->absorption <= MOST_INDEX &&
             (!is_index || value > 0.0),
         STATUS_FORMAT, "%s:%d: found %g%s, expected %s", s->path, p->line, p->value,
         s->scale == 1.0 ? "" : " percent",
         is_index          ? "n above 0 and k, of 1000 at most"
         : s->scale == 1.0 ? "values of 0 to 1"
                           : "values of 0 to 100 percent");
    *cut_count += !is_index && (value < 0.0 || value > 1.0);
out:
    return rc;
}

static status check(const spectral_series *s, size_t *out_count)
{
    status rc = STATUS_OK;
    size_t cut_count = 0;

    *out_count = 0;
    for (size_t i = 0; i < s->count; i++) {
        TRY(check_place(s, i));
        if (is_deleted(s, &s->point[i])) continue;
        TRY(check_value(s, &s->point[i], &cut_count));
        (*out_count)++;
    }
    NEED(*out_count >= POINTS_LEAST, STATUS_FORMAT,
         "%s:%d: found %zu points with a value, expected %d or more", s->path,
         s->count ? s->point[s->count - 1].line : 1, *out_count, POINTS_LEAST);
    if (cut_count)
        status_warn("%s: %zu values lie beyond 0 and 1 by up to %g, and are cut there", s->path,
                    cut_count, NOISE);
out:
    return rc;
}

/* Whether between two points, `deleted` of the file between them, nothing is known. */
static bool is_gap(const spectral_series *s, double low_um, double high_um, size_t deleted)
{
    return deleted > 0 || (s->is_sampled && high_um > GAP_RATIO * low_um);
}

static void fill(spectral_curve *out, const spectral_series *s)
{
    const wavelength_link link =
        wavelength_column_is_number(s->unit) ? WAVELENGTH_LINK_CM1 : WAVELENGTH_LINK_UM;
    const bool falls = wavelength_column_um(s->unit, s->point[0].place) >
                       wavelength_column_um(s->unit, s->point[1].place);
    double *const um = out->grid.wavelength_um;
    size_t n = 0, deleted = 0;

    for (size_t i = 0; i < s->count; i++) {
        const spectral_point *p = &s->point[falls ? s->count - 1 - i : i];
        if (is_deleted(s, p)) {
            deleted++;
            continue;
        }
        um[n] = wavelength_column_um(s->unit, p->place);
        out->value[n] = s->scale * p->value;
        if (out->absorption)
            out->absorption[n] = p->absorption;
        else
            out->value[n] = fmin(fmax(out->value[n], 0.0), 1.0);
        out->grid.link[n] = link;
        if (n > 0 && is_gap(s, um[n - 1], um[n], deleted))
            out->grid.link[n - 1] = WAVELENGTH_LINK_GAP;
        deleted = 0;
        n++;
    }
}

status spectral_series_finish(spectral_curve **out, const spectral_series *s)
{
    status rc = STATUS_OK;
    size_t count;
    spectral_curve *made = calloc(1, sizeof *made);

    NEED(made, STATUS_MEMORY, "%s: no memory for its spectrum", s->path);
    TRY(check(s, &count));
    TRY(wavelength_grid_make(&made->grid, count));
    made->quantity = s->quantity;
    made->value = malloc(count * sizeof *made->value);
    if (s->quantity == SPECTRAL_CONSTANTS)
        made->absorption = malloc(count * sizeof *made->absorption);
    NEED(made->value && (made->absorption || s->quantity != SPECTRAL_CONSTANTS), STATUS_MEMORY,
         "%s: no memory for its spectrum", s->path);
    fill(made, s);
    *out = made;
    made = NULL;
out:
    spectral_curve_free(made);
    return rc;
}
