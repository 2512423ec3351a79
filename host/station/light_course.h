/* Light course: the light of hours as records of a quarter of an hour. */
#ifndef LIGHT_COURSE_H
#define LIGHT_COURSE_H

#include "station/weather_cells.h"

/* Gives the light of each cell the course of a clear sky in it, and takes means around each record. The
 * energy of a day is kept:
 *   a cell without sun       goes to its neighbour that has some
 *   a record without sun     to the next one that has
 *   sun below 15 degrees     what is above 1.1 of the clear sky's (of diffuse light: of its global
 *                            irradiance) goes towards the day's middle
 * Cells that are not-a-number leave their records so.
 *   quantity    WEATHER_SERIES_DIRECT_W_M2 or WEATHER_SERIES_DIFFUSE_W_M2
 *   first_s     time of the first record
 *   out_w_m2    shape (WEATHER_RECORDS)
 * Fails with STATUS_MEMORY. */
status light_course(double *out_w_m2, const weather_cells *cells, const site *place, int quantity,
                    double first_s);

#endif
