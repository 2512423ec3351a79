#include "spectrum/spectral_file.h"
#include "spectrum/spectral_series.h"

#include <string.h>

bool svc_file_begins(const char *line)
{
    return !strncmp(line, "/*** Spectra Vista", 18);
}

/* A leaf clip, a fore-optic and a panel: two directions, whatever the header's other lines say. */
static void set_measurement(spectral_curve *s)
{
    strcpy(s->measurement, "bidirectional (field spectrometer)");
    s->is_directional = true;
}

status svc_file_read(spectral_curve **out, record_file *file, const char *path)
{
    status rc = STATUS_OK;
    const char *line;
    double row[4];
    spectral_series s = {.path = path,
                         .is_sampled = true,
                         .unit = unit_find("nm", "wavelength"),
                         .scale = 0.01,
                         .quantity = SPECTRAL_REFLECTANCE};

    do TRY(record_file_text(file, &line, "data=, and the points behind it"));
    while (strcmp(line, "data=") != 0);
    while (!record_file_at_end(file)) {
        TRY(record_file_numbers(file, 4, row, "wavelength, reference, target, reflectance"));
        TRY(spectral_series_add(&s, (spectral_point){row[0], row[3], 0.0, record_file_line(file)}));
    }
    TRY(spectral_series_finish(out, &s));
    set_measurement(*out);
out:
    spectral_series_free(&s);
    return rc;
}
