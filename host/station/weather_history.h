/* Weather history: the weather of a scene's day from a file of any kind. */
#ifndef WEATHER_HISTORY_H
#define WEATHER_HISTORY_H

#include "sky/site.h"
#include "weather/weather.h"

/* Reads .epw (weather_epw.h), .dat (SURFRAD, weather_surfrad.h), or else what weather_read reads.
 * The first two know their place and date, and are refused or warned about where they do not fit.
 * */
status weather_history_read(weather **out, const char *path, const site *place);

#endif
