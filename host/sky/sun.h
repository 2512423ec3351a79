/* Sun: where it stands. PSA algorithm: Blanco-Muriel et al., Solar Energy 70 (2001) 431, within 0.01
 * degrees from 1992 to 2045. */
#ifndef SUN_H
#define SUN_H

#include <stdbool.h>

typedef struct sun_position {
    double zenith_rad;  /* geometric: seen from the surface (parallax), without refraction */
    double azimuth_rad; /* clockwise from north, 0 .. 2 pi */
    double distance_au;
} sun_position;

/* Returns the position at a UTC time in seconds since 1970. Longitude is east-positive. */
sun_position sun_at(double time_s_utc, double latitude_deg, double longitude_deg);

/* Sets the unit vector towards the sun: east, north, up. */
void sun_direction(sun_position sun, double out_enu[3]);

/* Finds when the sun's centre crosses the geometric horizon in the 24 hours after a local midnight.
 *   out_rise_h, out_set_h   hours since that midnight
 * Returns false where it does not both rise and set in those hours; nothing is set then. */
bool sun_rise_and_set(double midnight_s_utc, double latitude_deg, double longitude_deg,
                      double *out_rise_h, double *out_set_h);

#endif
