#include "weather/weather_synthesis.h"

#include "kernels/constants.h"
#include "sky/sun.h"
#include "weather/clear_sky.h"
#include "weather/cloud_sky.h"

#include <math.h>

#define KELVIN ((double)ZERO_CELSIUS_K)

enum { RECORDS = 193, INTERVAL_S = 900 };

/* The fitted day curve: cos(PI (t - peak) / DAY_H) falls to -LIFT SPAN_H before and after the peak. */
#define DAY_H 10.96
#define LIFT 0.328
#define SPAN_H 6.6458
#define DECAY_PER_H 1.14

/* A stated sunrise or sunset may differ by this from the sun's: refraction, and a rounded clock. */
#define RISE_TOLERANCE_H 0.25

weather_summary weather_summary_default(void)
{
    return (weather_summary){
        .air_temperature_sunrise_k = NAN,
        .air_temperature_peak_k = NAN,
        .peak_time_h = NAN,
        .relative_humidity_sunrise = NAN,
        .wind_m_s = NAN,
        .pressure_pa = 101325.0,
        .sky_exposure = 1.0,
        .rain_temperature_k = NAN,
        .sunrise_h = NAN,
        .sunset_h = NAN,
        .high_noon_transmission = NAN,
    };
}

/* Precipitable water from the vapour pressure at the ground: Leckner 1978. */
static double precipitable_water_cm(double vapour_pa, double temperature_k)
{
    return 0.493 * vapour_pa / temperature_k;
}

/* The day of the air temperature, in hours since sunrise. */
typedef struct air_day {
    double rise_h; /* local clock time */
    double peak_h, set_h;
    double low_k, range_k;
} air_day;

static double fall_fraction(double after_peak_h)
{
    return fmax(0.0, (cos(M_PI * after_peak_h / DAY_H) + LIFT) / (1.0 + LIFT));
}

/* assumed: the rise is stretched to begin at sunrise; the fit had it 6.65 h before the peak. */
static double air_temperature_k(const air_day *day, double time_h)
{
    const double since_h = fmod(time_h - day->rise_h + 48.0, 24.0);
    double fraction;

    if (since_h < day->peak_h)
        fraction = fall_fraction(SPAN_H * (day->peak_h - since_h) / day->peak_h);
    else if (since_h < day->set_h)
        fraction = fall_fraction(since_h - day->peak_h);
    else
        fraction =
            fall_fraction(day->set_h - day->peak_h) * exp(-DECAY_PER_H * (since_h - day->set_h));
    return day->low_k + day->range_k * fraction;
}

static double stated_or(double value, double otherwise)
{
    return isnan(value) ? otherwise : value;
}

/* The constant is single, what is stated in C may have been turned by a double one. */
#define CELSIUS_SLACK 1e-4

static status check_summary(const weather_summary *s)
{
    status rc = STATUS_OK;
    const double least_c = WEATHER_LEAST_C - CELSIUS_SLACK, most_c = WEATHER_MOST_C + CELSIUS_SLACK;
    const struct {
        const char *name;
        double value, low, high;
    } range[] = {
        {"air temperature at sunrise in C", s->air_temperature_sunrise_k - KELVIN, least_c, most_c},
        {"air temperature at its peak in C", s->air_temperature_peak_k - KELVIN,
         s->air_temperature_sunrise_k - KELVIN, most_c},
        {"time of the peak in h", s->peak_time_h, 0.0, 24.0},
        {"relative humidity at sunrise", s->relative_humidity_sunrise, 0.0, 1.0},
        {"wind speed in m/s", s->wind_m_s, 0.0, 100.0},
        {"pressure in mbar", s->pressure_pa / 100.0, 300.0, 1100.0},
        {"sky exposure", s->sky_exposure, 0.0, 1.0},
        {"cloud type", s->cloud_type, 0.0, WEATHER_CLOUD_TYPES - 1},
        {"rain in mm/h", s->rain_m_s * 3.6e6, 0.0, 1000.0},
        {"rain temperature in C", stated_or(s->rain_temperature_k, KELVIN) - KELVIN, least_c,
         most_c},
        {"time of sunrise in h", stated_or(s->sunrise_h, 0.0), 0.0, 24.0},
        {"time of sunset in h", stated_or(s->sunset_h, 24.0), stated_or(s->sunrise_h, 0.0), 24.0},
        {"transmission at high noon", stated_or(s->high_noon_transmission, 1.0), 0.0, 1.0},
    };

    for (size_t i = 0; i < sizeof range / sizeof *range; i++)
        NEED(range[i].value >= range[i].low && range[i].value <= range[i].high, STATUS_ARGUMENT,
             "weather: %s: found %.4g, expected %.4g to %.4g", range[i].name, range[i].value,
             range[i].low, range[i].high);
out:
    return rc;
}

