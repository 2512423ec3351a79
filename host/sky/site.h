/* Site: where on the earth and when. Thesis 2.5.2, Appendix A item 6 (.snd). */
#ifndef SITE_H
#define SITE_H

#include "base/status.h"

typedef struct site {
    double latitude_deg, longitude_deg; /* north- and east-positive */
    double time_s;                      /* since 1970-01-01T00:00:00Z, without leap seconds */
    int utc_offset_min;                 /* of local time */
} site;

/* A scene node file. */
typedef struct site_node {
    site where; /* the file states GMT and no local time: utc_offset_min is 0 */
    double sensor_altitude_m;
    double path_zenith_min_deg, path_zenith_max_deg, path_zenith_step_deg;
    double wavenumber_min_cm1, wavenumber_max_cm1, wavenumber_step_cm1;
} site_node;

enum { SITE_TIME_SIZE = 40 };

/* Reads a .snd file: 13 numbers, a line each. Its longitude is west-positive, its year 87 is 1987
 * (four digits are taken as they stand), its hour is GMT. */
status site_read_node(site_node *out, const char *path);

/* Reads an ISO 8601 time with seconds optional and offset mandatory: 1987-06-24T10:00:00-05:00,
 * 1987-06-24T15:00:00.5Z. Fails with STATUS_ARGUMENT, the message holds the text. */
status site_parse_time(const char *iso, double *time_s, int *utc_offset_min);

/* UTC time in seconds of the midnight that begins the local day of the site's time. */
double site_midnight_s(const site *place);

/* Writes the time as ISO 8601 at that offset; three decimals of the second unless it is whole. */
void site_format_time(double time_s, int utc_offset_min, char out[SITE_TIME_SIZE]);

#endif
