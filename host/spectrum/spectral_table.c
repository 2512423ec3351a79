#include "base/number.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "files/wavelength_column.h"
#include "spectrum/spectral_file.h"
#include "spectrum/spectral_series.h"

#include <string.h>

enum { HEADING_SIZE = 64 };

static const char expected[] =
    "wavelength_um, wavelength_nm or wavenumber_cm1, then emissivity, reflectance, "
    "reflectance_percent or transmittance, or n,k: or a spectrum of ECOSTRESS, splib07, ENVI, SVC, "
    "refractiveindex.info";

/* Finds what a column holds; false for other names. */
static bool take_quantity(spectral_series *s, const char *field)
{
    static const struct {
        const char *names;
        spectral_quantity quantity;
        double scale;
    } known[] = {{"|emissivity|emittance|", SPECTRAL_EMISSIVITY, 1.0},
                 {"|emissivity percent|", SPECTRAL_EMISSIVITY, 0.01},
                 {"|reflectance|", SPECTRAL_REFLECTANCE, 1.0},
                 {"|reflectance percent|", SPECTRAL_REFLECTANCE, 0.01},
                 {"|transmittance|", SPECTRAL_TRANSMITTANCE, 1.0},
                 {"|transmittance percent|", SPECTRAL_TRANSMITTANCE, 0.01}};
    char name[HEADING_SIZE], text[HEADING_SIZE];

    if (!heading_split(field, HEADING_SIZE - sizeof "percent", name, text)) return false;
    const unit *u = *text ? unit_find(text, "fraction") : NULL;
    if (*text && !u) return false;
    if (u && !strcmp(u->name, "%")) strcat(name, "percent");
    for (size_t i = 0; i < sizeof known / sizeof *known; i++) {
        if (!heading_is_named(name, known[i].names)) continue;
        s->quantity = known[i].quantity;
        s->scale = known[i].scale;
        return true;
    }
    return false;
}

static status read_heading(spectral_series *s, csv_row *row, record_file *file, char *separator)
{
    status rc = STATUS_OK;
    bool is_known;

    TRY(csv_row_names(row, file, separator, expected));
    s->unit = wavelength_column_unit(csv_row_field(row, 0));
    if (row->count == 3) {
        s->quantity = SPECTRAL_CONSTANTS;
        s->scale = 1.0;
        is_known = heading_is_named(csv_row_field(row, 1), "|n|") &&
                   heading_is_named(csv_row_field(row, 2), "|k|");
    } else {
        is_known = row->count == 2 && take_quantity(s, csv_row_field(row, 1));
    }
    if (!s->unit || !is_known) rc = record_file_reject(file, "%s", expected);
out:
    return rc;
}

static status read_row(spectral_series *s, csv_row *row, record_file *file, char separator)
{
    status rc = STATUS_OK;
    double number[3] = {0};
    const size_t count = s->quantity == SPECTRAL_CONSTANTS ? 3 : 2;

    TRY(csv_row_take(row, file, separator, "a wavelength and a value"));
    for (size_t i = 0; i < count; i++)
        if (!number_read_list(csv_row_field(row, i), 1, &number[i]) || row->count > count) {
            rc = record_file_reject(file, "%zu numbers", count);
            goto out;
        }
    TRY(spectral_series_add(
        s, (spectral_point){number[0], number[1], number[2], record_file_line(file)}));
out:
    return rc;
}

status spectral_table_read(spectral_curve **out, record_file *file, const char *path)
{
    status rc = STATUS_OK;
    csv_row row = {0};
    char separator;
    spectral_series s = {.path = path};

    TRY(read_heading(&s, &row, file, &separator));
    while (!record_file_at_end(file)) TRY(read_row(&s, &row, file, separator));
    TRY(spectral_series_finish(out, &s));
out:
    spectral_series_free(&s);
    csv_row_free(&row);
    return rc;
}
