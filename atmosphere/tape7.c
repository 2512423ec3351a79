#include "tape7.h"

#include "base/array.h"
#include "base/number.h"
#include "files/record_file.h"
#include "tape7_head.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define PER_CM2 1e4    /* W cm-2 to W m-2 */
#define PER_CM1_UM 1e4 /* per cm-1 to per um: nu^2 / 1e4 */
#define PRINTED 1e-6   /* of wavelengths: their last digit */
#define LEAST_UM 0.1
#define MOST_UM 1000.0

enum { LIST_SIZE = 1024 };

/* One run of a file, for the list. */
typedef struct run_range {
    int head_line, rows;
    double first_cm1, last_cm1;
} run_range;

static bool is_last_mark(const char *text)
{
    double value;
    const char *rest = number_take(text, &value);

    return rest && value == -9999.0;
}

static double **list_of(tape7 *t, int k)
{
    double **const list[TAPE7_WANTED] = {&t->wavenumber_cm1, &t->transmission, &t->emitted,
                                         &t->scattered, &t->solar};

    return list[k];
}

static status add_row(tape7 *t, const tape7_head *h, const double row[TAPE7_WANTED],
                      const record_file *file)
{
    status rc = STATUS_OK;
    const double per_um = PER_CM2 * (h->has_wavelengths ? 1.0 : row[0] * row[0] / PER_CM1_UM);

    for (int k = 0; k < TAPE7_WANTED; k++) {
        double **to = list_of(t, k);
        if (h->column[k] < 0) continue;
        if (t->count > 0 && isnan(row[k]) != isnan((*to)[t->count - 1]))
            return record_file_reject(file, "a number below %s in all rows or in none",
                                      tape7_column_name((tape7_column)k));
        NEED(array_add(to, (size_t)t->count, sizeof **to), STATUS_MEMORY, "no memory for a tape7");
        (*to)[t->count] = row[k] * (k < TAPE7_EMITTED ? 1.0 : per_um);
    }
    t->count++;
out:
    return rc;
}

/* Even to a thousandth of the step, or as they are printed. */
static bool is_even(const tape7 *t)
{
    const double *x = t->wavenumber_cm1;
    const int n = t->count;

    if (n < 2 || !isfinite(x[0]) || x[n - 1] <= x[0]) return false;
    const double step = (x[n - 1] - x[0]) / (n - 1);
    for (int i = 1; i < n; i++)
        if (!(fabs(x[i] - x[0] - i * step) <= fmax(1e-3 * step, PRINTED))) return false;
    return true;
}

/* Puts rows that are even in wavelength onto wavenumbers that are: as far apart as the rows are where they are
 * closest, values linear in wavelength between rows. */
static status turn_to_wavenumbers(tape7 *t)
{
    status rc = STATUS_OK;
    const int rows = t->count;
    double *const um = t->wavenumber_cm1, *nu = NULL, *value = NULL;
    const double first = um[0], last = um[rows - 1], step_um = (last - first) / (rows - 1);
    const int n = 1 + (int)ceil((rows - 1) * last / first - PRINTED);
    const double low = 1e4 / last, step = (1e4 / first - low) / (n - 1);

    NEED(nu = malloc((size_t)n * sizeof *nu), STATUS_MEMORY, "no memory for a tape7");
    for (int i = 0; i < n; i++) nu[i] = low + i * step;
    for (int k = TAPE7_TRANSMISSION; k < TAPE7_WANTED; k++) {
        double **list = list_of(t, k);
        if (!*list) continue;
        NEED(value = malloc((size_t)n * sizeof *value), STATUS_MEMORY, "no memory for a tape7");
        for (int i = 0; i < n; i++) {
            const double at = fmin(fmax((1e4 / nu[i] - first) / step_um, 0.0), rows - 1.0);
            const int row = (int)fmin(at, rows - 2.0);
            value[i] = (*list)[row] + (at - row) * ((*list)[row + 1] - (*list)[row]);
        }
        free(*list);
        *list = value;
    }
    free(um);
    t->wavenumber_cm1 = nu;
    t->count = n;
    nu = NULL;
out:
    free(nu);
    return rc;
}

/* What the run did not compute is blank: light of the sun, or heat. */
static status fill_blank(tape7 *t, const record_file *file)
{
    for (int k = 0; k < TAPE7_WANTED; k++) {
        double *list = *list_of(t, k);
        if (!list || !isnan(list[0])) continue;
        if (k != TAPE7_EMITTED && k != TAPE7_SCATTERED)
            return record_file_reject(file, "numbers below %s", tape7_column_name((tape7_column)k));
        memset(list, 0, (size_t)t->count * sizeof *list);
        t->is_emitted_blank |= k == TAPE7_EMITTED;
        t->is_scattered_blank |= k == TAPE7_SCATTERED;
    }
    return STATUS_OK;
}

