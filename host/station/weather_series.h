/* Weather series: what a station measured, sample by sample, into the history of a site's day and
 * the day before, by the site's clock. */
#ifndef WEATHER_SERIES_H
#define WEATHER_SERIES_H

#include "sky/site.h"
#include "weather/weather.h"

enum {
    WEATHER_SERIES_AIR_K,
    WEATHER_SERIES_DEW_POINT_K,
    WEATHER_SERIES_PRESSURE_PA,
    WEATHER_SERIES_WIND_M_S,
    WEATHER_SERIES_DIRECT_W_M2,  /* normal to the beam */
    WEATHER_SERIES_DIFFUSE_W_M2, /* on a level plane */
    WEATHER_SERIES_LONGWAVE_W_M2,
    WEATHER_SERIES_COVER, /* of clouds, 0..1 */
    WEATHER_SERIES_RAIN_M_S,
    WEATHER_SERIES_HUMIDITY,         /* relative, 0..1 */
    WEATHER_SERIES_GLOBAL_W_M2,      /* direct and diffuse on a level plane */
    WEATHER_SERIES_LONGWAVE_UP_W_M2, /* from the ground: to compare with */
    WEATHER_SERIES_COUNT
};

/* What came down in a span of time, and the air at its end; not-a-number where it is missing. */
typedef struct weather_sample {
    double end_s; /* UTC since 1970 */
    int year;     /* as its row states it, where a file has years by month and day; else 0 */
    double value[WEATHER_SERIES_COUNT];
} weather_sample;

typedef struct weather_series {
    const char *path; /* for messages */
    char name[64];    /* of the station */
    double latitude_deg, longitude_deg;
    double elevation_m;  /* not-a-number: not known */
    double utc_offset_h; /* as the file states it; not-a-number: its times are UTC */
    double span_s;       /* of every sample */
    double air_before_s; /* the air is that of so long before the end of the span */
    size_t count;
    weather_sample *sample; /* shape (count), in the order of time */
} weather_series;

/* Quantities as messages call them. */
extern const char *const weather_series_names[WEATHER_SERIES_COUNT];

/* Adds a sample to a series; `room` is what it has room for. */
status weather_series_add(weather_series *series, size_t *room, const weather_sample *sample);
void weather_series_free(weather_series *series);

/* Makes 193 records, 15 minutes apart, whose hours 24 to 48 are the day of the site's time, from the
 * series' cells (weather_cells.h).
 *   spans up to 15 min   means of what is nearer to a record than to its neighbours; of the beam
 *                        over the time that the sun is up
 *   longer spans         air linear from end to end; light with the course of a clear sky inside
 *                        each span (light_course.h)
 * Missing longwave follows from the air (weather_record), cloud is of the altostratus kind
 * (assumed), rain as warm as the air.
 * Warns where the station is more than 50 km from the site, and where its light, of all samples, does not
 * fit the sun (weather_clock.h) or, without light, its offset from UTC not its longitude. Fails with STATUS_FORMAT where the
 * series has nothing of the site's day, or lacks more than an hour. */
status weather_series_history(weather **out, const weather_series *series, const site *place);

#endif
