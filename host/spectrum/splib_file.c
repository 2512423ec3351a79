#include "spectrum/spectral_file.h"
#include "spectrum/spectral_series.h"

#include <stdio.h>
#include <string.h>

bool splib_file_begins(const char *line)
{
    return !strncmp(line, "splib", 5) && strchr(line, ':');
}

/* What the last words of a title say: the spectrometer, and absolute or relative reflectance. */
static status take_title(spectral_series *s, char *measurement, bool *is_directional,
                         const char *title, const record_file *file)
{
    static const struct {
        const char *begin, *text;
        bool is_directional;
    } spectrometers[] = {{" BECK", "directional-hemispherical (Beckman)", false},
                         {" ASD", "bidirectional (ASD)", true},
                         {" NIC4", "biconical (Nicolet)", true},
                         {" AVIR", "bidirectional (AVIRIS)", true}};

    for (size_t i = 0; i < sizeof spectrometers / sizeof *spectrometers; i++)
        if (strstr(title, spectrometers[i].begin)) {
            strcpy(measurement, spectrometers[i].text);
            *is_directional = spectrometers[i].is_directional;
        }
    s->quantity = SPECTRAL_REFLECTANCE;
    if (strstr(title, "TRAN") || strstr(title, "RTGC"))
        s->quantity = SPECTRAL_TRANSMITTANCE;
    else if (!strstr(title, "REF"))
        return record_file_reject(file, "a title that ends with AREF, RREF, TRAN or RTGC");
    return STATUS_OK;
}

static status read_wavelengths(spectral_series *s, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    const char *line;
    double um;

    TRY(record_file_open(&file, path));
    TRY(record_file_text(file, &line, "a title that begins with splib"));
    if (!splib_file_begins(line) || !strstr(line, "avelength")) {
        rc = record_file_reject(file,
                                "the title of a file of wavelengths, splib07.. Wavelengths ..");
        goto out;
    }
    while (!record_file_at_end(file)) {
        TRY(record_file_number(file, 0.0, 1e3, &um, "a wavelength in um"));
        TRY(spectral_series_add(s, (spectral_point){um, 0.0, 0.0, 0}));
    }
out:
    record_file_free(file);
    return rc;
}

static status read_values(spectral_series *s, record_file *file)
{
    status rc = STATUS_OK;

    for (size_t i = 0; i < s->count; i++) {
        TRY(record_file_numbers(file, 1, &s->point[i].value, "a value for every wavelength"));
        s->point[i].line = record_file_line(file);
    }
    TRY(record_file_finish(file));
out:
    return rc;
}

status splib_file_read(spectral_curve **out, record_file *file, const spectral_source *source)
{
    status rc = STATUS_OK;
    char measurement[SPECTRAL_TEXT_SIZE] = "";
    bool is_directional = false;
    const char *title;
    spectral_series s = {.path = source->path,
                         .is_sampled = true,
                         .unit = unit_find("um", "wavelength"),
                         .scale = 1.0};

    TRY(record_file_text(file, &title, "a title"));
    if (!source->wavelength_path) {
        rc = record_file_reject(
            file, "wavelength_file too, the splib07 file of the spectrometer's wavelengths");
        goto out;
    }
    TRY(take_title(&s, measurement, &is_directional, title, file));
    TRY(read_wavelengths(&s, source->wavelength_path));
    TRY(read_values(&s, file));
    TRY(spectral_series_finish(out, &s));
    strcpy((*out)->measurement, measurement);
    (*out)->is_directional = is_directional;
out:
    spectral_series_free(&s);
    return rc;
}
