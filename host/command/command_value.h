/* Command values: options that several commands share. */
#ifndef COMMAND_VALUE_H
#define COMMAND_VALUE_H

#include "options/option_table.h"
#include "sky/site.h"
#include "weather/forcing.h"

/* A reader: of a time, into the time and the UTC offset of a site. */
status command_read_time(const option *o, const char *text);

/* A day at a place, as stated. */
typedef struct command_day {
    site place;
    double date_s, utc_offset_h;
} command_day;

/* The place, at the midnight that begins the day. */
site command_day_site(const command_day *day);

option command_site_option(site *place); /* --site LAT,LON, required */
option command_date_option(command_day *day);
option command_offset_option(command_day *day);

enum { COMMAND_EXACT, COMMAND_THESIS };

/* Laws, by the indices of their names; a convection of -1 is the model's own. */
typedef struct command_laws {
    int sky, convection, diffuse;
    int mode; /* COMMAND_EXACT, COMMAND_THESIS */
    double roughness_length_m, wind_height_m;
} command_laws;

forcing_laws command_laws_of(const command_laws *laws);

option command_mode_option(command_laws *laws);
option command_sky_option(command_laws *laws);
option command_convection_option(command_laws *laws);
option command_roughness_option(command_laws *laws);
option command_wind_height_option(command_laws *laws);

option command_cull_option(bool *is_wanted);
option command_device_option(int64_t *index);

#endif
