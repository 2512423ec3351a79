#include "material/scattering.h"

#include "files/record_file.h"

#include <stdlib.h>
#include <string.h>

#define LARGEST_ASYMMETRY 0.99 /* beyond, nothing would be scattered out of the beam */

static const char columns[] = "wavenumber_cm1,single_scattering_albedo,asymmetry";

static status read_rows(scattering *s, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    double row[3];

    TRY(record_file_text(file, &text, columns));
    if (strcmp(text, columns) != 0) {
        rc = record_file_reject(file, "%s", columns);
        goto out;
    }
    for (int i = 0; i < EXTINCTION_WAVENUMBERS; i++) {
        const int wavenumber = EXTINCTION_FIRST_CM1 - i * EXTINCTION_STEP_CM1;
        TRY(record_file_numbers(file, 3, row, "a wavenumber, an albedo and an asymmetry"));
        if (row[0] != (double)wavenumber || row[1] < 0.0 || row[1] > 1.0 || row[2] < 0.0 ||
            row[2] > LARGEST_ASYMMETRY) {
            rc = record_file_reject(file, "%d, an albedo from 0 to 1, an asymmetry from 0 to %g",
                                    wavenumber, LARGEST_ASYMMETRY);
            goto out;
        }
        s->albedo[i] = row[1];
        s->asymmetry[i] = row[2];
    }
out:
    return rc;
}

status scattering_read(scattering **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    scattering *s = malloc(sizeof *s);

    NEED(s, STATUS_MEMORY, "no memory for a scattering table");
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    TRY(read_rows(s, file));
    TRY(record_file_finish(file));
    *out = s;
    s = NULL;
out:
    record_file_free(file);
    scattering_free(s);
    return rc;
}

void scattering_free(scattering *s)
{
    free(s);
}
