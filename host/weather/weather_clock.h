/* Weather clock: whether light falls while the sun is up, and by how much it would have to move in time. */
#ifndef WEATHER_CLOCK_H
#define WEATHER_CLOCK_H

#include "base/status.h"
#include "sky/site.h"

#include <stddef.h>

typedef struct weather_clock {
    double
        shift_h; /* that fits best, later is positive; quarters of an hour; 0: the clock fits, or the
                            light tells nothing */
    double night_share; /* of all light: while the sun is more than 4 degrees below the horizon */
    double days;        /* with light */
} weather_clock;

/* Compares the course of light with a clear sky's, at shifts of up to 12 h. Clouds before or after noon can
 * seem to be a shift: unless a hundredth of the light falls by night, one below 0.75 h is none, nor is one of
 * less than ten days below 1.5 h or with a correlation below 0.97.
 *   light_w_m2    shape (count): direct and diffuse, or global; not-a-number: missing
 *   first_s       time of the middle of the first
 * Fails with STATUS_MEMORY. */
status weather_clock_compare(weather_clock *out, const double *light_w_m2, size_t count,
                             double first_s, double step_s, const site *place);

#endif
