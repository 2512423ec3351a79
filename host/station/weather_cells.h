/* Weather cells: a series around a site's two days, one span behind the other, without holes where they
 * can be closed. */
#ifndef WEATHER_CELLS_H
#define WEATHER_CELLS_H

#include "station/weather_series.h"

enum { WEATHER_RECORDS = 193, WEATHER_INTERVAL_S = 900 };

typedef struct weather_cells {
    double begin_s; /* of the first */
    double span_s;
    size_t count;
    weather_sample *cell; /* shape (count) */
} weather_cells;

/* Takes the samples into cells from two hours before `first_s` to two hours beyond the 48 hours that begin
 * there. Then, in this order:
 *   outside the series   cells take what the same clock time of the other day has, with a warning
 *   humidity             dew point from relative humidity; refused where that is 1 % at most: fractions
 *   light                direct and diffuse from each other and the global irradiance
 *                        (light_split.h); behind the gaps where global differs from them by more
 *                        than a tenth in the mean, warned beyond 0.3; none while the sun is down
 *   gaps                 up to an hour is bridged: linear; light by its share of the clear sky's
 *   pressure             that of the standard atmosphere (ISO 2533) at the series' elevation
 * and warns of what it derived. What is missing still is not-a-number. The caller releases *out with
 * weather_cells_free. */
status weather_cells_make(weather_cells *out, const weather_series *series, const site *place,
                          double first_s);
void weather_cells_free(weather_cells *cells);

#endif
