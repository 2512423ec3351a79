/* Weather synthesis: a history from a few numbers, as THERM makes one. Thesis 2.2, Table 2.2-1. */
#ifndef WEATHER_SYNTHESIS_H
#define WEATHER_SYNTHESIS_H

#include "sky/site.h"
#include "weather/weather.h"

/* Air and rain. */
#define WEATHER_LEAST_C (-100.0)
#define WEATHER_MOST_C 70.0

typedef struct weather_summary {
    double air_temperature_sunrise_k;
    double air_temperature_peak_k;
    double peak_time_h;               /* local clock time, after sunrise, before sunset */
    double relative_humidity_sunrise; /* 0..1; fixes the dew point, constant over the days */
    double wind_m_s;
    double pressure_pa;  /* at the site */
    double sky_exposure; /* 0..1 */
    int cloud_type;
    double rain_m_s; /* all the time */
    /* Not-a-number where not stated: */
    double rain_temperature_k;     /* that of the air */
    double sunrise_h, sunset_h;    /* local clock time; computed */
    double high_noon_transmission; /* of the beam when the sun is highest; a clear sky's */
} weather_summary;

/* Returns a summary with pressure 1013.25 mbar, a clear sky, no rain, and not-a-number in what must
 * be stated and in what may be. */
weather_summary weather_summary_default(void);

/* Makes 193 records, 15 minutes apart, that end at the end of the day of the site's time, so that
 * hours 24 to 48 are that day.
 *   air temperature   cosine by day, exponential decay after sunset
 *   direct, diffuse   clear sky of Bird and Hulstrom (SERI/TR-642-761, 1981), with the aerosol that
 *                     gives the stated transmission at noon; under clouds Shapiro's shares of it
 *                     (cloud_sky.h), or the beam times the sky exposure where no cloud type is
 *                     stated. Before a stated sunrise and after a stated sunset hills hide the beam
 *                     (assumed)
 * Warns where the sun is not up yet at a stated sunrise, or no more at a stated sunset. Fails with
 * STATUS_ARGUMENT where a value of the summary is out of its range. */
status weather_synthesise(weather **out, const weather_summary *summary, const site *place);

#endif