static void warn_about_times(const weather_summary *s, double rise_h, double set_h)
{
    if (s->sunrise_h < rise_h - RISE_TOLERANCE_H)
        status_warn(
            "weather: the stated sunrise, %.4g h, comes before the site's of that day, %.4g "
            "h: is it of another date, place or offset?",
            s->sunrise_h, rise_h);
    if (s->sunset_h > set_h + RISE_TOLERANCE_H)
        status_warn(
            "weather: the stated sunset, %.4g h, comes after the site's of that day, %.4g h: "
            "is it of another date, place or offset?",
            s->sunset_h, set_h);
}

static status find_day(air_day *day, const weather_summary *s, const site *place, double midnight_s)
{
    status rc = STATUS_OK;
    double rise_h = s->peak_time_h - SPAN_H, set_h = s->peak_time_h + SPAN_H;

    /* Where the sun stays up or down the fitted curve stands alone. */
    if (sun_rise_and_set(midnight_s, place->latitude_deg, place->longitude_deg, &rise_h, &set_h))
        warn_about_times(s, rise_h, set_h);
    rise_h = stated_or(s->sunrise_h, rise_h);
    set_h = stated_or(s->sunset_h, set_h);
    *day = (air_day){
        .rise_h = rise_h,
        .peak_h = fmod(s->peak_time_h - rise_h + 24.0, 24.0),
        .set_h = fmod(set_h - rise_h + 24.0, 24.0),
        .low_k = s->air_temperature_sunrise_k,
        .range_k = s->air_temperature_peak_k - s->air_temperature_sunrise_k,
    };
    NEED(
        day->peak_h > 0.0 && day->peak_h <= day->set_h, STATUS_ARGUMENT,
        "weather: the air temperature peaks at %g h local time: expected between sunrise at %.2f h "
        "and sunset at %.2f h",
        s->peak_time_h, rise_h, set_h);
out:
    return rc;
}

static void set_air(weather_record *r, const weather_summary *s, const air_day *day)
{
    r->air_temperature_k = air_temperature_k(day, r->time_h);
    r->dew_point_k = weather_dew_point_k(day->low_k, s->relative_humidity_sunrise);
    r->relative_humidity = fmin(1.0, weather_saturation_pa(r->dew_point_k) /
                                         weather_saturation_pa(r->air_temperature_k));
    r->pressure_pa = s->pressure_pa;
    r->wind_m_s = s->wind_m_s;
    r->sky_exposure = s->sky_exposure;
    r->cloud_type = s->cloud_type;
    r->precipitation_type = s->rain_m_s > 0.0;
    r->precipitation_m_s = s->rain_m_s;
    r->precipitation_temperature_k = stated_or(s->rain_temperature_k, r->air_temperature_k);
}

static clear_sky_air air_of(const weather_record *r, double aerosol)
{
    return (clear_sky_air){
        .pressure_pa = r->pressure_pa,
        .water_cm =
            precipitable_water_cm(weather_saturation_pa(r->dew_point_k), r->air_temperature_k),
        .aerosol = aerosol,
    };
}

/* The sun when it is highest on the history's last day, to a minute. */
static sun_position high_noon(const site *place, double midnight_s, double *out_time_h)
{
    sun_position best = sun_at(midnight_s, place->latitude_deg, place->longitude_deg);

    *out_time_h = 0.0;
    for (int minute = 1; minute < 1440; minute++) {
        const sun_position sun =
            sun_at(midnight_s + 60.0 * minute, place->latitude_deg, place->longitude_deg);
        if (sun.zenith_rad >= best.zenith_rad) continue;
        best = sun;
        *out_time_h = minute / 60.0;
    }
    return best;
}

