#include "spectrum/spectral_file.h"
#include "spectrum/spectral_series.h"

#include <string.h>

/* Passes over what stands before the table of n and k. */
static status find_table(record_file *file)
{
    static const char expected[] = "type: tabulated nk, then data: |";
    status rc = STATUS_OK;
    const char *line, *type = NULL;

    do {
        TRY(record_file_text(file, &line, expected));
        if ((type = strstr(line, "type:")) && !strstr(type, "tabulated nk")) {
            rc = record_file_reject(file, "%s", expected);
            goto out;
        }
    } while (!type);
    TRY(record_file_text(file, &line, "data: |"));
    if (strncmp(line, "data:", 5) != 0) rc = record_file_reject(file, "data: |");
out:
    return rc;
}

/* Whether a line is another key of the document. */
static bool is_key(const char *line)
{
    const char *colon = strchr(line, ':'), *end = strchr(line, '\n');

    return colon && (!end || colon < end);
}

status refractive_index_file_read(spectral_curve **out, record_file *file, const char *path)
{
    status rc = STATUS_OK;
    const char *line;
    double row[3];
    spectral_series s = {.path = path,
                         .unit = unit_find("um", "wavelength"),
                         .scale = 1.0,
                         .quantity = SPECTRAL_CONSTANTS};

    TRY(find_table(file));
    while ((line = record_file_peek(file)) && !is_key(line)) {
        TRY(record_file_numbers(file, 3, row, "a wavelength in um, n and k"));
        TRY(spectral_series_add(&s,
                                (spectral_point){row[0], row[1], row[2], record_file_line(file)}));
    }
    TRY(spectral_series_finish(out, &s));
out:
    spectral_series_free(&s);
    return rc;
}
