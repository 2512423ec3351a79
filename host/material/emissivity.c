#include "material/emissivity.h"

#include "material/emissivity_law.h"

#include <ctype.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Reflectances near 0, as of soot, come out above 1 by the calibration's error. */
static const wavenumber_value value = {"an emissivity", 1.0, .02};

static status allocate(emissivity **out, size_t angle_count, size_t count)
{
    status rc = STATUS_OK;
    emissivity *e = calloc(1, sizeof *e);

    NEED(e, STATUS_MEMORY, "no memory for an emissivity table");
    e->outside = NAN;
    e->angle_count = angle_count;
    e->value = malloc(angle_count * count * sizeof *e->value);
    e->angle_deg = calloc(angle_count, sizeof *e->angle_deg);
    NEED(e->value && e->angle_deg, STATUS_MEMORY, "no memory for an emissivity table");
    *out = e;
    e = NULL;
out:
    emissivity_free(e);
    return rc;
}

static status read_angle(emissivity *e, record_file *file, int angle, size_t *cut_count)
{
    status rc = STATUS_OK;
    double row[WAVENUMBER_ROWS];
    long stated;

    TRY(record_file_count(file, angle, angle, &stated, "an angle in degrees"));
    TRY(wavenumber_rows_read(file, &value, row, cut_count));
    for (int i = 0; i < WAVENUMBER_ROWS; i++) e->value[angle * WAVENUMBER_ROWS + i] = (float)row[i];
    e->angle_deg[angle] = angle;
out:
    return rc;
}

status emissivity_read(emissivity **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    emissivity *e = NULL;
    size_t cut_count = 0;

    TRY(allocate(&e, EMISSIVITY_ANGLES, WAVENUMBER_ROWS));
    e->law = EMISSIVITY_MEASURED;
    e->grid = wavenumber_rows_grid();
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    const char *line = record_file_peek(file);
    if (line && isalpha((unsigned char)*line)) {
        TRY(record_file_text(file, &line, "an angle"));
        rc =
            record_file_reject(file, "an angle in degrees, as an .ems has it: measured spectra are "
                                     "read by spectrum_file");
        goto out;
    }
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++)
        TRY(read_angle(e, file, angle, &cut_count));
    TRY(record_file_finish(file));
    if (cut_count)
        status_warn("%s: %zu emissivities lie beyond 0 and 1 by up to %g, and are cut there", path,
                    cut_count, value.noise);
    *out = e;
    e = NULL;
out:
    record_file_free(file);
    emissivity_free(e);
    return rc;
}

void emissivity_free(emissivity *e)
{
    if (!e) return;
    wavelength_grid_free(&e->grid);
    free(e->angle_deg);
    free(e->value);
    free(e);
}

status emissivity_make(emissivity **out, spectral_curve *const *curve, const double *angle_deg,
                       size_t count, emissivity_law law)
{
    status rc = STATUS_OK;
    emissivity *e = NULL;
    const wavelength_grid *grid = &curve[0]->grid;
    const size_t n = grid->count;
    const bool is_optical = curve[0]->quantity == SPECTRAL_CONSTANTS;

    TRY(allocate(&e, is_optical ? 2 : count, n));
    e->law = is_optical ? EMISSIVITY_OPTICAL : law;
    TRY(wavelength_grid_make(&e->grid, n));
    memcpy(e->grid.wavelength_um, grid->wavelength_um, n * sizeof *grid->wavelength_um);
    memcpy(e->grid.link, grid->link, n * sizeof *grid->link);
    for (size_t a = 0; a < count; a++) {
        if (angle_deg) e->angle_deg[a] = angle_deg[a];
        for (size_t i = 0; i < n; i++)
            e->value[a * n + i] = (float)wavelength_grid_value(&curve[a]->grid, curve[a]->value,
                                                               1e4 / grid->wavelength_um[i]);
    }
    for (size_t i = 0; i < n && is_optical; i++) e->value[n + i] = (float)curve[0]->absorption[i];
    *out = e;
    e = NULL;
out:
    emissivity_free(e);
    return rc;
}

