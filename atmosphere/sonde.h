/* Sonde: an upper air observation, as a radiosonde sends it. Thesis 2.4.4. */
#ifndef SONDE_H
#define SONDE_H

#include "base/status.h"
#include "sky/site.h"

#include <stddef.h>

typedef struct sonde_level {
    double altitude_m; /* above sea level */
    double pressure_hpa;
    double temperature_k;
    double dew_point_k; /* NAN: not known */
} sonde_level;

typedef struct sonde {
    size_t count;
    sonde_level *level; /* shape (count), altitudes rise, pressures fall */
} sonde;

/* Reads a sounding in any of these layouts:
 *   the text of the University of Wyoming's archive: a head with PRES HGHT TEMP DWPT, its units hPa
 *   m C C, columns of seven; lines without temperature are passed over
 *   CSV whose first line names the columns with their units, as that archive hands out today
 *   IGRA 2
 * Of several soundings in a file that of the nearest station and hour is taken, with a warning.
 * Missing heights follow from pressure and temperature; a dew point that is missing over 2 km at most
 * lies between its neighbours'.
 *   where   place and time of the scene; NULL: not known
 * Fails with STATUS_FORMAT where a column or its unit is missing, levels do not rise, fewer than two are
 * left, or none of several soundings lies within 6 h. */
status sonde_read(sonde **out, const char *path, const site *where);
void sonde_free(sonde *s);

/* The sounding at an altitude between its ends: temperature and dew point linear, pressure
 * exponential. */
sonde_level sonde_at(const sonde *s, double altitude_m);

#endif
