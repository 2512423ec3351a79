#include "range_error.h"

#include "sky/planck.h"

#include <math.h>

#define WARMER_K 20.0
#define LEAST_DEPTH 1e-9
#define STRONG_LINES 0.5 /* curve of growth */

static const struct {
    double low_um, high_um;
} windows[] = {{3.0, 5.2}, {7.0, 14.3}};

static double depth_at(const atmosphere *a, int step, int point)
{
    const double tau = a->range_tau[(size_t)step * (size_t)a->point_count + (size_t)point];

    return -log(fmax(tau, 1e-30));
}

/* The power of range by which a depth grows to a step. */
static double power_at(const atmosphere *a, int step, int point)
{
    const int high = step > 0 ? step : 1;

    if (a->range_count < 2) return STRONG_LINES;
    const double ratio = fmax(depth_at(a, high, point), LEAST_DEPTH) /
                         fmax(depth_at(a, high - 1, point), LEAST_DEPTH);
    return log(ratio) / log(a->range_m[high] / a->range_m[high - 1]);
}

/* Of a window, at a fraction of the way to a step from the one before. */
static double error_at(const atmosphere *a, int window, int step, double fraction)
{
    const double air_k = a->level_temperature_k[0];
    const double high_m = a->range_m[step], low_m = step ? a->range_m[step - 1] : 0.0;
    double difference = 0.0, sum = 0.0, width = 0.0;

    for (int i = 0; i < a->point_count; i++) {
        const double um = a->wavelength_um[i], step_um = um * um * a->wavenumber_step_cm1 / 1e4;
        if (um < windows[window].low_um || um > windows[window].high_um) continue;
        const planck_terms planck = planck_at(um, false);
        const double air = planck_spectral(planck, air_k);
        const double more = planck_spectral(planck, air_k + WARMER_K) - air;
        const double low = step ? depth_at(a, step - 1, i) : 0.0, high = depth_at(a, step, i);
        const double range_m = low_m + fraction * (high_m - low_m);
        const double right = exp(-high * pow(range_m / high_m, power_at(a, step, i)));
        const double taken = exp(-(low + fraction * (high - low)));
        difference += step_um * more * (taken - right);
        sum += step_um * (air + more * right);
        width += step_um;
    }
    const double whole = windows[window].high_um - windows[window].low_um;
    return width > 0.5 * whole ? fabs(difference / sum) : 0.0;
}

double range_error_most(const atmosphere *a, double *out_from_m, double *out_to_m)
{
    double most = 0.0;

    *out_from_m = *out_to_m = 0.0;
    for (int step = 0; step < a->range_count; step++)
        for (int window = 0; window < 2; window++)
            for (double fraction = 0.125; fraction < 1.0; fraction += 0.125) {
                const double error = error_at(a, window, step, fraction);
                if (error <= most) continue;
                most = error;
                *out_from_m = step ? a->range_m[step - 1] : 0.0;
                *out_to_m = a->range_m[step];
            }
    return most;
}
