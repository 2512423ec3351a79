/* Weather synthesis: a history from a few numbers, as THERM makes one. Thesis 2.2, Table 2.2-1. */
#ifndef WEATHER_SYNTHESIS_H
#define WEATHER_SYNTHESIS_H

#include "site.h"
#include "weather.h"

typedef struct weather_summary {
    double air_temperature_sunrise_k;
    double air_temperature_peak_k;
    double peak_time_h;               /* local clock time, after sunrise, before sunset */
    double relative_humidity_sunrise; /* 0..1; fixes the dew point, constant over the days */
    double wind_m_s;
    double pressure_pa;  /* at the site */
    double sky_exposure; /* 0..1 */
    int cloud_type;
} weather_summary;

/* Returns a summary with pressure 1013.25 mbar, a clear sky, and not-a-number in what must be
 * stated. */
weather_summary weather_summary_default(void);

/* Makes 193 records, 15 minutes apart, that end at the end of the day of the site's time, so that
 * hours 24 to 48 are that day.
 *   air temperature   cosine by day, exponential decay after sunset
 *   direct, diffuse   clear sky of Bird and Hulstrom (SERI/TR-642-761, 1981); direct times the sky
 *                     exposure (assumed: clouds are opaque and leave the diffuse light as it is)
 * Fails with STATUS_ARGUMENT where a value of the summary is out of its range. */
status weather_synthesise(weather **out, const weather_summary *summary, const site *place);

#endif
