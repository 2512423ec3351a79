/* Weather table: measured weather, comma-separated, with units in its header; and what a radiometer
 * saw of the surface, to compare with. Formats: docs/file-formats.md. */
#ifndef WEATHER_TABLE_H
#define WEATHER_TABLE_H

#include "weather/weather.h"

typedef struct weather_table {
    weather *history;
    double *surface_k;        /* shape (history->count); NULL: not measured */
    double *longwave_up_w_m2; /* the same: emitted and reflected */
} weather_table;

/* Reads a table. Its header names the columns, in any order, as `name [unit]`:
 *   time [h], air_temperature [C K], pressure [Pa hPa mbar kPa], wind [m/s]
 *   relative_humidity [% 1] or dew_point [C K]
 *   direct [W/m2] (normal to the beam) and diffuse [W/m2], or global [W/m2], which counts as diffuse:
 *   right for level surfaces
 * and where measured longwave_down [W/m2], longwave_up [W/m2], surface_temperature [C K],
 * rain [mm/h]. Local clock time, at an interval that divides an hour. Exactly a day is taken twice,
 * so that a day's run-in stands before it.
 * Fails with STATUS_FORMAT where that does not hold; out is then empty. */
status weather_table_read(weather_table *out, const char *path);
void weather_table_free(weather_table *table);

#endif
