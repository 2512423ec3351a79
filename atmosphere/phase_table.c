#include "phase_table.h"

#include "files/record_file.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

enum { REGIONS = 4, ANGLES = 50, COLUMNS = 1 + REGIONS };

#define DEGREE (M_PI / 180.0)
#define SMALLEST_PER_SR 1e-9 /* LOWTRAN interpolates logarithms */
#define LARGEST_PER_SR 1e4

typedef struct phase_table {
    int count;
    double row[ANGLES][COLUMNS]; /* angle, phase functions */
} phase_table;

static status read_row(phase_table *t, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    double *row = t->row[t->count];
    const double above = t->count ? t->row[t->count - 1][0] : -1.0;

    TRY(record_file_text(file, &text, "an angle and phase functions"));
    const int found = record_numbers(text, COLUMNS, row);
    for (int i = 2; found == 2 && i < COLUMNS; i++) row[i] = row[1];
    bool fits = (found == 2 || found == COLUMNS) && row[0] > above && row[0] <= 180.0;
    fits = fits && (t->count || row[0] == 0.0);
    for (int i = 1; fits && i < COLUMNS; i++)
        fits = row[i] >= SMALLEST_PER_SR && row[i] <= LARGEST_PER_SR;
    if (!fits)
        rc = record_file_reject(file,
                                "a scattering angle that rises from 0 to 180 degrees and 1 or 4 "
                                "phase functions in sr-1");
out:
    return rc;
}

/* The integral over all directions, by the trapezoid rule in the cosine. */
static double integrate(const phase_table *t, int column)
{
    double sum = 0.0;

    for (int i = 1; i < t->count; i++)
        sum += M_PI * (t->row[i][column] + t->row[i - 1][column]) *
               (cos(t->row[i - 1][0] * DEGREE) - cos(t->row[i][0] * DEGREE));
    return sum;
}

static status read_rows(phase_table *t, record_file *file)
{
    status rc = STATUS_OK;

    while (!record_file_at_end(file)) {
        if (t->count == ANGLES) {
            rc = record_file_reject(file, "at most %d angles", ANGLES);
            goto out;
        }
        TRY(read_row(t, file));
        t->count++;
    }
    if (t->count < 2 || t->row[t->count - 1][0] != 180.0) {
        rc = record_file_reject(file, "180 degrees as the last of at least two angles");
        goto out;
    }
    for (int i = 1; i < COLUMNS; i++) {
        if (fabs(integrate(t, i) - 1.0) <= .05) continue;
        rc = record_file_reject(file,
                                "phase functions whose integral over the sphere is 1; number "
                                "%d has %.3f",
                                i, integrate(t, i));
        goto out;
    }
out:
    return rc;
}

static status print_cards(char **out, const phase_table *t)
{
    status rc = STATUS_OK;
    char *text = NULL;
    size_t length;
    FILE *stream = open_memstream(&text, &length);

    NEED(stream, STATUS_MEMORY, "no memory for phase functions");
    if (t->count) fprintf(stream, "%5d\n", t->count);
    for (int i = 0; i < t->count; i++)
        for (int k = 0; k < COLUMNS; k++)
            fprintf(stream, "%10.3E%s", t->row[i][k], k + 1 < COLUMNS ? "" : "\n");
    NEED(fclose(stream) == 0, STATUS_MEMORY, "no memory for phase functions");
    *out = text;
out:
    return rc;
}

status phase_table_cards(char **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    phase_table table = {0};

    if (path) {
        TRY(record_file_open(&file, path));
        TRY(record_file_header(file, NULL));
        TRY(read_rows(&table, file));
    }
    TRY(print_cards(out, &table));
out:
    record_file_free(file);
    return rc;
}
