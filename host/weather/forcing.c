#include "weather/forcing.h"

#include "kernels/constants.h"
#include "kernels/thermal/convection.h"

#include <math.h>

#define WATER_J_M3_K 4.182e6 /* density times specific heat of water at 20 C */

/* TARP: 2.537 times 1.52, medium rough, times the root of perimeter by area, 1 per m. */
#define TARP_W_M2_K (2.537 * 1.52)

#define KARMAN 0.4
#define GRAVITY_M_S2 9.80665
#define AIR_J_KG_K 287.05
#define AIR_HEAT_J_KG_K 1005.0
#define LEAST_WIND_M_S 0.1
#define USUAL_HEIGHT_M 10.0
#define USUAL_LENGTH_M 0.001

/* The sun at the horizon: below this cosine diffuse light from its direction grows no more. */
#define LEAST_COSINE 0.01745

const char *const forcing_sky_names[FORCING_SKIES] = {"brunt", "berdahl-martin", "brutsaert"};
const char *const forcing_convection_names[FORCING_CONVECTIONS] = {"", "therm", "mcadams", "tarp",
                                                                   "similarity"};
const char *const forcing_diffuse_names[FORCING_DIFFUSES] = {"isotropic", "hay-davies"};

enum { ALTOSTRATUS = 4, FOG = 8 };

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

/* assumed: what is not told to be of another type is altostratus. */
static bool lacks_type(const weather_record *w)
{
    return w->sky_exposure < 1.0 && w->cloud_type == 0 && !(w->longwave_w_m2 > 0.0);
}

static double cloudy_emissivity(const weather_record *w, double clear, bool thesis)
{
    const double cover = 1.0 - w->sky_exposure;
    const int type = lacks_type(w) && !thesis ? ALTOSTRATUS : w->cloud_type;

    if (type == FOG && !thesis) return clear + fmax(0.0, 1.0 - clear) * cover * cover;
    return clear * (1.0 + cloud_rise[type] * cover * cover);
}

static double sky_longwave_w_m2(const weather_record *w, const forcing_laws *laws)
{
    const double air_k = w->air_temperature_k, clear = clear_emissivity(w, laws->sky);
    const double emissivity = fmin(1.0, cloudy_emissivity(w, clear, laws->thesis));

    if (w->longwave_w_m2 > 0.0) return w->longwave_w_m2;
    return emissivity * (double)STEFAN_BOLTZMANN * air_k * air_k * air_k * air_k;
}

static double height_of(const forcing_laws *laws)
{
    return laws->wind_height_m > 0.0 ? laws->wind_height_m : USUAL_HEIGHT_M;
}

static double length_of(const forcing_laws *laws)
{
    return laws->roughness_length_m > 0.0 ? laws->roughness_length_m : USUAL_LENGTH_M;
}

/* The wind at 10 m. */
static double usual_wind_m_s(const weather_record *w, const forcing_laws *laws)
{
    const double length_m = length_of(laws);

    if (laws->thesis) return w->wind_m_s;
    return w->wind_m_s * (log(USUAL_HEIGHT_M / length_m) / log(height_of(laws) / length_m));
}

static double tarp_w_m2_k(double wind_m_s)
{
    return TARP_W_M2_K * sqrt(wind_m_s);
}

/* Louis' law for heat, its constants as he gives them. */
static void set_similarity(forcing_record *out, const weather_record *w, const forcing_laws *laws)
{
    const double height_m = height_of(laws), length_m = length_of(laws);
    const double wind_m_s = fmax(LEAST_WIND_M_S, w->wind_m_s);
    const double warmth_k = w->air_temperature_k * (1.0 + 0.608 * weather_specific_humidity(w));
    const double density_kg_m3 = w->pressure_pa / (AIR_J_KG_K * warmth_k);
    const double drag = pow(KARMAN / log(height_m / length_m), 2.0);

    out->convection_law = CONVECTION_SIMILARITY;
    out->convection_w_m2_k = (float)(density_kg_m3 * AIR_HEAT_J_KG_K * drag / 0.74 * wind_m_s);
    out->buoyancy = (float)(GRAVITY_M_S2 * height_m / (wind_m_s * wind_m_s));
    out->roughness = (float)(5.3 * 9.4 * drag * sqrt(height_m / length_m));
    if (!laws->thesis)
        out->plate_w_m2_k = (float)tarp_w_m2_k(fmax(LEAST_WIND_M_S, usual_wind_m_s(w, laws)));
}

