#include "weather/weather_place.h"

#include "sky/sun.h"
#include "weather/weather_clock.h"

#include <math.h>
#include <stdlib.h>

/* Light of twilight and of coarse steps passes. */
#define DARK_W_M2 20.0
#define BELOW_RAD (4.0 * M_PI / 180.0)

static bool is_night(const weather *w, const site *place, double time_s)
{
    const double half_s = 0.5 * w->interval_s;

    for (int i = -1; i <= 1; i++) {
        const sun_position sun =
            sun_at(time_s + i * half_s, place->latitude_deg, place->longitude_deg);
        if (sun.zenith_rad < 0.5 * M_PI + BELOW_RAD) return false;
    }
    return true;
}

/* Sets the hours by which the history would have to be later for its light to fit the sun; 0: it fits, or
 * that cannot be told. */
static double fitting_shift_h(const weather *w, const site *place)
{
    double *light = malloc(w->count * sizeof *light);
    weather_clock clock = {0};

    if (!light) return 0.0;
    for (size_t i = 0; i < w->count; i++)
        light[i] = w->record[i].direct_w_m2 + w->record[i].diffuse_w_m2;
    const double first_s = weather_origin_s(w, place) + 3600.0 * w->record[0].time_h;
    if (weather_clock_compare(&clock, light, w->count, first_s, w->interval_s, place) != STATUS_OK)
        clock.shift_h = 0.0;
    free(light);
    return clock.shift_h;
}

static void warn_of_shift(double shift_h, const char *name)
{
    if (shift_h != 0.0)
        status_warn(
            "%s: its light would fit the sun if its times were %.4g h %s: is its clock that of "
            "the scene's time?",
            name, fabs(shift_h), shift_h > 0.0 ? "later" : "earlier");
}

void weather_place_check(const weather *w, const site *place, const char *name)
{
    const double origin_s = weather_origin_s(w, place);
    const double time_h = (place->time_s - origin_s) / 3600.0;
    size_t count = 0, first = 0;

    for (size_t i = 0; i < w->count; i++) {
        const weather_record *r = &w->record[i];
        if (r->direct_w_m2 < DARK_W_M2 && r->diffuse_w_m2 < DARK_W_M2) continue;
        if (!is_night(w, place, origin_s + 3600.0 * r->time_h)) continue;
        if (count++ == 0) first = i;
    }
    if (count > 0)
        status_warn("%s: has sunlight in %zu records, the first at %.4g h, while the sun is below "
                    "the horizon of latitude_deg %g, longitude_deg %g that day: is it the weather "
                    "of another date, place or offset?",
                    name, count, w->record[first].time_h, place->latitude_deg,
                    place->longitude_deg);
    warn_of_shift(fitting_shift_h(w, place), name);
    if (time_h - w->record[0].time_h < 24.0 - 1e-6)
        status_warn("%s: begins %.4g h before the image, less than a day", name,
                    time_h - w->record[0].time_h);
}

void weather_place_check_day(const weather *w, const site *midnight, const char *name)
{
    site end = *midnight;

    end.time_s += 86399.0;
    weather_place_check(w, &end, name);
}
