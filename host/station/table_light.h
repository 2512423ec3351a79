/* Table light: direct and diffuse light of tables that have the global irradiance alone. */
#ifndef TABLE_LIGHT_H
#define TABLE_LIGHT_H

#include "sky/site.h"
#include "weather/weather_table.h"

/* Splits the global irradiance of a table's records by the diffuse fraction of light_split.h, for the days that
 * the scene takes the table for, with a warning. */
void table_light_split(weather_table *table, const site *place, const char *path);

#endif
