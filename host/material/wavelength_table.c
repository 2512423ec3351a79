#include "material/wavelength_table.h"

#include "base/array.h"
#include "base/number.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "files/wavelength_column.h"
#include "material/wavenumber_rows.h"

#include <stdio.h>
#include <stdlib.h>

enum { COLUMNS = 2, LEAST_ROWS = 3, EXPECTED_SIZE = 256 };

static const double LEAST_UM = 0.1, MOST_UM = 200.0;

/* A table while it is read: places in the file's unit. */
typedef struct table {
    record_file *file;
    const wavelength_table_column *column;
    size_t column_count, count;
    const unit *unit;
    char separator;
    double *place, *value[COLUMNS];
} table;

static void free_table(table *t)
{
    free(t->place);
    for (size_t c = 0; c < COLUMNS; c++) free(t->value[c]);
}

static const char *expected(const table *t, char out[EXPECTED_SIZE])
{
    size_t length =
        (size_t)snprintf(out, EXPECTED_SIZE, "wavelength_um, wavelength_nm or wavenumber_cm1");

    for (size_t c = 0; c < t->column_count; c++)
        length += (size_t)snprintf(out + length, EXPECTED_SIZE - length, ", %s", t->column[c].name);
    return out;
}

static status read_names(table *t, csv_row *row)
{
    status rc = STATUS_OK;
    char text[EXPECTED_SIZE], name[EXPECTED_SIZE];

    TRY(csv_row_names(row, t->file, &t->separator, expected(t, text)));
    t->unit = wavelength_column_unit(csv_row_field(row, 0));
    bool is_right = t->unit && row->count == t->column_count + 1;
    for (size_t c = 0; is_right && c < t->column_count; c++) {
        snprintf(name, sizeof name, "|%s|", t->column[c].name);
        is_right = heading_is_named(csv_row_field(row, c + 1), name);
    }
    if (!is_right) rc = record_file_reject(t->file, "%s", text);
out:
    return rc;
}

static status check_place(const table *t, double place)
{
    const double um = wavelength_column_um(t->unit, place);
    const size_t n = t->count;

    if (!(um >= LEAST_UM && um <= MOST_UM))
        return record_file_reject(t->file, "a wavelength of %g to %g um", LEAST_UM, MOST_UM);
    if ((n > 0 && place == t->place[n - 1]) ||
        (n > 1 && (place > t->place[n - 1]) != (t->place[1] > t->place[0])))
        return record_file_reject(t->file, "wavelengths that only rise or only fall");
    return STATUS_OK;
}

static status read_row(table *t, csv_row *row)
{
    status rc = STATUS_OK;
    char text[EXPECTED_SIZE];
    double number[COLUMNS + 1];

    TRY(csv_row_take(row, t->file, t->separator, "a row"));
    for (size_t c = 0; c <= t->column_count; c++)
        if (row->count != t->column_count + 1 || !number_read(row->field[c], &number[c]))
            TRY(record_file_reject(t->file, "%s", expected(t, text)));
    TRY(check_place(t, number[0]));
    for (size_t c = 0; c < t->column_count; c++)
        if (!(number[c + 1] >= t->column[c].low && number[c + 1] <= t->column[c].high))
            TRY(record_file_reject(t->file, "%s from %g to %g", t->column[c].name, t->column[c].low,
                                   t->column[c].high));
    bool has_room = array_add(&t->place, t->count, sizeof *t->place);
    for (size_t c = 0; c < t->column_count; c++)
        has_room = has_room && array_add(&t->value[c], t->count, sizeof *t->value[c]);
    NEED(has_room, STATUS_MEMORY, "no memory for a table");
    for (size_t c = 0; c < t->column_count; c++) t->value[c][t->count] = number[c + 1];
    t->place[t->count++] = number[0];
out:
    return rc;
}

static void turn_round(double *values, size_t count)
{
    for (size_t i = 0, k = count - 1; i < k; i++, k--) {
        const double kept = values[i];
        values[i] = values[k];
        values[k] = kept;
    }
}

/* Whether the rows stand on the wavenumbers of an .ext. */
static bool is_even(const table *t)
{
    bool even = t->count == WAVENUMBER_ROWS && wavelength_column_is_number(t->unit);

    for (size_t i = 0; even && i < t->count; i++)
        even =
            t->place[i] == (double)(WAVENUMBER_ROWS_FIRST_CM1 - (int)i * WAVENUMBER_ROWS_STEP_CM1);
    return even;
}

static status make_grid(wavelength_grid *out, table *t)
{
    status rc = STATUS_OK;
    const bool is_number = wavelength_column_is_number(t->unit);

    if (is_even(t)) {
        *out = wavenumber_rows_grid();
        return STATUS_OK;
    }
    if ((t->place[1] > t->place[0]) == is_number) {
        turn_round(t->place, t->count);
        for (size_t c = 0; c < t->column_count; c++) turn_round(t->value[c], t->count);
    }
    TRY(wavelength_grid_make(out, t->count));
    for (size_t i = 0; i < t->count; i++) {
        out->wavelength_um[i] = wavelength_column_um(t->unit, t->place[i]);
        out->link[i] = is_number ? WAVELENGTH_LINK_CM1 : WAVELENGTH_LINK_UM;
    }
out:
    return rc;
}

status wavelength_table_read(wavelength_grid *out_grid, double **out_value, record_file *file,
                             const wavelength_table_column *column, size_t column_count)
{
    status rc = STATUS_OK;
    csv_row row = {0};
    table t = {.file = file, .column = column, .column_count = column_count};

    TRY(read_names(&t, &row));
    while (t.count < LEAST_ROWS || !record_file_at_end(file)) TRY(read_row(&t, &row));
    TRY(make_grid(out_grid, &t));
    for (size_t c = 0; c < column_count; c++) {
        out_value[c] = t.value[c];
        t.value[c] = NULL;
    }
out:
    free_table(&t);
    csv_row_free(&row);
    return rc;
}
