/* Date text: dates and times as tables of weather write them. */
#ifndef DATE_TEXT_H
#define DATE_TEXT_H

#include "station/weather_year.h"

#include <stdbool.h>

/* Reads a date, with or without a time: 2019-01-31, 2019-01-31T12:30:00Z, 2019-01-31 12:30-07:00, 01/31/2019
 * (month first), 20190131:1230. An hour may be 24.
 *   out_offset_h   hours ahead of UTC; not-a-number where the text states none
 * Returns false for other texts, and for days that no year has. */
bool date_text_read(const char *text, weather_date *out, double *out_offset_h);

/* Adds a time of the day to a date: 12:30, 24:00, 1:30. Returns false for other texts. */
bool date_text_add_time(const char *text, weather_date *out);

#endif
