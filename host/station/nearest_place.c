#include "station/nearest_place.h"

#include <math.h>

#define RADIAN (M_PI / 180.0)
#define SAME 1e-9 /* a few metres, as squares of degrees */

nearest_place nearest_place_of(const site *place)
{
    return (nearest_place){.site = place, .distance = INFINITY};
}

bool nearest_place_take(nearest_place *n, weather_series *series, double latitude_deg,
                        double longitude_deg)
{
    const double north = latitude_deg - n->site->latitude_deg;
    const double east = remainder(longitude_deg - n->site->longitude_deg, 360.0) *
                        cos(RADIAN * n->site->latitude_deg);
    const double distance = north * north + east * east;
    const bool is_first = isinf(n->distance);

    n->has_many |= !is_first && fabs(distance - n->distance) > SAME;
    if (!is_first && distance > n->distance - SAME) return distance < n->distance + SAME;
    n->distance = distance;
    series->count = 0;
    series->latitude_deg = latitude_deg;
    series->longitude_deg = remainder(longitude_deg, 360.0);
    return true;
}

void nearest_place_tell(const nearest_place *n, const weather_series *series)
{
    if (n->has_many)
        status_warn("%s: has several places: %s at latitude %.4g, longitude %.4g is the nearest",
                    series->path, series->name, series->latitude_deg, series->longitude_deg);
}
