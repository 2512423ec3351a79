#include "command/command_value.h"

#include "base/number.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static status read_place(const option *o, const char *text)
{
    status rc = STATUS_OK;
    double value[2];
    site *place = o->out;

    NEED(number_read_list(text, 2, value) && fabs(value[0]) <= 90.0 && fabs(value[1]) <= 180.0,
         STATUS_ARGUMENT, "found '%s', expected LAT,LON in degrees, -90 to 90 and -180 to 180",
         text);
    place->latitude_deg = value[0];
    place->longitude_deg = value[1];
out:
    return rc;
}

static status read_date(const option *o, const char *text)
{
    status rc = STATUS_OK;
    char midnight[64];
    int unused;

    snprintf(midnight, sizeof midnight, "%.40sT00:00:00Z", text);
    NEED(site_parse_time(midnight, o->out, &unused) == STATUS_OK, STATUS_ARGUMENT,
         "found '%s', expected YYYY-MM-DD", text);
out:
    return rc;
}

status command_read_time(const option *o, const char *text)
{
    site *place = o->out;

    return site_parse_time(text, &place->time_s, &place->utc_offset_min);
}

static status read_back(const option *o, const char *text)
{
    status rc = STATUS_OK;

    NEED(!strcmp(text, "back"), STATUS_ARGUMENT, "found '%s', expected back", text);
    *(bool *)o->out = true;
out:
    return rc;
}

site command_day_site(const command_day *day)
{
    site place = day->place;

    place.utc_offset_min = (int)lround(60.0 * day->utc_offset_h);
    place.time_s = day->date_s - 60.0 * place.utc_offset_min;
    return place;
}

forcing_laws command_laws_of(const command_laws *laws)
{
    /* The model's own convection goes before those that have a name. */
    return (forcing_laws){.sky = (forcing_sky)laws->sky,
                          .convection = (forcing_convection)(laws->convection + 1),
                          .diffuse = (forcing_diffuse)laws->diffuse,
                          .thesis = laws->mode == COMMAND_THESIS,
                          .roughness_length_m = laws->roughness_length_m,
                          .wind_height_m = laws->wind_height_m};
}

option command_site_option(site *place)
{
    return (option){.name = "site",
                    .value = "LAT,LON",
                    .help = "in degrees; north and east are positive",
                    .out = place,
                    .read = read_place,
                    .is_required = true};
}

option command_date_option(command_day *day)
{
    return (option){.name = "date",
                    .value = "YYYY-MM-DD",
                    .help = "the last full day of the history: hours 24 to 48 of 48 hours",
                    .out = &day->date_s,
                    .read = read_date,
                    .is_required = true};
}

option command_offset_option(command_day *day)
{
    return (option){.name = "utc-offset",
                    .value = "H",
                    .help = "hours that local time is ahead of UTC",
                    .number = &day->utc_offset_h,
                    .low = -14.0,
                    .high = 14.0,
                    .is_required = true};
}

option command_mode_option(command_laws *laws)
{
    static const char *const modes[] = {"exact", "thesis"};

    return (option){.name = "mode",
                    .value = "MODE",
                    .help = "exact, or thesis: as THERM is reconstructed, without what came later "
                            "(default exact, with --sensitivity thesis)",
                    .index = &laws->mode,
                    .word = modes,
                    .word_count = 2};
}

option command_sky_option(command_laws *laws)
{
    return (option){.name = "sky-longwave",
                    .value = "LAW",
                    .help = "where none was measured: brunt (the default), berdahl-martin or "
                            "brutsaert",
                    .index = &laws->sky,
                    .word = forcing_sky_names,
                    .word_count = FORCING_SKIES};
}

option command_convection_option(command_laws *laws)
{
    return (option){.name = "convection",
                    .value = "LAW",
                    .help = "therm, mcadams, tarp or similarity; by default the model's own",
                    .index = &laws->convection,
                    .word = forcing_convection_names + 1,
                    .word_count = FORCING_CONVECTIONS - 1};
}

option command_roughness_option(command_laws *laws)
{
    return (option){.name = "roughness-length-m",
                    .value = "X",
                    .help = "of the ground, for similarity and wind heights (default 0.001)",
                    .number = &laws->roughness_length_m,
                    .low = FORCING_ROUGHNESS_LOW_M,
                    .high = FORCING_ROUGHNESS_HIGH_M};
}

option command_wind_height_option(command_laws *laws)
{
    return (option){.name = "wind-height-m",
                    .value = "X",
                    .help = "where the weather's wind blows (default 10)",
                    .number = &laws->wind_height_m,
                    .low = FORCING_HEIGHT_LOW_M,
                    .high = FORCING_HEIGHT_HIGH_M};
}

option command_cull_option(bool *is_wanted)
{
    return (option){.name = "cull",
                    .value = "back",
                    .help = "facets are met from the front alone, where they run counter-clockwise",
                    .out = is_wanted,
                    .read = read_back};
}

option command_device_option(int64_t *index)
{
    return (option){.name = "device",
                    .value = "N",
                    .help = "OpenCL device, see radsig devices",
                    .whole = index,
                    .low = 0,
                    .high = 63};
}
