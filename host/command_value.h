/* Command values: what stands behind an option. Each returns false where the text is not that. */
#ifndef COMMAND_VALUE_H
#define COMMAND_VALUE_H

#include <stdbool.h>

/* Takes one number from low to high. */
bool command_number(const char *text, double low, double high, double *out);

/* Takes LAT,LON in degrees, north- and east-positive. */
bool command_place(const char *text, double *latitude_deg, double *longitude_deg);

#endif
