#include "command/command.h"
#include "command/command_value.h"
#include "sky/sun.h"

#include <math.h>
#include <stdio.h>

static const char command[] = "radsig sun";

static const char purpose[] =
    "Prints time,zenith_deg,azimuth_deg,distance_au: the sun's zenith angle without refraction,\n"
    "its azimuth clockwise from north, its distance. Times carry an offset, as\n"
    "1987-06-24T10:00:00-05:00.\n";

typedef struct sun_request {
    site place, last; /* of the last, only the time */
    double step_min;  /* 0: one row */
} sun_request;

static int read_arguments(int argc, char **argv, sun_request *out)
{
    option list[] = {command_site_option(&out->place),
                     {"time", 0, "ISO", "the first row", .out = &out->place,
                      .read = command_read_time, .is_required = true},
                     {"until", 0, "ISO", "rows up to this time, with", .out = &out->last,
                      .read = command_read_time},
                     {"step-min", 0, "N", "minutes from row to row", .number = &out->step_min,
                      .low = 1e-3, .high = 1e9}};
    const option_table table = {
        .command = command, .purpose = purpose, .list = list, .count = sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    if (code != OPTION_TABLE_DONE) return code;
    if (option_table_has(&table, "until") != option_table_has(&table, "step-min"))
        return program_misuse(command, "--until and --step-min go together");
    if (out->step_min == 0.0) out->last = out->place;
    if (out->last.time_s < out->place.time_s)
        return program_misuse(command, "--until is before --time");
    return OPTION_TABLE_DONE;
}

static void print_row(const site *place, double time_s)
{
    const sun_position sun = sun_at(time_s, place->latitude_deg, place->longitude_deg);
    const double azimuth_deg = sun.azimuth_rad * 180.0 / M_PI;
    char text[SITE_TIME_SIZE];

    site_format_time(time_s, place->utc_offset_min, text);
    printf("%s,%.6f,%.6f,%.7f\n", text, sun.zenith_rad * 180.0 / M_PI,
           azimuth_deg < 359.9999995 ? azimuth_deg : 0.0, sun.distance_au);
}

int command_sun(int argc, char **argv)
{
    sun_request request = {0};
    const int code = read_arguments(argc, argv, &request);
    const double first_s = request.place.time_s;

    if (code != OPTION_TABLE_DONE) return code;
    const double step_s = request.step_min > 0.0 ? 60.0 * request.step_min : 1.0;
    puts("time,zenith_deg,azimuth_deg,distance_au");
    /* Half a millisecond lets the last row in if steps do not add up exactly. */
    for (long i = 0; first_s + (double)i * step_s <= request.last.time_s + 5e-4; i++)
        print_row(&request.place, first_s + (double)i * step_s);
    return 0;
}