static double beam_transmission(const weather_record *r, double aerosol, sun_position sun)
{
    const clear_sky_air air = air_of(r, aerosol);
    double direct_w_m2, diffuse_w_m2;

    clear_sky_irradiance(&air, sun.zenith_rad, sun.distance_au, &direct_w_m2, &diffuse_w_m2);
    return direct_w_m2 * sun.distance_au * sun.distance_au / (double)SOLAR_CONSTANT_W_M2;
}

/* The aerosol that gives the stated transmission at noon, by bisection. */
static status find_aerosol(double *out, const weather_summary *s, const weather *w,
                           const site *place)
{
    status rc = STATUS_OK;
    const double day_h = weather_day_start_h(w), wanted = s->high_noon_transmission;
    double time_h, low = 0.0, high = 10.0;

    *out = CLEAR_SKY_AEROSOL;
    if (isnan(wanted)) return STATUS_OK;
    const sun_position sun = high_noon(place, weather_origin_s(w, place) + 3600.0 * day_h, &time_h);
    const weather_record *noon = &w->record[lround((day_h + time_h) * 3600.0 / INTERVAL_S)];
    NEED(sun.zenith_rad < 0.5 * M_PI, STATUS_ARGUMENT,
         "weather: transmission at high noon: the sun does not rise on that day");
    const double most = beam_transmission(noon, low, sun);
    NEED(wanted <= most, STATUS_ARGUMENT,
         "weather: transmission at high noon: expected at most %.3f, that of air without aerosol, "
         "not "
         "%.4g",
         most, wanted);
    for (int i = 0; i < 60; i++) {
        const double middle = 0.5 * (low + high);
        if (beam_transmission(noon, middle, sun) > wanted)
            low = middle;
        else
            high = middle;
    }
    *out = 0.5 * (low + high);
out:
    return rc;
}

static void cover_sky(weather_record *r, double cos_zenith)
{
    const double level_w_m2 = r->direct_w_m2 * cos_zenith + r->diffuse_w_m2;
    double beam = r->sky_exposure, level;

    if (r->cloud_type == 0) {
        r->direct_w_m2 *= beam;
        return;
    }
    cloud_sky_shares(r->cloud_type, 1.0 - r->sky_exposure, cos_zenith, &beam, &level);
    r->direct_w_m2 *= beam;
    r->diffuse_w_m2 = fmax(0.0, level * level_w_m2 - r->direct_w_m2 * cos_zenith);
}

static void set_irradiance(weather_record *r, const weather_summary *s, double aerosol,
                           const site *place, double origin_s)
{
    const double clock_h = fmod(r->time_h, 24.0);
    const clear_sky_air air = air_of(r, aerosol);
    const sun_position sun =
        sun_at(origin_s + r->time_h * 3600.0, place->latitude_deg, place->longitude_deg);

    if (sun.zenith_rad >= 0.5 * M_PI) return;
    clear_sky_irradiance(&air, sun.zenith_rad, sun.distance_au, &r->direct_w_m2, &r->diffuse_w_m2);
    cover_sky(r, cos(sun.zenith_rad));
    if (clock_h < s->sunrise_h || clock_h > s->sunset_h) r->direct_w_m2 = 0.0;
}

status weather_synthesise(weather **out, const weather_summary *summary, const site *place)
{
    status rc = STATUS_OK;
    weather *w = NULL;
    air_day day;
    double origin_s, aerosol;

    TRY(check_summary(summary));
    TRY(weather_allocate(&w, RECORDS, INTERVAL_S));
    for (size_t i = 0; i < w->count; i++) w->record[i].time_h = (double)i * INTERVAL_S / 3600.0;
    origin_s = weather_origin_s(w, place);
    TRY(find_day(&day, summary, place, origin_s + 3600.0 * weather_day_start_h(w)));
    for (size_t i = 0; i < w->count; i++) set_air(&w->record[i], summary, &day);
    TRY(find_aerosol(&aerosol, summary, w, place));
    for (size_t i = 0; i < w->count; i++)
        set_irradiance(&w->record[i], summary, aerosol, place, origin_s);
    *out = w;
    w = NULL;
out:
    weather_free(w);
    return rc;
}
