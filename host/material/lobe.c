#include "material/lobe.h"

#include "kernels/radiance/lobe.h"
#include "material/emissivity.h"

#include <math.h>
#include <stddef.h>

static const double radian = 0.017453292519943295;

/* Adds the integral of sin(2 theta) over part of a degree, shared out by linear interpolation to the
 * angles before and behind it; Gauss, two points: 1e-10 of it. */
static void add_piece(double *weight, int degree, double low_deg, double high_deg)
{
    const double half = .5 * (high_deg - low_deg), middle = .5 * (high_deg + low_deg);

    for (int side = -1; side <= 1; side += 2) {
        const double theta = middle + side * half / sqrt(3.0);
        const double value = half * radian * sin(2.0 * theta * radian);
        weight[degree] += value * (degree + 1 - theta);
        weight[degree + 1] += value * (theta - degree);
    }
}

/* Weights of the angles in the mean over a ring; their sum is 1.
 *   low_deg, high_deg   its angles from the normal */
static void weigh_ring(double *weight, double low_deg, double high_deg)
{
    const double low = sin(low_deg * radian), high = sin(high_deg * radian);

    for (int a = 0; a < EMISSIVITY_ANGLES; a++) weight[a] = 0.0;
    for (int degree = 0; degree < EMISSIVITY_ANGLES - 1; degree++) {
        const double from = fmax(degree, low_deg), to = fmin(degree + 1, high_deg);
        if (from < to) add_piece(weight, degree, from, to);
    }
    for (int a = 0; a < EMISSIVITY_ANGLES; a++) weight[a] /= high * high - low * low;
}

static double mean_reflectance(const double *weight, const float *table, uint32_t sample_count,
                               uint32_t sample)
{
    double sum = 0.0;

    for (int a = 0; a < EMISSIVITY_ANGLES; a++)
        sum += weight[a] * (1.0 - (double)table[(size_t)a * sample_count + sample]);
    return sum;
}

void lobe_fill(const float *table, uint32_t sample_count, uint32_t ring_count, float *out)
{
    double weight[EMISSIVITY_ANGLES];

    weigh_ring(weight, 0.0, 90.0);
    for (uint32_t i = 0; i < sample_count; i++) {
        const double whole = mean_reflectance(weight, table, sample_count, i);
        out[i] = whole > 0.0 ? (float)(1.0 / whole) : 0.0f;
    }
    for (uint32_t r = 0; r < ring_count; r++) {
        const double high = acos(sqrt((double)r / ring_count)) / radian;
        const double low = acos(sqrt((r + 1.0) / ring_count)) / radian;
        float *row = out + (size_t)(r + LOBE_ROWS) * sample_count;
        weigh_ring(weight, low, high);
        for (uint32_t i = 0; i < sample_count; i++)
            row[i] = out[i] > 0.0f
                         ? (float)mean_reflectance(weight, table, sample_count, i) * out[i]
                         : 1.0f;
    }
}
