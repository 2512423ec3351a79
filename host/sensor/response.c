#include "sensor/response.h"

#include "base/number.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "files/record_file.h"
#include "files/wavelength_column.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

static const double LEAST_UM = 0.2, MOST_UM = 50.0;

#define NOISE_SHARE .05 /* of the peak, below 0 */

/* A Gaussian's points: every 1/128 of its width, 2 widths to both sides. */
enum { GAUSSIAN_PER_WIDTH = 128, GAUSSIAN_WIDTHS = 2, POINT_LIMIT = 1 << 16, HEADING_SIZE = 64 };

static status allocate(response **out, int limit)
{
    status rc = STATUS_OK;
    response *r = calloc(1, sizeof *r);

    NEED(r, STATUS_MEMORY, "no memory for a response");
    r->wavelength_um = calloc((size_t)limit, sizeof(double));
    r->value = calloc((size_t)limit, sizeof(double));
    NEED(r->wavelength_um && r->value, STATUS_MEMORY, "no memory for a response");
    *out = r;
    r = NULL;
out:
    response_free(r);
    return rc;
}

void response_free(response *r)
{
    if (!r) return;
    free(r->wavelength_um);
    free(r->value);
    free(r);
}

static const char response_names[] =
    "|response|relative response|spectral response|rsr|srf|transmission|transmittance|";

typedef struct reader {
    record_file *file;
    csv_row row;
    char separator;
    const unit *of;
    double lowest; /* response, and where it stands */
    int lowest_line;
} reader;

static status read_unit(reader *in)
{
    static const char expected[] =
        "wavelength_um,response or wavelength_nm,response or wavenumber_cm1,response";
    status rc = STATUS_OK;
    char name[HEADING_SIZE] = "", unit_text[HEADING_SIZE];

    TRY(csv_row_names(&in->row, in->file, &in->separator, expected));
    in->of = wavelength_column_unit(csv_row_field(&in->row, 0));
    heading_split(csv_row_field(&in->row, 1), HEADING_SIZE, name, unit_text);
    if (!in->of || in->row.count != 2 || !heading_is_named(name, response_names))
        rc = record_file_reject(in->file, "%s", expected);
out:
    return rc;
}

/* Which way the wavelengths of the first points run: 1, -1, or 0 while they are the same. */
static int direction(const response *r, int count)
{
    const double *const l = r->wavelength_um;

    return count < 2 ? 0 : (l[count - 1] > l[0]) - (l[count - 1] < l[0]);
}

/* Of a third point at one wavelength the middle one goes. */
static void join_steps(response *r)
{
    const int n = r->count;
    const double *const l = r->wavelength_um;

    if (n < 3 || l[n - 1] != l[n - 2] || l[n - 2] != l[n - 3]) return;
    r->value[n - 2] = r->value[n - 1];
    r->count--;
}

static status read_point(response *r, reader *in)
{
    status rc = STATUS_OK;
    const int n = r->count, before = direction(r, n);
    static const char expected[] = "a wavelength and a response";
    double *const l = r->wavelength_um;
    double pair[2];

    TRY(csv_row_take(&in->row, in->file, in->separator, expected));
    if (in->row.count != 2 || !number_read(in->row.field[0], &pair[0]) ||
        !number_read(in->row.field[1], &pair[1]))
        TRY(record_file_reject(in->file, "%s", expected));
    l[n] = wavelength_column_um(in->of, pair[0]);
    r->value[n] = pair[1];
    if (pair[1] < in->lowest) {
        in->lowest = pair[1];
        in->lowest_line = record_file_line(in->file);
    }
    if (!(l[n] >= LEAST_UM && l[n] <= MOST_UM))
        rc = record_file_reject(in->file, "a wavelength of 0.2 to 50 um");
    else if (n > 0 && before != 0 && (l[n] - l[n - 1]) * before < 0.0)
        rc = record_file_reject(in->file, "wavelengths that only rise or only fall");
    r->count++;
    join_steps(r);
out:
    return rc;
}

/* A detector's noise goes below 0 where the filter is shut. */
static status clear_noise(response *r, const reader *in, double peak, const char *path)
{
    if (in->lowest < -NOISE_SHARE * peak)
        return status_set(STATUS_FORMAT,
                          "%s:%d: found a response of %g, expected 0 or more, but for noise", path,
                          in->lowest_line, in->lowest);
    if (in->lowest < 0.0)
        status_warn("%s: responses below 0, down to %g of a peak of %g, are taken as 0", path,
                    in->lowest, peak);
    for (int i = 0; i < r->count; i++) r->value[i] = fmax(r->value[i], 0.0) / peak;
    return STATUS_OK;
}

