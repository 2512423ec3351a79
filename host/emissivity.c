#include "emissivity.h"

#include "record_file.h"

#include <stdlib.h>

static status read_angle(emissivity *e, record_file *file, int angle)
{
    status rc = STATUS_OK;
    double row[2];
    long stated;

    TRY(record_file_count(file, angle, angle, &stated, "an angle in degrees"));
    for (int i = 0; i < EMISSIVITY_WAVENUMBERS; i++) {
        const int wavenumber = EMISSIVITY_FIRST_CM1 - i * EMISSIVITY_STEP_CM1;
        TRY(record_file_numbers(file, 2, row, "a wavenumber and an emissivity"));
        if (row[0] != (double)wavenumber || row[1] < 0.0 || row[1] > 1.0) {
            rc = record_file_reject(file, "%d and an emissivity from 0 to 1", wavenumber);
            goto out;
        }
        e->value[angle][i] = (float)row[1];
    }
out:
    return rc;
}

status emissivity_read(emissivity **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    emissivity *e = malloc(sizeof *e);

    NEED(e, STATUS_MEMORY, "emissivity table");
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    for (int angle = 0; angle < EMISSIVITY_ANGLES; angle++) TRY(read_angle(e, file, angle));
    TRY(record_file_finish(file));
    *out = e;
    e = NULL;
out:
    record_file_free(file);
    emissivity_free(e);
    return rc;
}

void emissivity_free(emissivity *e)
{
    free(e);
}
