/* Weather EPW: a year of hours as EnergyPlus reads it. Format: EnergyPlus Auxiliary Programs, EPW
 * Data Dictionary. */
#ifndef WEATHER_EPW_H
#define WEATHER_EPW_H

#include "sky/site.h"
#include "weather/weather.h"

/* Takes the day of the site's time and the day before, by month and day: typical years are made of
 * months of several. Hours are those before the time that stands there, in local standard time.
 * Warns where all is of one year that is not the site's.
 * Fails with STATUS_FORMAT where the format does not hold, or as weather_series_history does. */
status weather_epw_read(weather **out, const char *path, const site *place);

#endif
