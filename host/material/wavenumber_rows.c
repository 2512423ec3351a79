#include "material/wavenumber_rows.h"

#include <math.h>
#include <stdio.h>

wavelength_grid wavenumber_rows_grid(void)
{
    return (wavelength_grid){.count = WAVENUMBER_ROWS,
                             .first_cm1 = WAVENUMBER_ROWS_FIRST_CM1,
                             .step_cm1 = WAVENUMBER_ROWS_STEP_CM1};
}

status wavenumber_rows_read(record_file *file, const wavenumber_value *value, double *out,
                            size_t *out_cut_count)
{
    status rc = STATUS_OK;
    char expected[96];
    double row[2];

    snprintf(expected, sizeof expected, "a wavenumber and %s", value->what);
    for (int i = 0; i < WAVENUMBER_ROWS; i++) {
        const int wavenumber = WAVENUMBER_ROWS_FIRST_CM1 - i * WAVENUMBER_ROWS_STEP_CM1;
        TRY(record_file_numbers(file, 2, row, expected));
        if (row[0] != (double)wavenumber || row[1] < -value->noise ||
            row[1] > value->most + value->noise) {
            rc = record_file_reject(file, "%d and %s from 0 to %g", wavenumber, value->what,
                                    value->most);
            goto out;
        }
        *out_cut_count += row[1] < 0.0 || row[1] > value->most;
        out[i] = fmin(fmax(row[1], 0.0), value->most);
    }
out:
    return rc;
}
