/* Weather SURFRAD: days as NOAA's stations measure them, every one or three minutes. Format: README
 * of the SURFRAD archive. */
#ifndef WEATHER_SURFRAD_H
#define WEATHER_SURFRAD_H

#include "sky/site.h"
#include "station/weather_series.h"

/* Takes one daily file, or several one behind the other; of several stations the nearest (nearest_place.h). Times are UTC and those of
 * the end of a sample; west longitudes may stand there without a sign. A value of -9999.9, or one
 * whose flag is 1, is missing.
 * Fails with STATUS_FORMAT where the format does not hold, or as weather_series_history does. */
status weather_surfrad_read(weather **out, const char *path, const site *place);

/* The samples as they stand there, to be freed with weather_series_free; fails as above where the format does
 * not hold. */
status weather_surfrad_samples(weather_series *out, const char *path, const site *place);

#endif