static void set_convection(forcing_record *out, const weather_record *w, const forcing_laws *laws,
                           bool is_layered)
{
    const forcing_convection law = laws->convection;
    const bool is_mcadams = law == FORCING_MCADAMS || (law == FORCING_BY_MODEL && is_layered);
    const double wind_m_s = usual_wind_m_s(w, laws);

    out->convection_law = law == FORCING_TARP ? CONVECTION_TARP
                          : laws->thesis      ? CONVECTION_WIND
                                              : CONVECTION_BLENDED;
    if (law == FORCING_SIMILARITY)
        set_similarity(out, w, laws);
    else if (law == FORCING_TARP)
        out->convection_w_m2_k = (float)tarp_w_m2_k(wind_m_s);
    else
        out->convection_w_m2_k = (float)(is_mcadams ? 5.7 + 3.8 * wind_m_s : 9.0 + 1.2 * wind_m_s);
}

/* Above the frost point by the rounding of single precision; below 0 C vapour condenses earlier on ice. */
static double wet_below_k(const weather_record *w, const forcing_laws *laws)
{
    const double vapour = log(weather_saturation_pa(w->dew_point_k) / 611.2);
    const double frost_k = (double)ZERO_CELSIUS_K + 272.62 * vapour / (22.46 - vapour);
    const double margin_k = 0.05;

    if (laws->thesis || !(w->relative_humidity > 0.0)) return 0.0;
    return fmax(w->dew_point_k, fmin(frost_k, (double)ZERO_CELSIUS_K)) + margin_k;
}

/* Diffuse light from the sun's direction goes with the beam, and into shadow with it. */
static void move_circumsolar(double *direct_w_m2, double *diffuse_w_m2, sun_position sun)
{
    const double outside_w_m2 = (double)SOLAR_CONSTANT_W_M2 / (sun.distance_au * sun.distance_au);
    const double fraction = fmin(1.0, *direct_w_m2 / outside_w_m2);

    *direct_w_m2 += fraction * *diffuse_w_m2 / fmax(LEAST_COSINE, cos(sun.zenith_rad));
    *diffuse_w_m2 *= 1.0 - fraction;
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
        .sky_longwave_w_m2 = (float)sky_longwave_w_m2(w, laws),
        .direct_w_m2 = (float)direct_w_m2,
        .diffuse_w_m2 = (float)diffuse_w_m2,
        .rain_w_m2_k = (float)(WATER_J_M3_K * rain_m_s),
        /* Dry steps take the air's, so that a value between steps is one of rain. */
        .rain_temperature_k =
            (float)(rain_m_s > 0.0 ? w->precipitation_temperature_k : w->air_temperature_k),
        .specific_humidity = (float)weather_specific_humidity(w),
        .pressure_pa = (float)w->pressure_pa,
        .wet_below_k = (float)wet_below_k(w, laws),
    };
    set_convection(&out, w, laws, is_layered);
    sun_direction(sun, direction);
    for (int i = 0; i < 3; i++) out.sun[i] = (float)direction[i];
    return out;
}

void forcing_check(const weather *w, const forcing_laws *laws, const char *name)
{
    size_t count = 0;

    for (size_t i = 0; i < w->count && !laws->thesis; i++) count += lacks_type(&w->record[i]);
    if (count > 0)
        status_warn("%s: a sky exposure below 1 without a cloud type in %zu of %zu records: their "
                    "longwave is that of altostratus (cloud type %d)",
                    name, count, w->count, ALTOSTRATUS);
}
