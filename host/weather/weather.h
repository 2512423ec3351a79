/* Weather: the history that drives temperatures; thesis Table 2.2-1, Appendix A item 9 (.wth).
 * Inside all is SI; the file's units are converted in the reader and the writer alone. */
#ifndef WEATHER_H
#define WEATHER_H

#include "base/status.h"
#include "sky/site.h"

#include <stddef.h>

enum { WEATHER_CLOUD_TYPES = 9 };

/* One record of the history. */
typedef struct weather_record {
    double time_h; /* local clock time since the history's first midnight */
    double air_temperature_k;
    double pressure_pa;
    double relative_humidity; /* 0..1 */
    double dew_point_k;
    double wind_m_s;
    double direct_w_m2;       /* sun, normal to the beam */
    double diffuse_w_m2;      /* sky, on a level plane */
    double sky_exposure;      /* share of the sky without clouds, 0..1 */
    int cloud_type;           /* 0 clear, 1 cirrus, 2 cirrostratus, 3 altocumulus, 4 altostratus,
                                 5 stratocumulus, 6 stratus, 7 nimbostratus, 8 fog */
    int precipitation_type;   /* 0 none */
    double precipitation_m_s; /* depth of water a second */
    double precipitation_temperature_k;
    double longwave_w_m2; /* from the sky, where it was measured; 0: it follows from the air */
} weather_record;

/* Records at a regular interval that divides an hour. */
typedef struct weather {
    size_t count;
    double interval_s;
    weather_record *record; /* shape (count) */
} weather;

/* Allocates a history whose records are zero. Fails with STATUS_MEMORY. */
status weather_allocate(weather **out, size_t count, double interval_s);
void weather_free(weather *w);

/* Reads a .wth file, or a table (weather_table.h) where the name ends in .csv. Columns of a .wth may
 * run together. Fails with STATUS_FORMAT where counts, intervals,
 * times or ranges do not hold (docs/file-formats.md). A dew point of exactly -1 is computed from
 * the relative humidity. */
status weather_read(weather **out, const char *path);

/* Writes a .wth file. */
status weather_write(const weather *w, const char *path);

/* Hour at which the last full day begins: 24 for the 48 hours of the thesis, 0 where the history is
 * shorter than two days. The image's local clock time counts from here. */
double weather_day_start_h(const weather *w);

/* UTC time in seconds of the history's hour 0, where its last full day is the local day of the
 * site's time. */
double weather_origin_s(const weather *w, const site *place);

/* Vapour pressure of saturated air over water: Magnus with the constants of WMO-No. 8 (2008). */
double weather_saturation_pa(double temperature_k);

/* Kilograms of water vapour in a kilogram of air. */
double weather_specific_humidity(const weather_record *r);

/* Relative humidity that no weather is below all day: what is at most so was meant as a fraction. */
#define WEATHER_DRIEST 0.01

/* Dew point from relative humidity (at least 0.0001), the inverse of the same. */
double weather_dew_point_k(double air_temperature_k, double relative_humidity);

#endif
