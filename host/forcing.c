#include "forcing.h"

#include "constants.h"

#include <math.h>

#define WATER_J_M3_K 4.182e6 /* density times specific heat of water at 20 C */

/* The sun at the horizon: below this cosine diffuse light from its direction grows no more. */
#define LEAST_COSINE 0.01745

const char *const forcing_sky_names[FORCING_SKIES] = {"brunt", "berdahl-martin", "brutsaert"};
const char *const forcing_convection_names[FORCING_CONVECTIONS] = {"", "therm", "mcadams"};
const char *const forcing_diffuse_names[FORCING_DIFFUSES] = {"isotropic", "hay-davies"};

/* Rise of the sky's emissivity under an overcast of each cloud type: Bolz. */
static const double cloud_rise[WEATHER_CLOUD_TYPES] = {0.0,  0.04, 0.08, 0.17, 0.20,
                                                       0.22, 0.24, 0.25, 0.25};

static double clear_emissivity(const weather_record *w, forcing_sky sky)
{
    const double vapour_mbar = weather_saturation_pa(w->dew_point_k) / 100.0;
    const double dew = (w->dew_point_k - (double)ZERO_CELSIUS_K) / 100.0;
    const double pressure_mbar = w->pressure_pa / 100.0;

    if (sky == FORCING_BRUTSAERT) return 1.24 * pow(vapour_mbar / w->air_temperature_k, 1.0 / 7.0);
    if (sky == FORCING_BERDAHL_MARTIN)
        return 0.711 + 0.56 * dew + 0.73 * dew * dew + 0.013 * cos(M_PI * w->time_h / 12.0) +
               0.00012 * (pressure_mbar - 1000.0);
    return 0.605 + 0.048 * sqrt(vapour_mbar);
}

static double sky_longwave_w_m2(const weather_record *w, forcing_sky sky)
{
    const double cover = 1.0 - w->sky_exposure, air_k = w->air_temperature_k;
    const double cloudy = 1.0 + cloud_rise[w->cloud_type] * cover * cover;
    const double emissivity = fmin(1.0, clear_emissivity(w, sky) * cloudy);

    if (w->longwave_w_m2 > 0.0) return w->longwave_w_m2;
    return emissivity * (double)STEFAN_BOLTZMANN * air_k * air_k * air_k * air_k;
}

static double convection_w_m2_k(const weather_record *w, forcing_convection law, bool is_layered)
{
    const bool is_mcadams = law == FORCING_MCADAMS || (law == FORCING_BY_MODEL && is_layered);

    return is_mcadams ? 5.7 + 3.8 * w->wind_m_s : 9.0 + 1.2 * w->wind_m_s;
}

/* Diffuse light from the sun's direction goes with the beam, and into shadow with it. */
static void move_circumsolar(double *direct_w_m2, double *diffuse_w_m2, sun_position sun)
{
    const double outside_w_m2 = (double)SOLAR_CONSTANT_W_M2 / (sun.distance_au * sun.distance_au);
    const double share = fmin(1.0, *direct_w_m2 / outside_w_m2);

    *direct_w_m2 += share * *diffuse_w_m2 / fmax(LEAST_COSINE, cos(sun.zenith_rad));
    *diffuse_w_m2 *= 1.0 - share;
}

forcing_record forcing_of(const weather_record *w, sun_position sun, const forcing_laws *laws,
                          bool is_layered)
{
    const double rain_m_s = w->precipitation_type ? w->precipitation_m_s : 0.0;
    double direct_w_m2 = sun.zenith_rad < 0.5 * M_PI ? w->direct_w_m2 : 0.0;
    double diffuse_w_m2 = w->diffuse_w_m2, direction[3];

    if (laws->diffuse == FORCING_HAY_DAVIES) move_circumsolar(&direct_w_m2, &diffuse_w_m2, sun);
    forcing_record out = {
        .air_temperature_k = (float)w->air_temperature_k,
        .sky_longwave_w_m2 = (float)sky_longwave_w_m2(w, laws->sky),
        .convection_w_m2_k = (float)convection_w_m2_k(w, laws->convection, is_layered),
        .direct_w_m2 = (float)direct_w_m2,
        .diffuse_w_m2 = (float)diffuse_w_m2,
        .rain_w_m2_k = (float)(WATER_J_M3_K * rain_m_s),
        /* Dry steps take the air's, so that a value between steps is one of rain. */
        .rain_temperature_k =
            (float)(rain_m_s > 0.0 ? w->precipitation_temperature_k : w->air_temperature_k),
        .specific_humidity = (float)weather_specific_humidity(w),
        .pressure_pa = (float)w->pressure_pa,
    };
    sun_direction(sun, direction);
    for (int i = 0; i < 3; i++) out.sun[i] = (float)direction[i];
    return out;
}