static status read_rows(tape7 *t, tape7_head *h, record_file *file, const char *path)
{
    status rc = STATUS_OK;
    const char *text;
    double row[TAPE7_WANTED], first;
    bool ends = false;

    while (!ends && !record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a row of the table"));
        ends = is_last_mark(text);
        if (ends) break;
        if (tape7_head_row(h, text, (int)record_file_column(file), row)) {
            TRY(add_row(t, h, row, file));
            continue;
        }
        if (t->count == 0 &&
            (tape7_head_add(h, text, (int)record_file_column(file)) || !number_take(text, &first)))
            continue; /* units */
        rc = record_file_reject(file, "%d columns of numbers, or -9999. at the end", h->count);
        goto out;
    }
    if (t->count > 0) TRY(fill_blank(t, file));
    if (!is_even(t))
        TRY(record_file_reject(file, "%s that rise evenly",
                               h->has_wavelengths ? "wavelengths" : "wavenumbers"));
    if (h->has_wavelengths) {
        if (t->wavenumber_cm1[0] < LEAST_UM || t->wavenumber_cm1[t->count - 1] > MOST_UM)
            TRY(record_file_reject(file, "wavelengths from %g to %g um", LEAST_UM, MOST_UM));
        TRY(turn_to_wavenumbers(t));
    }
    if (!ends)
        status_warn("%s: does not end with -9999. as MODTRAN's files do: is it whole?", path);
out:
    return rc;
}

/* Steps to the head of the next run; *out_found is false at the end. */
static status find_head(tape7_head *out, bool *out_found, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;

    *out_found = false;
    while (!*out_found && !record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a head that starts with FREQ"));
        *out_found = tape7_head_read(out, text, (int)record_file_column(file));
    }
out:
    return rc;
}

/* Passes over the rows of a run. */
static status pass_rows(run_range *out, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    double first;

    *out = (run_range){.head_line = record_file_line(file)};
    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a row of the table"));
        if (is_last_mark(text)) break;
        if (!number_take(text, &first)) continue;
        if (out->rows++ == 0) out->first_cm1 = first;
        out->last_cm1 = first;
    }
out:
    return rc;
}

/* The runs of a file in words; *out_count is their number. */
static status list_runs(char out[LIST_SIZE], int *out_count, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    tape7_head h;
    run_range range;
    bool found = true;
    size_t used = 0;

    *out_count = 0;
    out[0] = '\0';
    TRY(record_file_open(&file, path));
    for (;;) {
        TRY(find_head(&h, &found, file));
        if (!found) break;
        TRY(pass_rows(&range, file));
        ++*out_count;
        if (used + 100 < LIST_SIZE)
            used += (size_t)snprintf(out + used, LIST_SIZE - used,
                                     "%s%d (line %d, %d rows from %g to %g)",
                                     *out_count > 1 ? ", " : "", *out_count, range.head_line,
                                     range.rows, range.first_cm1, range.last_cm1);
    }
out:
    record_file_free(file);
    return rc;
}

/* Fails unless the file has the run that is asked for. */
static status check_run(const char *path, int run)
{
    status rc = STATUS_OK;
    char list[LIST_SIZE];
    int count;

    TRY(list_runs(list, &count, path));
    NEED(count > 0, STATUS_FORMAT, "%s: expected a head that starts with FREQ: MODTRAN's tape7",
         path);
    NEED(run > 0 || count == 1, STATUS_FORMAT,
         "%s: holds %d runs, expected one, or its number behind the name, as in \"%s#2\": %s", path,
         count, strrchr(path, '/') ? strrchr(path, '/') + 1 : path, list);
    NEED(run <= count, STATUS_FORMAT, "%s: has no run %d: %s", path, run, list);
out:
    return rc;
}

status tape7_read(tape7 **out, const char *path, int run)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    tape7_head h;
    run_range passed;
    bool found;
    tape7 *t = calloc(1, sizeof *t);

    NEED(t, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(check_run(path, run));
    TRY(record_file_open(&file, path));
    TRY(find_head(&h, &found, file));
    for (int i = 1; i < run; i++) {
        TRY(pass_rows(&passed, file));
        TRY(find_head(&h, &found, file));
    }
    if (h.has_wavelengths && strcmp(h.name[0], "WAVLENMCRN"))
        TRY(record_file_reject(file,
                               "a spectrum by wavenumber or by wavelength in um, WAVLEN MCRN, "
                               "whose radiances are per um: FLAGS(1) = W or M"));
    TRY(read_rows(t, &h, file, path));
    *out = t;
    t = NULL;
out:
    record_file_free(file);
    tape7_free(t);
    return rc;
}

void tape7_free(tape7 *t)
{
    if (!t) return;
    free(t->wavenumber_cm1);
    free(t->transmission);
    free(t->emitted);
    free(t->scattered);
    free(t->solar);
    free(t);
}
