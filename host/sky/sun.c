#include "sky/sun.h"

#include <math.h>

#define DEGREES (M_PI / 180.0)
#define EARTH_RADIUS_AU (6371.01 / 149597890.0)
#define J2000_S 946728000.0 /* 2000-01-01 12:00 UTC in seconds since 1970 */

/* Position on the celestial sphere; angles in rad. */
typedef struct celestial {
    double right_ascension, declination, distance_au;
} celestial;

static double turn(double angle_rad)
{
    const double rest = fmod(angle_rad, 2.0 * M_PI);

    return rest < 0.0 ? rest + 2.0 * M_PI : rest;
}

static celestial celestial_at(double days)
{
    const double omega = 2.1429 - 0.0010394594 * days;
    const double mean_longitude = 4.8950630 + 0.017202791698 * days;
    const double mean_anomaly = 6.2400600 + 0.0172019699 * days;
    const double longitude = mean_longitude + 0.03341607 * sin(mean_anomaly) +
                             0.00034894 * sin(2.0 * mean_anomaly) - 0.0001134 -
                             0.0000203 * sin(omega);
    const double obliquity = 0.4090928 - 6.2140e-9 * days + 0.0000396 * cos(omega);

    return (celestial){
        .right_ascension = atan2(cos(obliquity) * sin(longitude), cos(longitude)),
        .declination = asin(sin(obliquity) * sin(longitude)),
        /* Not part of PSA: the Astronomical Almanac's short series. */
        .distance_au = 1.00014 - 0.01671 * cos(mean_anomaly) - 0.00014 * cos(2.0 * mean_anomaly),
    };
}

sun_position sun_at(double time_s_utc, double latitude_deg, double longitude_deg)
{
    const double days = (time_s_utc - J2000_S) / 86400.0;
    const double hour = fmod(fmod(time_s_utc, 86400.0) + 86400.0, 86400.0) / 3600.0;
    const double sidereal_h = 6.6974243242 + 0.0657098283 * days + hour;
    const celestial sun = celestial_at(days);
    const double hour_angle = (sidereal_h * 15.0 + longitude_deg) * DEGREES - sun.right_ascension;
    const double latitude = latitude_deg * DEGREES;
    const double cosine = cos(latitude) * cos(hour_angle) * cos(sun.declination) +
                          sin(sun.declination) * sin(latitude);
    const double zenith = acos(fmax(-1.0, fmin(1.0, cosine)));
    const double azimuth = atan2(-sin(hour_angle), tan(sun.declination) * cos(latitude) -
                                                       sin(latitude) * cos(hour_angle));

    return (sun_position){zenith + EARTH_RADIUS_AU * sin(zenith), turn(azimuth), sun.distance_au};
}

void sun_direction(sun_position sun, double out_enu[3])
{
    out_enu[0] = sin(sun.zenith_rad) * sin(sun.azimuth_rad);
    out_enu[1] = sin(sun.zenith_rad) * cos(sun.azimuth_rad);
    out_enu[2] = cos(sun.zenith_rad);
}

typedef struct horizon_view {
    double midnight_s, latitude_deg, longitude_deg;
} horizon_view;

static bool is_up(const horizon_view *view, double hour)
{
    const double time_s = view->midnight_s + hour * 3600.0;

    return sun_at(time_s, view->latitude_deg, view->longitude_deg).zenith_rad < 0.5 * M_PI;
}

/* Halves an interval in which the sun is `up` at the end and not at the start, or the reverse. */
static double crossing(const horizon_view *view, double start_h, double end_h, bool up)
{
    while (end_h - start_h > 1e-5) {
        const double middle_h = 0.5 * (start_h + end_h);
        if (is_up(view, middle_h) == up)
            end_h = middle_h;
        else
            start_h = middle_h;
    }
    return end_h;
}

bool sun_rise_and_set(double midnight_s_utc, double latitude_deg, double longitude_deg,
                      double *out_rise_h, double *out_set_h)
{
    const horizon_view view = {midnight_s_utc, latitude_deg, longitude_deg};
    const double step_h = 1.0 / 12.0;
    double rise_h = -1.0, set_h = -1.0;

    for (int i = 0; i < 288; i++) {
        const double start_h = i * step_h;
        const bool up = is_up(&view, start_h + step_h);
        if (up == is_up(&view, start_h)) continue;
        *(up ? &rise_h : &set_h) = crossing(&view, start_h, start_h + step_h, up);
    }
    if (rise_h < 0.0 || set_h < 0.0) return false;
    *out_rise_h = rise_h;
    *out_set_h = set_h;
    return true;
}