uint32_t emissivity_rows(const emissivity *e)
{
    return e->law == EMISSIVITY_CONSTANT ? 1 : EMISSIVITY_ANGLES;
}

/* The value of one row of the table. */
static double row_at(const emissivity *e, size_t row, wavelength_place at)
{
    const float *v = e->value + row * e->grid.count + at.low;

    return (double)v[0] + at.fraction * ((double)v[1] - (double)v[0]);
}

static double measured_at(const emissivity *e, wavelength_place at, double angle_deg)
{
    size_t row = 0, beyond = e->angle_count;

    while (beyond - row > 1) {
        const size_t middle = (row + beyond) / 2;
        if (e->angle_deg[middle] <= angle_deg)
            row = middle;
        else
            beyond = middle;
    }
    const double here = row_at(e, row, at);
    if (row + 1 == e->angle_count || angle_deg <= e->angle_deg[row]) return here;
    const double share =
        (angle_deg - e->angle_deg[row]) / (e->angle_deg[row + 1] - e->angle_deg[row]);
    return here + share * (row_at(e, row + 1, at) - here);
}

/* What stands at a place of the grid, by its law. */
static double value_at(const emissivity *e, wavelength_place at, double angle_deg)
{
    switch (e->law) {
    case EMISSIVITY_MEASURED:
        return measured_at(e, at, angle_deg);
    case EMISSIVITY_OPTICAL:
        return emissivity_law_optical(row_at(e, 0, at), row_at(e, 1, at), angle_deg);
    case EMISSIVITY_FRESNEL:
        return emissivity_law_fresnel(row_at(e, 0, at), angle_deg);
    case EMISSIVITY_ROUGH:
        return emissivity_law_rough(row_at(e, 0, at), angle_deg);
    case EMISSIVITY_THESIS:
        return emissivity_law_thesis(row_at(e, 0, at), angle_deg);
    default:
        return row_at(e, 0, at);
    }
}

/* Whether a stated number stands there instead. */
static bool is_outside(const emissivity *e, double wavenumber_cm1)
{
    return !isnan(e->outside) && !wavelength_grid_covers(&e->grid, 1e4 / wavenumber_cm1);
}

double emissivity_at(const emissivity *e, double wavenumber_cm1, double angle_deg)
{
    if (is_outside(e, wavenumber_cm1)) return e->outside;
    return value_at(e, wavelength_grid_find(&e->grid, wavenumber_cm1), angle_deg);
}

void emissivity_sample(const emissivity *e, const double *wavenumber_cm1, uint32_t count,
                       float *out)
{
    const uint32_t rows = emissivity_rows(e);

    for (uint32_t i = 0; i < count; i++) {
        const bool outside = is_outside(e, wavenumber_cm1[i]);
        const wavelength_place at = wavelength_grid_find(&e->grid, wavenumber_cm1[i]);
        for (uint32_t angle = 0; angle < rows; angle++)
            out[(size_t)angle * count + i] =
                (float)(outside ? e->outside : value_at(e, at, (double)angle));
    }
}

/* Simpson's rule on every piece between the table's points. */
double emissivity_integral(const emissivity *e, double from_um, double to_um)
{
    const double *l = e->grid.wavelength_um;
    double sum = 0.0, low = from_um;
    size_t next = l ? wavelength_grid_find(&e->grid, 1e4 / from_um).low : 0;

    while (low < to_um) {
        double high = to_um;
        if (l) {
            while (next < e->grid.count && l[next] <= low) next++;
            if (next < e->grid.count) high = fmin(high, l[next]);
        } else {
            high = fmin(high, 1e4 / (1e4 / low - e->grid.step_cm1 / 2.0));
        }
        sum += (high - low) / 6.0 *
               (emissivity_at(e, 1e4 / low, 0.0) + 4.0 * emissivity_at(e, 2e4 / (low + high), 0.0) +
                emissivity_at(e, 1e4 / high, 0.0));
        low = high;
    }
    return sum;
}
