#include "material/emissivity.h"

#include <stdlib.h>

/* Reflectances near 0, as of soot, come out above 1 by the calibration's error. */
static const wavenumber_value value = {"an emissivity", 1.0, .02};

static status read_angle(emissivity *e, record_file *file, int angle, size_t *cut_count)
{
    status rc = STATUS_OK;
    double row[EMISSIVITY_WAVENUMBERS];
    long stated;

    TRY(record_file_count(file, angle, angle, &stated, "an angle in degrees"));
    TRY(wavenumber_rows_read(file, &value, row, cut_count));
    for (int i = 0; i < EMISSIVITY_WAVENUMBERS; i++) e->value[angle][i] = (float)row[i];
out:
    return rc;
}

status emissivity_read(emissivity **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    emissivity *e = malloc(sizeof *e);
    size_t cut_count = 0;

    NEED(e, STATUS_MEMORY, "no memory for an emissivity table");
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
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
    free(e);
}
