/* Weather history: the weather of a scene's day from a file of any kind. */
#ifndef WEATHER_HISTORY_H
#define WEATHER_HISTORY_H

#include "sky/site.h"
#include "weather/weather.h"

/* Reads by the ending of the name: .epw (weather_epw.h), .dat (SURFRAD, weather_surfrad.h), .csv with dates
 * (dated_table.h) or with hours (weather_table.h; global irradiance alone is split, table_light.h), .wth. The
 * first three know their date, and their place mostly, and are refused or warned about where they do not fit.
 * Fails with STATUS_FORMAT for other endings. */
status weather_history_read(weather **out, const char *path, const site *place);

#endif
