#include "sensor/psf.h"

#include "base/interrupt.h"
#include "files/record_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

/* Beyond this many standard deviations a Gaussian has 6e-5 of its energy. */
static const double GAUSSIAN_REACH = 4.0;
static const double AIRY_REACH = 10.0;

static status allocate(psf **out, int columns, int rows, int first_column, int first_row)
{
    status rc = STATUS_OK;
    psf *p = calloc(1, sizeof *p);

    NEED(p, STATUS_MEMORY, "no memory for a point spread function");
    *p = (psf){columns, rows, first_column, first_row,
               calloc((size_t)columns * (size_t)rows, sizeof(double))};
    NEED(p->weight, STATUS_MEMORY, "no memory for a point spread function");
    *out = p;
    p = NULL;
out:
    psf_free(p);
    return rc;
}

void psf_free(psf *p)
{
    if (!p) return;
    free(p->weight);
    free(p);
}

status psf_copy(psf **out, const psf *p)
{
    status rc = STATUS_OK;

    TRY(allocate(out, p->columns, p->rows, p->first_column, p->first_row));
    memcpy((*out)->weight, p->weight, (size_t)p->columns * (size_t)p->rows * sizeof *p->weight);
out:
    return rc;
}

static double *weight_at(const psf *p, int column, int row)
{
    return p->weight + (size_t)(row - p->first_row) * (size_t)p->columns +
           (column - p->first_column);
}

/* A spread that reaches so far to every side. */
static status allocate_around(psf **out, double reach)
{
    const int half = (int)fmin(PSF_REACH, ceil(reach));

    return allocate(out, 2 * half + 1, 2 * half + 1, -half, -half);
}

static void normalise(psf *p)
{
    const size_t count = (size_t)p->columns * (size_t)p->rows;
    double sum = 0.0;

    for (size_t i = 0; i < count; i++) sum += p->weight[i];
    for (size_t i = 0; i < count; i++) p->weight[i] /= sum;
}

status psf_detector(psf **out, int step)
{
    status rc = STATUS_OK;

    TRY(allocate(out, step, step, 0, 0));
    for (int i = 0; i < step * step; i++) (*out)->weight[i] = 1.0 / (step * step);
out:
    return rc;
}

status psf_add(psf *p, const psf *spread)
{
    status rc = STATUS_OK;
    psf *sum = NULL;

    TRY(allocate(&sum, p->columns + spread->columns - 1, p->rows + spread->rows - 1,
                 p->first_column + spread->first_column, p->first_row + spread->first_row));
    for (int i = 0; i < p->rows * p->columns; i++) {
        TRY(interrupt_check());
        if (p->weight[i] == 0.0) continue;
        for (int row = 0; row < spread->rows; row++)
            for (int column = 0; column < spread->columns; column++)
                sum->weight[(i / p->columns + row) * sum->columns + i % p->columns + column] +=
                    p->weight[i] * spread->weight[row * spread->columns + column];
    }
    free(p->weight);
    *p = *sum;
    sum->weight = NULL;
out:
    psf_free(sum);
    return rc;
}

/* Adds a spread whose weight is the product of two columns of weights. */
static status add_separable(psf *p, double reach,
                            double (*fraction)(double low, double high, double), double size)
{
    status rc = STATUS_OK;
    psf *spread = NULL;

    TRY(allocate_around(&spread, reach));
    const int half = spread->columns / 2;
    for (int row = -half; row <= half; row++)
        for (int column = -half; column <= half; column++)
            *weight_at(spread, column, row) =
                fraction(column - .5, column + .5, size) * fraction(row - .5, row + .5, size);
    normalise(spread);
    TRY(psf_add(p, spread));
out:
    psf_free(spread);
    return rc;
}

static double gaussian_fraction(double low, double high, double sigma)
{
    return 0.5 * (erf(high / sigma * M_SQRT1_2) - erf(low / sigma * M_SQRT1_2));
}

status psf_add_gaussian(psf *p, double fwhm)
{
    const double sigma = fwhm / sqrt(8.0 * M_LN2);

    return add_separable(p, GAUSSIAN_REACH * sigma, gaussian_fraction, sigma);
}

static double box_fraction(double low, double high, double width)
{
    return fmax(0.0, fmin(high, 0.5 * width) - fmax(low, -0.5 * width)) / width;
}

status psf_add_box(psf *p, double width)
{
    return add_separable(p, fmax(0.0, 0.5 * width - 0.5), box_fraction, width);
}

