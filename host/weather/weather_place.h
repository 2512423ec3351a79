/* Weather place: whether a history fits a date and a place; a .wth names neither. */
#ifndef WEATHER_PLACE_H
#define WEATHER_PLACE_H

#include "weather/weather.h"

/* Warns where the history has sunlight while the sun is below the horizon of the site on the days
 * that it is taken for, or less than a day of run-in before the site's time.
 *   name   of the history, for the message */
void weather_place_check(const weather *w, const site *place, const char *name);

/* The same for the whole day that begins at the site's time. */
void weather_place_check_day(const weather *w, const site *midnight, const char *name);

#endif
