#include "weather/clear_sky.h"

#include "kernels/constants.h"

#include <math.h>

/* What Bird's model takes for granted: ozone 0.3 cm, asymmetry 0.85, ground albedo 0.2 (the report's
 * clear mid-latitude case). */
#define OZONE_CM 0.3
#define ASYMMETRY 0.85
#define ALBEDO 0.2

typedef struct clear_sky_terms {
    double mass; /* relative air mass, Kasten 1966 */
    double ozone, gases, water, rayleigh, aerosol, aerosol_absorption; /* transmissions */
} clear_sky_terms;

static clear_sky_terms clear_sky_transmissions(const clear_sky_air *air, double zenith_rad)
{
    const double zenith_deg = zenith_rad * 180.0 / M_PI;
    const double mass = 1.0 / (cos(zenith_rad) + 0.15 * pow(93.885 - zenith_deg, -1.253));
    const double pressed = mass * air->pressure_pa / 101325.0;
    const double o = OZONE_CM * mass, w = air->water_cm * mass, a = air->aerosol;
    const double aerosol = exp(-pow(a, 0.873) * (1.0 + a - pow(a, 0.7088)) * pow(mass, 0.9108));

    return (clear_sky_terms){
        .mass = mass,
        .rayleigh = exp(-0.0903 * pow(pressed, 0.84) * (1.0 + pressed - pow(pressed, 1.01))),
        .ozone = 1.0 - 0.1611 * o * pow(1.0 + 139.48 * o, -0.3035) -
                 0.002715 * o / (1.0 + 0.044 * o + 0.0003 * o * o),
        .gases = exp(-0.0127 * pow(pressed, 0.26)),
        .water = 1.0 - 2.4959 * w / (pow(1.0 + 79.034 * w, 0.6828) + 6.385 * w),
        .aerosol = aerosol,
        .aerosol_absorption = 1.0 - 0.1 * (1.0 - mass + pow(mass, 1.06)) * (1.0 - aerosol),
    };
}

void clear_sky_irradiance(const clear_sky_air *air, double zenith_rad, double distance_au,
                          double *out_direct_w_m2, double *out_diffuse_w_m2)
{
    *out_direct_w_m2 = *out_diffuse_w_m2 = 0.0;
    if (zenith_rad >= 0.5 * M_PI) return;

    const clear_sky_terms t = clear_sky_transmissions(air, zenith_rad);
    const double extraterrestrial = (double)SOLAR_CONSTANT_W_M2 / (distance_au * distance_au);
    const double gases = t.ozone * t.gases * t.water;
    const double scattering = 1.0 - t.aerosol / t.aerosol_absorption;
    const double sky_albedo = 0.0685 + (1.0 - ASYMMETRY) * scattering;
    const double direct = 0.9662 * extraterrestrial * gases * t.aerosol * t.rayleigh;
    const double level = direct * cos(zenith_rad);
    const double scattered =
        0.79 * extraterrestrial * cos(zenith_rad) * gases * t.aerosol_absorption *
        (0.5 * (1.0 - t.rayleigh) + ASYMMETRY * scattering) / (1.0 - t.mass + pow(t.mass, 1.02));

    *out_direct_w_m2 = direct;
    *out_diffuse_w_m2 = (level + scattered) / (1.0 - ALBEDO * sky_albedo) - level;
}
