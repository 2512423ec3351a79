#include "tape7.h"

#include "files/record_file.h"

#include <ctype.h>
#include <math.h>
#include <stdbool.h>
#include <stdlib.h>
#include <string.h>

#define PER_CM2 1e4    /* W cm-2 to W m-2 */
#define PER_CM1_UM 1e4 /* per cm-1 to per um: nu^2 / 1e4 */
#define LAST_MARK -9999.0

enum { NAME_SIZE = 32, COLUMN_LIMIT = 40, WANTED = 5 };

typedef struct head {
    int count;          /* columns of a row */
    int column[WANTED]; /* of what is wanted; -1: none */
} head;

/* Names as they stand in heads, blanks and underscores left out. */
static const char *const wanted[WANTED][2] = {{"FREQ", "FREQ"},
                                              {"TOTTRANS", "TRANS"},
                                              {"PTHTHRML", "PATHTHERMAL"},
                                              {"SOLSCAT", "SOLSCATT"},
                                              {"SOLAR", "SOLIRRAD"}};

/* Words of a head of which two make one name. */
static bool joins(const char *first, const char *second)
{
    static const char *const pairs[][2] = {
        {"TOT", "TRANS"}, {"PTH", "THRML"}, {"THRML", "SCT"}, {"SURF", "EMIS"}, {"SOL", "SCAT"},
        {"SING", "SCAT"}, {"GRND", "RFLT"}, {"DRCT", "RFLT"}, {"TOTAL", "RAD"}, {"REF", "SOL"},
        {"DIR", "EM"},    {"SOL", "TR"},    {"DIR", "EMIS"}};

    for (size_t i = 0; i < sizeof pairs / sizeof *pairs; i++)
        if (!strcmp(first, pairs[i][0]) && !strcmp(second, pairs[i][1])) return true;
    return false;
}

/* Splits a head into upper-case words without underscores. */
static int split(const char *text, char words[COLUMN_LIMIT][NAME_SIZE])
{
    int count = 0;

    while (count < COLUMN_LIMIT) {
        size_t length = 0;
        text += strspn(text, " \t");
        if (!*text) break;
        for (; *text && *text != ' ' && *text != '\t'; text++)
            if (*text != '_' && length + 1 < NAME_SIZE)
                words[count][length++] = (char)toupper((unsigned char)*text);
        words[count++][length] = '\0';
    }
    return count;
}

/* False where the line is no head. */
static bool read_head(head *out, const char *text)
{
    char words[COLUMN_LIMIT][NAME_SIZE], name[2 * NAME_SIZE];
    const int count = split(text, words);

    if (count < 2 || strcmp(words[0], "FREQ") != 0) return false;
    out->count = 0;
    for (int k = 0; k < WANTED; k++) out->column[k] = -1;
    for (int i = 0; i < count; i++) {
        strcpy(name, words[i]);
        if (i + 1 < count && joins(words[i], words[i + 1])) strcat(name, words[++i]);
        for (int k = 0; k < WANTED; k++)
            if (!strcmp(name, wanted[k][0]) || !strcmp(name, wanted[k][1]))
                out->column[k] = out->count;
        out->count++;
    }
    return true;
}

static status add_row(tape7 *t, const head *h, const double *row)
{
    double **const to[WANTED] = {&t->wavenumber_cm1, &t->transmission, &t->emitted, &t->scattered,
                                 &t->solar};
    const double per_um = row[0] * row[0] / PER_CM1_UM * PER_CM2;

    for (int k = 0; k < WANTED; k++) {
        if (h->column[k] < 0) continue;
        double *larger = realloc(*to[k], ((size_t)t->count + 1) * sizeof *larger);
        if (!larger) return status_set(STATUS_MEMORY, "no memory for a tape7");
        *to[k] = larger;
        larger[t->count] = row[h->column[k]] * (k < 2 ? 1.0 : per_um);
    }
    t->count++;
    return STATUS_OK;
}

/* Even to a thousandth of the step. */
static bool is_even(const tape7 *t)
{
    const double *nu = t->wavenumber_cm1;

    for (int i = 1; i < t->count; i++)
        if (fabs(nu[i] - nu[0] - i * (nu[1] - nu[0])) > 1e-3 * (nu[1] - nu[0]) || nu[1] <= nu[0])
            return false;
    return t->count >= 2;
}

static status read_rows(tape7 *t, const head *h, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    double row[COLUMN_LIMIT];

    while (!record_file_at_end(file)) {
        TRY(record_file_text(file, &text, "a row of the table"));
        const int found = record_numbers(text, COLUMN_LIMIT, row);
        if (found >= 1 && row[0] == LAST_MARK) break;
        if (found == h->count) {
            TRY(add_row(t, h, row));
            continue;
        }
        if (t->count == 0 && found < 0) continue; /* a line of units */
        rc = record_file_reject(file, "%d columns of numbers, or -9999. at the end", h->count);
        goto out;
    }
    if (!is_even(t)) rc = record_file_reject(file, "wavenumbers that rise evenly");
out:
    return rc;
}

status tape7_read(tape7 **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    const char *text;
    head h;
    tape7 *t = calloc(1, sizeof *t);

    NEED(t, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(record_file_open(&file, path));
    do {
        TRY(record_file_text(file, &text, "a head that starts with FREQ: MODTRAN's tape7"));
    } while (!read_head(&h, text));
    TRY(read_rows(t, &h, file));
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
