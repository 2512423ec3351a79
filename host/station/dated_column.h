/* Dated column: what the columns of tables with dates are called, and what is read of them. */
#ifndef DATED_COLUMN_H
#define DATED_COLUMN_H

#include "files/column.h"
#include "station/weather_series.h"

#include <stdbool.h>

/* What is read beside a series' quantities. */
enum {
    DATED_EAST = WEATHER_SERIES_COUNT, /* wind to the east, to the north */
    DATED_NORTH,
    DATED_BEAM_LEVEL, /* direct light on a level plane */
    DATED_RAIN_HOURS, /* that rain came down in */
    DATED_COLUMNS
};

/* shape (DATED_COLUMNS) */
extern const column dated_columns[DATED_COLUMNS];

/* Finds the column of a header's field. ERA5's names, which are short and have units of their own, count
 * where `is_era5`.
 *   out_unit   the unit that the field states, or that goes with the name; "": by size, as pressure may be in
 *              Pa or hPa
 * Returns -1 for other names. */
int dated_column_find(const char *field, bool is_era5, char out_unit[64]);

#endif
