#include "material/heat_weight.h"

#include "sky/planck.h"

#include <math.h>

/* Wavelengths up to which 0, 1 .. 100 percent of the global irradiance of ASTM G173-03 lie (tilted by 37 degrees,
 * air mass 1.5), um. */
static const double sun_um[] = {
    0.2800, 0.3421, 0.3617, 0.3771, 0.3917, 0.4034, 0.4120, 0.4203, 0.4285, 0.4372, 0.4446, 0.4514,
    0.4579, 0.4643, 0.4708, 0.4771, 0.4833, 0.4900, 0.4964, 0.5029, 0.5093, 0.5158, 0.5226, 0.5292,
    0.5357, 0.5422, 0.5487, 0.5552, 0.5618, 0.5685, 0.5752, 0.5819, 0.5885, 0.5955, 0.6024, 0.6091,
    0.6160, 0.6229, 0.6300, 0.6370, 0.6439, 0.6510, 0.6585, 0.6656, 0.6727, 0.6798, 0.6873, 0.6956,
    0.7033, 0.7110, 0.7193, 0.7286, 0.7372, 0.7453, 0.7534, 0.7653, 0.7745, 0.7830, 0.7918, 0.8010,
    0.8103, 0.8212, 0.8322, 0.8423, 0.8525, 0.8628, 0.8734, 0.8840, 0.8951, 0.9093, 0.9240, 0.9499,
    0.9717, 0.9870, 1.0004, 1.0143, 1.0286, 1.0433, 1.0587, 1.0749, 1.0919, 1.1131, 1.1633, 1.1867,
    1.2098, 1.2319, 1.2536, 1.2784, 1.3033, 1.3410, 1.5105, 1.5481, 1.5872, 1.6292, 1.6744, 1.7248,
    1.9313, 2.1040, 2.2248, 2.4014, 4.0000};

#define BODY_K 300.0

enum {
    SUN_RANGES = sizeof sun_um / sizeof *sun_um - 1,
    SUN_PARTS = 16,   /* of a range, of equal width */
    BODY_STEPS = 800, /* of equal ratio */
    ANGLES = 45       /* of a hemisphere, by equal steps of angle */
};

static const double BODY_FIRST_UM = 2.0, BODY_LAST_UM = 200.0;

static void add(heat_mean *mean, const emissivity *e, double um, double weight, double value)
{
    mean->value += weight * value;
    if (wavelength_grid_measures(&e->grid, um)) mean->measured_share += weight;
    if (isnan(e->outside) && !wavelength_grid_covers(&e->grid, um)) mean->missing_share += weight;
}

heat_mean heat_weight_sun(const emissivity *e)
{
    heat_mean mean = {0};

    for (int i = 0; i < SUN_RANGES * SUN_PARTS; i++) {
        const int range = i / SUN_PARTS;
        const double width = (sun_um[range + 1] - sun_um[range]) / SUN_PARTS;
        const double um = sun_um[range] + (i % SUN_PARTS + .5) * width;
        add(&mean, e, um, 1.0 / (SUN_RANGES * SUN_PARTS), emissivity_at(e, 1e4 / um, 0.0));
    }
    return mean;
}

/* The mean over a hemisphere, every direction by its cosine. */
static double hemispherical(const emissivity *e, double wavenumber_cm1)
{
    double sum = 0.0, weights = 0.0;

    if (e->law == EMISSIVITY_CONSTANT) return emissivity_at(e, wavenumber_cm1, 0.0);
    for (int i = 0; i < ANGLES; i++) {
        const double degrees = 90.0 * (i + .5) / ANGLES, weight = sin(degrees * M_PI / 90.0);
        sum += weight * emissivity_at(e, wavenumber_cm1, degrees);
        weights += weight;
    }
    return sum / weights;
}

heat_mean heat_weight_300k(const emissivity *e)
{
    const double ratio = pow(BODY_LAST_UM / BODY_FIRST_UM, 1.0 / BODY_STEPS);
    heat_mean mean = {0};
    double weights = 0.0;

    for (int i = 0; i < BODY_STEPS; i++) {
        const double um = BODY_FIRST_UM * pow(ratio, i + .5);
        const double weight = um * planck_spectral(planck_at(um, false), BODY_K);
        add(&mean, e, um, weight, hemispherical(e, 1e4 / um));
        weights += weight;
    }
    return (heat_mean){mean.value / weights, mean.measured_share / weights,
                       mean.missing_share / weights};
}
