#include "files/wavelength_column.h"
#include "spectrum/spectral_file.h"
#include "spectrum/spectral_series.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

/* What the header says. */
typedef struct ecostress_header {
    const unit *unit;
    spectral_quantity quantity;
    double scale; /* of values; 0: no unit was stated */
    char measurement[SPECTRAL_TEXT_SIZE];
    double first[2];   /* the first point */
    long stated_count; /* 0: not stated */
} ecostress_header;

bool ecostress_file_begins(const char *line)
{
    return !strncasecmp(line, "name:", 5);
}

/* The value of a line of this key; NULL: it has another one. */
static const char *value_of(const char *line, const char *key)
{
    const size_t length = strlen(key);

    if (strncasecmp(line, key, length) || line[length] != ':') return NULL;
    line += length + 1;
    while (isspace((unsigned char)*line)) line++;
    return line;
}

static bool names(const char *text, const char *word)
{
    for (; *text; text++)
        if (!strncasecmp(text, word, strlen(word))) return true;
    return false;
}

static status take_x(ecostress_header *h, const char *text, const record_file *file)
{
    h->unit = wavelength_column_unit(text);
    if (h->unit) return STATUS_OK;
    return record_file_reject(file, "X Units: Wavelength (micrometers), (nanometers) or Wavenumber "
                                    "(cm-1)");
}

static status take_y(ecostress_header *h, const char *text, const record_file *file)
{
    const bool is_percent = names(text, "percent") || strchr(text, '%');

    h->scale = is_percent ? 0.01 : 1.0;
    if (names(text, "reflectance"))
        h->quantity = SPECTRAL_REFLECTANCE;
    else if (names(text, "emissivity"))
        h->quantity = SPECTRAL_EMISSIVITY;
    else if (names(text, "transmit") || names(text, "transmission"))
        h->quantity = SPECTRAL_TRANSMITTANCE;
    else
        return record_file_reject(file,
                                  "Y Units: Reflectance (percent), Emissivity or Transmittance");
    return STATUS_OK;
}

static status take_line(ecostress_header *h, const char *line, const record_file *file)
{
    status rc = STATUS_OK;
    const char *text;

    if ((text = value_of(line, "x units"))) TRY(take_x(h, text, file));
    if ((text = value_of(line, "y units"))) TRY(take_y(h, text, file));
    if ((text = value_of(line, "measurement")))
        snprintf(h->measurement, sizeof h->measurement, "%s", text);
    if ((text = value_of(line, "number of x values"))) h->stated_count = strtol(text, NULL, 10);
out:
    return rc;
}

/* Takes the header and the first point behind it. */
static status read_header(ecostress_header *h, record_file *file)
{
    status rc = STATUS_OK;
    const char *line;

    do {
        TRY(record_file_text(file, &line, "X Units, Y Units and the points of a spectrum"));
        TRY(take_line(h, line, file));
    } while (record_numbers(line, 2, h->first) != 2);
    if (!h->unit || h->scale == 0.0)
        rc = record_file_reject(file, "X Units and Y Units before the first point");
out:
    return rc;
}

/* Takes one line of the table: a wavelength without a value is a deleted channel; lines of wavelength 0, which fill some
 * files up, are passed over. */
static status take_point(spectral_series *s, const char *line, const record_file *file)
{
    double pair[2];
    const int count = record_numbers(line, 2, pair);

    if (count != 1 && count != 2) return record_file_reject(file, "a wavelength and a value");
    if (pair[0] == 0.0) return STATUS_OK;
    const double value = count == 2 ? pair[1] : -HUGE_VAL;
    return spectral_series_add(s, (spectral_point){pair[0], value, 0.0, record_file_line(file)});
}

/* Takes all points, of which the header has passed the first.
 *   out_count   of lines */
static status read_points(spectral_series *s, const ecostress_header *h, record_file *file,
                          size_t *out_count)
{
    status rc = STATUS_OK;
    const char *line;

    *out_count = 1;
    TRY(spectral_series_add(
        s, (spectral_point){h->first[0], h->first[1], 0.0, record_file_line(file)}));
    for (; !record_file_at_end(file); (*out_count)++) {
        TRY(record_file_text(file, &line, "a wavelength and a value"));
        TRY(take_point(s, line, file));
    }
out:
    return rc;
}

status ecostress_file_read(spectral_curve **out, record_file *file, const char *path)
{
    status rc = STATUS_OK;
    ecostress_header h = {0};
    spectral_series s = {.path = path, .is_sampled = true};
    size_t count;

    TRY(read_header(&h, file));
    s.unit = h.unit;
    s.scale = h.scale;
    s.quantity = h.quantity;
    TRY(read_points(&s, &h, file, &count));
    if (h.stated_count > 0 && count != (size_t)h.stated_count) {
        rc = record_file_reject(file, "%ld points, as the header states, not %zu", h.stated_count,
                                count);
        goto out;
    }
    TRY(spectral_series_finish(out, &s));
    strcpy((*out)->measurement, h.measurement);
    (*out)->is_directional =
        names(h.measurement, "bidirectional") || names(h.measurement, "bi-directional") ||
        names(h.measurement, "biconical") || names(h.measurement, "bi-conical");
out:
    spectral_series_free(&s);
    return rc;
}
