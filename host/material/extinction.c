#include "material/extinction.h"

#include "material/wavelength_table.h"

#include <ctype.h>
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
    e->grid = wavenumber_rows_grid();
    e->per_m = malloc(WAVENUMBER_ROWS * sizeof *e->per_m);
    NEED(e->per_m, STATUS_MEMORY, "no memory for an extinction table");
    TRY(wavenumber_rows_read(file, &value, e->per_m, &cut_count));
    TRY(record_file_finish(file));
out:
    return rc;
}

status extinction_read(extinction **out, const char *path)
{
    static const wavelength_table_column column = {"extinction_per_km", 0.0, LARGEST_PER_KM};
    status rc = STATUS_OK;
    record_file *file = NULL;
    extinction *e = calloc(1, sizeof *e);

    NEED(e, STATUS_MEMORY, "no memory for an extinction table");
    e->broad_band_per_m = NAN;
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    const char *line = record_file_peek(file);
    if (line && isalpha((unsigned char)*line))
        TRY(wavelength_table_read(&e->grid, &e->per_m, file, &column, 1));
    else
        TRY(read_rows(e, file));
    for (size_t i = 0; i < e->grid.count; i++) e->per_m[i] *= PER_KM;
    *out = e;
    e = NULL;
out:
    record_file_free(file);
    extinction_free(e);
    return rc;
}

void extinction_free(extinction *e)
{
    if (!e) return;
    wavelength_grid_free(&e->grid);
    free(e->per_m);
    free(e);
}
