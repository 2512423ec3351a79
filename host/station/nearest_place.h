/* Nearest place: which of a file's several places the scene's weather is taken from. */
#ifndef NEAREST_PLACE_H
#define NEAREST_PLACE_H

#include "sky/site.h"
#include "station/weather_series.h"

#include <stdbool.h>

typedef struct nearest_place {
    const site *site;
    double distance; /* of what was read: squares of degrees of latitude; infinite: nothing yet */
    bool has_many;
} nearest_place;

nearest_place nearest_place_of(const site *place);

/* Tells whether what follows, of a place, is kept: none that was read is nearer to the site. One that is nearer
 * than all before empties the series and gives it its latitude and longitude. */
bool nearest_place_take(nearest_place *n, weather_series *series, double latitude_deg,
                        double longitude_deg);

/* Warns which of several was taken. */
void nearest_place_tell(const nearest_place *n, const weather_series *series);

#endif
