/* Sensor: response and gain of a band. Thesis 2.4 (eq. 2.4-3), 2.5.3, Appendix A item 5 (.sen). */
#ifndef SENSOR_H
#define SENSOR_H

#include "status.h"

/* counts = gain x radiance + offset. */
typedef struct sensor {
    double gain;      /* per W m-2 sr-1 */
    double offset;    /* counts */
    int count;        /* points of the radiance database */
    double *response; /* shape (count), 0..1, in the database's order: ascending wavelength */
} sensor;

/* Reads a .sen file; its gain is per W cm-2 sr-1. Too few responses are an error; further ones,
 * as in the printed sample, are a warning and are not used. */
status sensor_read(sensor **out, const char *path);
void sensor_free(sensor *s);

#endif
