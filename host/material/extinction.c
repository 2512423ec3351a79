#include "material/extinction.h"

#include <math.h>
#include <stdlib.h>

#define PER_KM 1e-3        /* per metre */
#define LARGEST_PER_KM 1e6 /* 1 per mm */

static const wavenumber_value value = {"an extinction per km", LARGEST_PER_KM, 0.0};

static status read_rows(extinction *e, record_file *file)
{
    status rc = STATUS_OK;
    double broad_band_per_km;
    size_t cut_count = 0;

    TRY(record_file_number(file, 0.0, LARGEST_PER_KM, &broad_band_per_km,
                           "the broad-band extinction per km"));
    e->broad_band_per_m = broad_band_per_km * PER_KM;
    TRY(wavenumber_rows_read(file, &value, e->per_m, &cut_count));
    for (int i = 0; i < EXTINCTION_WAVENUMBERS; i++) e->per_m[i] *= PER_KM;
out:
    return rc;
}

status extinction_read(extinction **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    extinction *e = malloc(sizeof *e);

    NEED(e, STATUS_MEMORY, "no memory for an extinction table");
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    TRY(read_rows(e, file));
    TRY(record_file_finish(file));
    *out = e;
    e = NULL;
out:
    record_file_free(file);
    extinction_free(e);
    return rc;
}

void extinction_free(extinction *e)
{
    free(e);
}

double extinction_between(const double *table, double wavenumber_cm1)
{
    const double last = EXTINCTION_WAVENUMBERS - 1;
    const double place = (EXTINCTION_FIRST_CM1 - wavenumber_cm1) / EXTINCTION_STEP_CM1;
    const double within = fmax(0.0, fmin(place, last));
    const int low = within >= last ? EXTINCTION_WAVENUMBERS - 2 : (int)within;

    return table[low] + (within - low) * (table[low + 1] - table[low]);
}
