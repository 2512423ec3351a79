#include "files/column.h"

#include "base/number.h"

#include <ctype.h>
#include <math.h>
#include <stdio.h>
#include <string.h>
#include <strings.h>

static const char *const no_value[] = {"na", "n/a", "nan", "-nan", "null", "none", "m"};

bool column_is_blank(const char *text)
{
    const char *end = text + strlen(text);

    while (isspace((unsigned char)*text)) text++;
    while (end > text && isspace((unsigned char)end[-1])) end--;
    if (strspn(text, "-*/.") >= (size_t)(end - text)) return true;
    for (size_t i = 0; i < sizeof no_value / sizeof *no_value; i++)
        if (strlen(no_value[i]) == (size_t)(end - text) &&
            !strncasecmp(text, no_value[i], (size_t)(end - text)))
            return true;
    return false;
}

/* Nines, then zeros: 99, 9999.9, -9999.900, -9900. */
static bool is_flag(double number)
{
    char digits[64];
    size_t nines = 0;

    snprintf(digits, sizeof digits, "%.3f", fabs(number));
    for (const char *c = digits; *c; c++) {
        if (*c == '.') continue;
        if (*c != '9') return nines >= 2 && strspn(c, "0.") == strlen(c);
        nines++;
    }
    return nines >= 2;
}

column_place column_place_at(const column *c, const unit *here, size_t field)
{
    const unit *usual = unit_find(c->unit, NULL);

    return (column_place){c, usual, here ? here : usual, field};
}

void column_places(column_place *out, const column *columns, size_t count)
{
    for (size_t i = 0; i < count; i++) {
        out[i] = (column_place){0};
        if (columns[i].name) out[i] = column_place_at(&columns[i], NULL, (size_t)columns[i].field);
    }
}

double column_value(const column_place *place, double number, const record_file *file,
                    column_gaps *gaps)
{
    const column *c = place->column;

    if (!c || (c->is_missing_at_zero && number == 0.0)) return NAN;
    const unit *usual = place->usual;
    const double value = place->unit->scale * number + place->unit->offset;
    const double low = usual->scale * c->low + usual->offset;
    const double high = usual->scale * c->high + usual->offset;
    const double slack = 1e-9 * (high - low);
    if (value >= low - slack && value <= high + slack) return value;
    if (!is_flag(number) && gaps->count++ == 0)
        snprintf(gaps->first, sizeof gaps->first, "line %d: %s from %g to %g %s, not %g",
                 record_file_line(file), c->name, (low - place->unit->offset) / place->unit->scale,
                 (high - place->unit->offset) / place->unit->scale, place->unit->name, number);
    return NAN;
}

status column_read(double *out, const column_place *place, const char *text,
                   const record_file *file, column_gaps *gaps)
{
    double number;

    *out = NAN;
    if (!place->column || column_is_blank(text)) return STATUS_OK;
    if (!number_read_list(text, 1, &number))
        return record_file_reject(file, "%s in %s, not '%.40s'", place->column->name,
                                  place->unit->name, text);
    *out = column_value(place, number, file, gaps);
    return STATUS_OK;
}

void column_gaps_tell(const column_gaps *gaps, const char *path)
{
    if (gaps->count == 1)
        status_warn("%s: counts as missing what is out of range: %s", path, gaps->first);
    if (gaps->count > 1)
        status_warn("%s: counts as missing %zu values that are out of range, the first in %s", path,
                    gaps->count, gaps->first);
}
