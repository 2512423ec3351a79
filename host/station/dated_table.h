/* Dated table: weather in separated values with a date in each row: TMY3 and NSRDB of NREL, ERA5's points,
 * PVGIS, and tables of others with a column of times. Formats: NREL/TP-581-43156 (TMY3), NREL's PSM
 * documents, ECMWF's parameter database, docs/file-formats.md. */
#ifndef DATED_TABLE_H
#define DATED_TABLE_H

#include "sky/site.h"
#include "station/weather_series.h"

#include <stdbool.h>

/* Whether a file's first lines are those of such a table. Fails as record_file_open does. */
status dated_table_is(bool *out, const char *path);

/* Takes the day of the site's time and the day before, by month and day (weather_year.h). Of several places
 * the nearest to the site is taken. A table that names no place is taken to be of the site's, one whose times
 * have no offset from UTC to be in the site's local time.
 * Fails with STATUS_FORMAT where the format does not hold, or as weather_series_history does. */
status dated_table_read(weather **out, const char *path, const site *place);

#endif
