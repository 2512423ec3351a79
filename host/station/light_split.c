#include "station/light_split.h"

#include <math.h>

double light_split_diffuse_fraction(double clearness)
{
    const double k = fmax(0.0, clearness);

    if (k <= 0.22) return 1.0 - 0.09 * k;
    if (k > 0.8) return 0.165;
    return 0.9511 + k * (-0.1604 + k * (4.388 + k * (-16.638 + k * 12.336)));
}

/* What is level light and not diffuse, as a beam of at most the clear sky's. */
static double beam(const sun_span *sun, double level_w_m2)
{
    if (sun->direct_w_m2 <= 0.0 || level_w_m2 <= 0.0) return 0.0;
    return fmin(LIGHT_MOST_OF_CLEAR * sun->direct_w_m2, level_w_m2 / sun->cos_zenith);
}

bool light_split_complete(const sun_span *sun, double global_w_m2, double *direct_w_m2,
                          double *diffuse_w_m2)
{
    const double global = fmax(0.0, global_w_m2); /* 0 for not-a-number: asked below */

    if (isnan(global_w_m2) || (!isnan(*direct_w_m2) && !isnan(*diffuse_w_m2))) return false;
    if (!isnan(*direct_w_m2)) {
        *diffuse_w_m2 = fmax(0.0, global - fmax(0.0, *direct_w_m2) * sun->cos_zenith);
        return false;
    }
    if (!isnan(*diffuse_w_m2)) {
        *direct_w_m2 = beam(sun, global - *diffuse_w_m2);
        return false;
    }
    const double clearness = sun->beyond_w_m2 > 0.0 ? global / sun->beyond_w_m2 : 0.0;
    *direct_w_m2 = beam(sun, global * (1.0 - light_split_diffuse_fraction(clearness)));
    *diffuse_w_m2 = fmax(0.0, global - *direct_w_m2 * sun->cos_zenith);
    return global > 0.0;
}
