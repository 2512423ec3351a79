#include "material/scattering.h"

#include "material/wavelength_table.h"

#include <stdlib.h>

#define LARGEST_ASYMMETRY 0.99 /* beyond, nothing would be scattered out of the beam */

status scattering_read(scattering **out, const char *path)
{
    static const wavelength_table_column columns[] = {{"single_scattering_albedo", 0.0, 1.0},
                                                      {"asymmetry", 0.0, LARGEST_ASYMMETRY}};
    status rc = STATUS_OK;
    record_file *file = NULL;
    double *value[2];
    scattering *s = calloc(1, sizeof *s);

    NEED(s, STATUS_MEMORY, "no memory for a scattering table");
    TRY(record_file_open(&file, path));
    TRY(wavelength_table_read(&s->grid, value, file, columns, 2));
    s->albedo = value[0];
    s->asymmetry = value[1];
    *out = s;
    s = NULL;
out:
    record_file_free(file);
    scattering_free(s);
    return rc;
}

void scattering_free(scattering *s)
{
    if (!s) return;
    wavelength_grid_free(&s->grid);
    free(s->albedo);
    free(s->asymmetry);
    free(s);
}
