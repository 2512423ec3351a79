#include "sky_weight.h"

#include <math.h>

/* Antiderivatives of sin cos and of x sin cos. */
static double plain(double x)
{
    return -cos(2.0 * x) / 4.0;
}

static double linear(double x)
{
    return -x * cos(2.0 * x) / 4.0 + sin(2.0 * x) / 8.0;
}

void sky_weight(int count, bool thesis, double *out)
{
    const double step = M_PI / 2.0 / (count - 1);

    for (int i = 0; i < count; i++)
        out[i] = thesis ? 2.0 * cos(i * step) * sin(i * step) * step : 0.0;
    for (int i = 0; !thesis && i + 1 < count; i++) {
        const double low = i * step, high = (i + 1) * step;
        const double whole = plain(high) - plain(low);
        const double upper = (linear(high) - linear(low) - low * whole) / step;
        out[i] += 2.0 * (whole - upper);
        out[i + 1] += 2.0 * upper;
    }
}

double sky_weight_integrate(const double *radiance, int stride, int zenith_count, int azimuth_count,
                            const double *weight)
{
    const int azimuths = azimuth_count > 1 ? azimuth_count - 1 : 1;
    double sum = 0.0;

    for (int zenith = 0; zenith < zenith_count; zenith++) {
        double ring = 0.0;
        for (int azimuth = 0; azimuth < azimuths; azimuth++)
            ring += radiance[(long)(zenith * azimuth_count + azimuth) * stride];
        sum += weight[zenith] * ring / azimuths;
    }
    return sum;
}
