#include "material/emissivity_law.h"

#include <math.h>

static const double radian = 0.017453292519943295;

/* p + i q is the index times the cosine of the refracted ray. */
double emissivity_law_optical(double n, double k, double angle_deg)
{
    if (angle_deg >= 90.0) return 0.0;
    const double c = cos(angle_deg * radian), s = sin(angle_deg * radian);
    const double real = n * n - k * k - s * s, length = hypot(real, 2.0 * n * k);
    const double p = sqrt(0.5 * (length + real)), q2 = 0.5 * fmax(0.0, length - real);
    const double turned = s * s / c;
    const double across = ((c - p) * (c - p) + q2) / ((c + p) * (c + p) + q2);
    const double along = ((p - turned) * (p - turned) + q2) / ((p + turned) * (p + turned) + q2);

    return 1.0 - 0.5 * across * (1.0 + along);
}

double emissivity_law_fresnel(double normal, double angle_deg)
{
    const double r = sqrt(fmax(0.0, 1.0 - normal));

    if (r >= 1.0) return 0.0;
    return emissivity_law_optical((1.0 + r) / (1.0 - r), 0.0, angle_deg);
}

double emissivity_law_rough(double normal, double angle_deg)
{
    const double lost = 1.0 - cos(fmin(angle_deg, 90.0) * radian);

    return normal * (1.0 - 0.12 * lost * lost * lost * lost);
}

double emissivity_law_thesis(double normal, double angle_deg)
{
    if (angle_deg >= 90.0) return 0.0;
    return normal * cos(3.0 * fmax(angle_deg - 60.0, 0.0) * radian);
}
