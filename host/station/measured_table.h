/* Measured table: temperatures that were measured on surfaces, to compare with. Format:
 * docs/file-formats.md. */
#ifndef MEASURED_TABLE_H
#define MEASURED_TABLE_H

#include "base/status.h"
#include "sky/site.h"

#include <stddef.h>

typedef struct measured_table {
    size_t column_count;
    char **name;           /* shape (column_count) */
    size_t count;          /* rows, in the order of time */
    double *time_s;        /* shape (count): UTC since 1970 */
    double *temperature_k; /* shape (count, column_count); not-a-number: missing */
} measured_table;

/* Reads separated values: a column of times, then one or more as `name [unit]`. Times are `time [h]`, hours
 * since the midnight that begins the site's day, or dates with times (date_text.h), which without an offset
 * have the site's.
 * Fails with STATUS_FORMAT where that does not hold, or times do not rise. */
status measured_table_read(measured_table *out, const char *path, const site *place);
/* Takes SURFRAD days (weather_surfrad.h) as one column: the temperature of ground that sends up the measured
 * longwave, of which it reflects 1 - emissivity of what comes down. Local days of which less than half is there
 * are left out, with a warning. */
status measured_table_surfrad(measured_table *out, const char *path, const site *place,
                              const char *name, double emissivity);

void measured_table_free(measured_table *table);

/* The temperature of a grey surface from the longwave that leaves it, emitted and reflected, and that comes
 * down. */
double measured_table_radiating_k(double up_w_m2, double down_w_m2, double emissivity);

#endif
