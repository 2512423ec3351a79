#include "files/wavelength_column.h"

#include "files/heading.h"

#include <stddef.h>
#include <string.h>

enum { HEADING_SIZE = 64 };

static const char wavelength_names[] = "|wavelength|lambda|wl|wave|";

const unit *wavelength_column_unit(const char *field)
{
    char name[HEADING_SIZE], text[HEADING_SIZE];

    if (!heading_split(field, HEADING_SIZE, name, text)) return NULL;
    char *suffix = strrchr(name, '_');
    if (!*text && suffix) {
        strcpy(text, suffix + 1);
        *suffix = '\0';
    }
    const bool is_number = heading_is_named(name, "|wavenumber|");
    if (!is_number && !heading_is_named(name, wavelength_names)) return NULL;
    return unit_find(text, is_number ? "wavenumber" : "wavelength");
}

bool wavelength_column_is_number(const unit *of)
{
    return strcmp(of->quantity, "wavenumber") == 0;
}

double wavelength_column_um(const unit *of, double value)
{
    return wavelength_column_is_number(of) ? 1e4 / value : of->scale * value;
}
