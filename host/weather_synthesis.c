#include "weather_synthesis.h"

#include "clear_sky.h"
#include "constants.h"
#include "sun.h"

#include <math.h>

#define KELVIN ((double)ZERO_CELSIUS_K)

enum { RECORDS = 193, INTERVAL_S = 900 };

/* The fitted day curve: cos(PI (t - peak) / DAY_H) falls to -LIFT SPAN_H before and after the peak. */
#define DAY_H 10.96
#define LIFT 0.328
#define SPAN_H 6.6458
#define DECAY_PER_H 1.14

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
    };
}

/* Precipitable water from the vapour pressure at the ground: Leckner 1978. */
static double precipitable_water_cm(double vapour_pa, double temperature_k)
{
    return 0.493 * vapour_pa / temperature_k;
}

/* The day of the air temperature, in hours since sunrise. */
typedef struct temperature_day {
    double rise_h; /* local clock time */
    double peak_h, set_h;
    double low_k, range_k;
} temperature_day;

static double fall_share(double after_peak_h)
{
    return fmax(0.0, (cos(M_PI * after_peak_h / DAY_H) + LIFT) / (1.0 + LIFT));
}

/* assumed: the rise is stretched to begin at sunrise; the fit had it 6.65 h before the peak. */
static double air_temperature_k(const temperature_day *day, double time_h)
{
    const double since_h = fmod(time_h - day->rise_h + 48.0, 24.0);
    double share;

    if (since_h < day->peak_h)
        share = fall_share(SPAN_H * (day->peak_h - since_h) / day->peak_h);
    else if (since_h < day->set_h)
        share = fall_share(since_h - day->peak_h);
    else
        share = fall_share(day->set_h - day->peak_h) * exp(-DECAY_PER_H * (since_h - day->set_h));
    return day->low_k + day->range_k * share;
}

static status check_summary(const weather_summary *s)
{
    status rc = STATUS_OK;
    const struct {
        const char *name;
        double value, low, high;
    } range[] = {
        {"air temperature at sunrise in C", s->air_temperature_sunrise_k - KELVIN, -100.0, 70.0},
        {"air temperature at its peak in C", s->air_temperature_peak_k - KELVIN,
         s->air_temperature_sunrise_k - KELVIN, 70.0},
        {"time of the peak in h", s->peak_time_h, 0.0, 24.0},
        {"relative humidity at sunrise", s->relative_humidity_sunrise, 0.0, 1.0},
        {"wind speed in m/s", s->wind_m_s, 0.0, 100.0},
        {"pressure in mbar", s->pressure_pa / 100.0, 300.0, 1100.0},
        {"sky exposure", s->sky_exposure, 0.0, 1.0},
        {"cloud type", s->cloud_type, 0.0, WEATHER_CLOUD_TYPES - 1},
    };

    for (size_t i = 0; i < sizeof range / sizeof *range; i++)
        NEED(range[i].value >= range[i].low && range[i].value <= range[i].high, STATUS_ARGUMENT,
             "weather: %s: expected %.4g to %.4g, not %.4g", range[i].name, range[i].low,
             range[i].high, range[i].value);
out:
    return rc;
}

static status find_day(temperature_day *day, const weather_summary *s, const site *place,
                       double midnight_s)
{
    status rc = STATUS_OK;
    double rise_h = s->peak_time_h - SPAN_H, set_h = s->peak_time_h + SPAN_H;

    /* Where the sun stays up or down the fitted curve stands alone. */
    sun_rise_and_set(midnight_s, place->latitude_deg, place->longitude_deg, &rise_h, &set_h);
    *day = (temperature_day){
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

static void set_air(weather_record *r, const weather_summary *s, const temperature_day *day)
{
    r->air_temperature_k = air_temperature_k(day, r->time_h);
    r->dew_point_k = weather_dew_point_k(day->low_k, s->relative_humidity_sunrise);
    r->relative_humidity = fmin(1.0, weather_saturation_pa(r->dew_point_k) /
                                         weather_saturation_pa(r->air_temperature_k));
    r->pressure_pa = s->pressure_pa;
    r->wind_m_s = s->wind_m_s;
    r->sky_exposure = s->sky_exposure;
    r->cloud_type = s->cloud_type;
    r->precipitation_temperature_k = KELVIN;
}

static void set_irradiance(weather_record *r, const site *place, double origin_s)
{
    const sun_position sun =
        sun_at(origin_s + r->time_h * 3600.0, place->latitude_deg, place->longitude_deg);
    const double water_cm =
        precipitable_water_cm(weather_saturation_pa(r->dew_point_k), r->air_temperature_k);

    clear_sky_irradiance(sun.zenith_rad, sun.distance_au, r->pressure_pa, water_cm, &r->direct_w_m2,
                         &r->diffuse_w_m2);
    r->direct_w_m2 *= r->sky_exposure;
}

status weather_synthesise(weather **out, const weather_summary *summary, const site *place)
{
    status rc = STATUS_OK;
    weather *w = NULL;
    temperature_day day;
    double origin_s;

    TRY(check_summary(summary));
    TRY(weather_allocate(&w, RECORDS, INTERVAL_S));
    for (size_t i = 0; i < w->count; i++) w->record[i].time_h = (double)i * INTERVAL_S / 3600.0;
    origin_s = weather_origin_s(w, place);
    TRY(find_day(&day, summary, place, origin_s + 3600.0 * weather_day_start_h(w)));
    for (size_t i = 0; i < w->count; i++) {
        set_air(&w->record[i], summary, &day);
        set_irradiance(&w->record[i], place, origin_s);
    }
    *out = w;
    w = NULL;
out:
    weather_free(w);
    return rc;
}