/* Cuts the part of a line out that runs in a strip of width 1: at = slope x place. */
static void cut_strip(double slope, int strip, double *low, double *high)
{
    const double one = (strip - .5) / slope, other = (strip + .5) / slope;

    if (fabs(slope) < 1e-12) {
        if (strip != 0) *high = *low;
        return;
    }
    *low = fmax(*low, fmin(one, other));
    *high = fmin(*high, fmax(one, other));
}

status psf_add_motion(psf *p, double length, double angle_deg)
{
    status rc = STATUS_OK;
    const double across = cos(angle_deg * M_PI / 180.0), down = -sin(angle_deg * M_PI / 180.0);
    psf *spread = NULL;

    TRY(allocate_around(&spread, 0.5 * length));
    const int half = spread->columns / 2;
    for (int row = -half; row <= half; row++)
        for (int column = -half; column <= half; column++) {
            double low = -0.5 * length, high = 0.5 * length;
            cut_strip(across, column, &low, &high);
            cut_strip(down, row, &low, &high);
            *weight_at(spread, column, row) = fmax(0.0, high - low);
        }
    normalise(spread);
    TRY(psf_add(p, spread));
out:
    psf_free(spread);
    return rc;
}

/* (2 J1(v) / v)^2 with v = pi r / scale. */
static double airy_at(double x, double y, double scale)
{
    const double v = M_PI * hypot(x, y) / scale;
    const double amplitude = v < 1e-6 ? 1.0 : 2.0 * j1(v) / v;

    return amplitude * amplitude;
}

/* Mean over a pixel, by the midpoint rule. */
static double airy_fraction(int column, int row, int steps, double scale)
{
    double sum = 0.0;

    for (int k = 0; k < steps; k++)
        for (int i = 0; i < steps; i++)
            sum += airy_at(column - .5 + (i + .5) / steps, row - .5 + (k + .5) / steps, scale);
    return sum / (steps * steps);
}

status psf_add_airy(psf *p, double scale)
{
    status rc = STATUS_OK;
    const int steps = (int)fmax(8.0, fmin(256.0, ceil(8.0 / scale)));
    psf *spread = NULL;

    TRY(allocate_around(&spread, AIRY_REACH * scale));
    const int half = spread->columns / 2;
    for (int row = 0; row <= half; row++)
        for (int column = 0; column <= half; column++) {
            const double fraction = airy_fraction(column, row, steps, scale);
            *weight_at(spread, column, row) = *weight_at(spread, -column, row) = fraction;
            *weight_at(spread, column, -row) = *weight_at(spread, -column, -row) = fraction;
        }
    normalise(spread);
    TRY(psf_add(p, spread));
out:
    psf_free(spread);
    return rc;
}

enum { TABLE_SIZE = 2 * PSF_REACH + 1 };

/* Reads the next line of a table; the first tells how many columns there are. */
static status read_line(double *out, int *columns, record_file *file)
{
    static const char expected[] = "an odd number of weights up to 129";
    status rc = STATUS_OK;
    const char *text;

    TRY(record_file_text(file, &text, expected));
    const int found = record_numbers(text, TABLE_SIZE, out);
    if (found < 1 || found > TABLE_SIZE || found % 2 == 0)
        rc = record_file_reject(file, "%s", expected);
    else if (*columns && found != *columns)
        rc = record_file_reject(file, "%d weights as in the lines above", *columns);
    for (int i = 0; i < found && rc == STATUS_OK; i++)
        if (out[i] < 0.0) rc = record_file_reject(file, "weights of 0 or more");
    *columns = found;
out:
    return rc;
}

/* What a point sends down and to the right, a detector gets from above and from the left. */
static status set_table(psf **out, const double *value, int columns, int rows)
{
    status rc = STATUS_OK;
    const int count = columns * rows;

    TRY(allocate(out, columns, rows, -(columns / 2), -(rows / 2)));
    for (int i = 0; i < count; i++) (*out)->weight[count - 1 - i] = value[i];
    normalise(*out);
out:
    return rc;
}

status psf_read(psf **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    double *value = calloc((size_t)TABLE_SIZE * (TABLE_SIZE + 1), sizeof *value);
    double sum = 0.0;
    int columns = 0, rows = 0;

    NEED(value, STATUS_MEMORY, "%s: no memory to read it", path);
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, NULL));
    do TRY(read_line(value + (size_t)rows * (size_t)columns, &columns, file));
    while (++rows < TABLE_SIZE && !record_file_at_end(file));
    TRY(record_file_finish(file));
    for (int i = 0; i < rows * columns; i++) sum += value[i];
    if (rows % 2 == 0 || !(sum > 0.0)) {
        rc = record_file_reject(file, "the last of an odd number of lines, some weight above 0");
        goto out;
    }
    TRY(set_table(out, value, columns, rows));
out:
    record_file_free(file);
    free(value);
    return rc;
}
