#include "files/csv_row.h"

#include "base/array.h"

#include <stdbool.h>
#include <stdlib.h>
#include <string.h>
#include <strings.h>

static bool is_blank(char c)
{
    return c == ' ' || c == '\t';
}

char csv_separator(const char *line)
{
    static const char kinds[] = ",;\t";
    size_t count[sizeof kinds] = {0};
    bool is_quoted = false;
    int most = 0;

    for (; *line; line++) {
        if (*line == '"') is_quoted = !is_quoted;
        const char *kind = is_quoted ? NULL : strchr(kinds, *line);
        if (kind) count[kind - kinds]++;
    }
    for (int i = 1; kinds[i]; i++)
        if (count[i] > count[most]) most = i;
    return kinds[most];
}

/* Copies a quoted field without its quotes; returns its end, or NULL where no quote closes it. */
static const char *copy_quoted(char **out, const char *at, char separator)
{
    for (at++;; at++) {
        if (!*at) return NULL;
        if (*at == '"' && *++at != '"') break;
        *(*out)++ = *at;
    }
    while (is_blank(*at) && *at != separator) at++;
    return *at && *at != separator ? NULL : at;
}

/* Copies the field that begins at `at`; returns its end, the separator or the line's end. */
static const char *copy_field(char **out, const char *at, char separator)
{
    char *const begin = *out;
    const char *end = NULL;

    while (is_blank(*at) && *at != separator) at++;
    if (*at == '"') end = copy_quoted(out, at, separator);
    if (!end) {
        *out = begin;
        for (end = at; *end && *end != separator; end++) *(*out)++ = *end;
        while (*out > begin && is_blank((*out)[-1])) (*out)--;
    }
    *(*out)++ = '\0';
    return end;
}

/* Makes 20,5 the number that it is where commas do not separate. */
static void set_decimal_point(char *field)
{
    const size_t sign = strspn(field, "+-"), whole = strspn(field + sign, "0123456789");
    char *comma = field + sign + whole;

    if (sign > 1 || whole == 0 || *comma != ',') return;
    if (comma[1] && comma[1 + strspn(comma + 1, "0123456789")] == '\0') *comma = '.';
}

status csv_row_split(csv_row *row, const char *line, char separator)
{
    status rc = STATUS_OK;
    const size_t size = strlen(line) + 2;
    char *end;

    if (size > row->size) {
        NEED(array_resize(&row->text, size, 1), STATUS_MEMORY, "no memory for a line");
        row->size = size;
    }
    row->count = 0;
    end = row->text;
    for (;; line++) {
        NEED(array_add(&row->field, row->count, sizeof *row->field), STATUS_MEMORY,
             "no memory for the fields of a line");
        row->field[row->count++] = end;
        line = copy_field(&end, line, separator);
        if (!*line) break;
    }
    row->width = row->count;
    while (row->count > 0 && !*row->field[row->count - 1]) row->count--;
    for (size_t i = 0; i < row->count && separator != ','; i++) set_decimal_point(row->field[i]);
out:
    return rc;
}

status csv_row_take(csv_row *row, record_file *file, char separator, const char *expected)
{
    status rc = STATUS_OK;
    const char *line;

    TRY(record_file_text(file, &line, expected));
    TRY(csv_row_split(row, line, separator));
out:
    return rc;
}

status csv_row_names(csv_row *row, record_file *file, char *out_separator, const char *expected)
{
    status rc = STATUS_OK;
    const char *line;

    TRY(record_file_header(file, NULL));
    TRY(record_file_text(file, &line, expected));
    if (!strncasecmp(line, "sep=", 4)) TRY(record_file_text(file, &line, expected));
    *out_separator = csv_separator(line);
    TRY(csv_row_split(row, line, *out_separator));
out:
    return rc;
}

status csv_row_check(const csv_row *row, size_t names, const record_file *file)
{
    if (row->width >= names && row->count <= names) return STATUS_OK;
    return record_file_reject(file, "%zu fields, one for each name, not %zu", names, row->width);
}

const char *csv_row_field(const csv_row *row, size_t place)
{
    return place < row->count ? row->field[place] : "";
}

void csv_row_free(csv_row *row)
{
    free(row->field);
    free(row->text);
    *row = (csv_row){0};
}
