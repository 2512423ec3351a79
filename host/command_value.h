/* Command values: what stands behind an option. Each returns false where the text is not that. */
#ifndef COMMAND_VALUE_H
#define COMMAND_VALUE_H

#include "forcing.h"

#include <stdbool.h>

/* Takes one number from low to high. */
bool command_number(const char *text, double low, double high, double *out);

/* Takes up to `most` different numbers of devices, 0 to 63, with commas between. */
bool command_device_numbers(const char *text, int most, int *out, size_t *out_count);

/* Takes LAT,LON in degrees, north- and east-positive. */
bool command_place(const char *text, double *latitude_deg, double *longitude_deg);

/* Takes one of `count` words; sets its index. */
bool command_word(const char *text, const char *const *words, int count, int *out);

/* What stands behind the options of the same names; NULL: not given. */
typedef struct command_law_texts {
    const char *sky_longwave, *convection, *diffuse, *roughness_length_m, *wind_height_m;
} command_law_texts;

/* Sets the laws that are stated. Returns 0, or the exit code of a misuse. */
int command_laws(const char *command, const command_law_texts *text, forcing_laws *out);

#endif