static void turn_round(double *values, int count)
{
    for (int i = 0, k = count - 1; i < k; i++, k--) {
        const double kept = values[i];
        values[i] = values[k];
        values[k] = kept;
    }
}

static status read_points(response *r, reader *in, const char *path)
{
    status rc = STATUS_OK;
    double peak = 0.0;
    record_file *const file = in->file;

    while (r->count < 2 || !record_file_at_end(file)) {
        if (r->count == POINT_LIMIT) {
            rc = record_file_reject(file, "at most %d points", POINT_LIMIT);
            goto out;
        }
        TRY(read_point(r, in));
        peak = fmax(peak, r->value[r->count - 1]);
    }
    if (!(peak > 0.0)) {
        rc = record_file_reject(file, "a response above 0 in one of the lines");
        goto out;
    }
    if (direction(r, r->count) == 0) {
        rc = record_file_reject(file, "wavelengths that only rise or only fall");
        goto out;
    }
    TRY(clear_noise(r, in, peak, path));
    if (direction(r, r->count) > 0) goto out;
    turn_round(r->wavelength_um, r->count);
    turn_round(r->value, r->count);
out:
    return rc;
}

status response_read(response **out, const char *path)
{
    status rc = STATUS_OK;
    reader in = {0};
    response *r = NULL;

    TRY(record_file_open(&in.file, path));
    TRY(allocate(&r, POINT_LIMIT));
    TRY(read_unit(&in));
    TRY(read_points(r, &in, path));
    *out = r;
    r = NULL;
out:
    response_free(r);
    csv_row_free(&in.row);
    record_file_free(in.file);
    return rc;
}

status response_gaussian(response **out, double centre_um, double fwhm_um)
{
    status rc = STATUS_OK;
    const int half = GAUSSIAN_WIDTHS * GAUSSIAN_PER_WIDTH;
    response *r = NULL;

    TRY(allocate(&r, 2 * half + 1));
    for (int i = -half; i <= half; i++, r->count++) {
        const double widths = (double)i / GAUSSIAN_PER_WIDTH;
        r->wavelength_um[r->count] = centre_um + widths * fwhm_um;
        r->value[r->count] = exp(-4.0 * M_LN2 * widths * widths);
    }
    *out = r;
out:
    return rc;
}

/* First of the two points that a wavelength lies between; 0 before them all, count - 2 behind. */
static int piece_at(const response *r, double wavelength_um)
{
    int low = 0, high = r->count - 1;

    while (high - low > 1) {
        const int middle = (low + high) / 2;
        if (r->wavelength_um[middle] <= wavelength_um)
            low = middle;
        else
            high = middle;
    }
    return low;
}

static double on_piece(const response *r, int piece, double wavelength_um)
{
    const double *l = r->wavelength_um + piece, *v = r->value + piece;

    if (l[1] == l[0]) return v[1];
    return v[0] + (wavelength_um - l[0]) / (l[1] - l[0]) * (v[1] - v[0]);
}

double response_at(const response *r, double wavelength_um)
{
    if (wavelength_um < r->wavelength_um[0] || wavelength_um > r->wavelength_um[r->count - 1])
        return 0.0;
    return on_piece(r, piece_at(r, wavelength_um), wavelength_um);
}

/* Simpson's rule is exact here: a product of two straight lines on every piece. */
double response_integral(const response *r, double from_um, double to_um)
{
    const double low = fmax(fmin(from_um, to_um), r->wavelength_um[0]);
    const double high = fmin(fmax(from_um, to_um), r->wavelength_um[r->count - 1]);
    double sum = 0.0;

    for (int i = piece_at(r, low); i + 1 < r->count && r->wavelength_um[i] < high; i++) {
        const double a = fmax(low, r->wavelength_um[i]), c = fmin(high, r->wavelength_um[i + 1]);
        const double b = 0.5 * (a + c), scale = (c - a) / (6.0 * (to_um - from_um));
        if (!(c > a)) continue;
        sum += scale * (on_piece(r, i, a) * (to_um - a) + 4.0 * on_piece(r, i, b) * (to_um - b) +
                        on_piece(r, i, c) * (to_um - c));
    }
    return sum;
}
