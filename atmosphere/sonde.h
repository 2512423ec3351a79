/* Sonde: an upper air observation, as a radiosonde sends it. Thesis 2.4.4. */
#ifndef SONDE_H
#define SONDE_H

#include "base/status.h"

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

/* Reads either layout:
 *   the text of the University of Wyoming's archive: a head with PRES HGHT TEMP DWPT, its units hPa
 *   m C C, columns of seven; lines without height or temperature are passed over
 *   CSV, its first line the columns in any order: pressure_hpa, altitude_m or altitude_km,
 *   temperature_c or temperature_k, and dew_point_c, dew_point_k, relative_humidity_percent or none
 * Fails with STATUS_FORMAT where a column or its unit is missing, levels do not rise, or fewer than
 * two are left. */
status sonde_read(sonde **out, const char *path);
void sonde_free(sonde *s);

/* The sounding at an altitude between its ends: temperature and dew point linear, pressure
 * exponential. */
sonde_level sonde_at(const sonde *s, double altitude_m);

#endif
