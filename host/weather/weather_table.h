/* Weather table: measured weather, comma-separated, with units in its header; and what a radiometer
 * saw of the surface, to compare with. Formats: docs/file-formats.md. */
#ifndef WEATHER_TABLE_H
#define WEATHER_TABLE_H

#include "weather/weather.h"

#include <stdbool.h>

typedef struct weather_table {
    weather *history;
    bool *is_global;   /* shape (history->count): the diffuse light is global irradiance */
    double *surface_k; /* shape (history->count), not-a-number: missing; NULL: not measured */
    double *longwave_up_w_m2; /* the same: emitted and reflected */
} weather_table;

/* Reads a table by csv_row's rule. Its header names the columns, in any order, as `name [unit]`:
 *   time [h], air_temperature [C], pressure [hPa], wind [m/s]
 *   relative_humidity [%] or dew_point [C], or both
 *   direct [W/m2] (normal to the beam) and diffuse [W/m2], or global [W/m2], which counts as diffuse where
 *   one of the others is missing: right for level surfaces
 * and where measured longwave_down [W/m2], longwave_up [W/m2], surface_temperature [C], rain [mm/h], with any
 * unit of the same quantity (unit.h). Local clock time, which may be rounded, at an interval that divides an
 * hour. Exactly a day, with the midnight that ends it or without, is taken twice, so that a day's run-in
 * stands before it. Up to an hour that is missing (column.h) is bridged linearly; longwave_down and rain may
 * be missing for longer: the former follows from the air. What is to compare with is not bridged.
 * Fails with STATUS_FORMAT where that does not hold; out is then empty. */
status weather_table_read(weather_table *out, const char *path);
void weather_table_free(weather_table *table);

#endif
