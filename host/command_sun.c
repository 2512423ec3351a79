#include "command.h"
#include "command_value.h"
#include "site.h"
#include "sun.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>

static const char help[] =
    "usage: radsig sun --site LAT,LON --time ISO [--until ISO --step-min N]\n"
    "\n"
    "Prints time,zenith_deg,azimuth_deg,distance_au: the sun's zenith angle without refraction, "
    "its\n"
    "azimuth clockwise from north, its distance. Degrees north and east are positive; times carry\n"
    "an offset, as 1987-06-24T10:00:00-05:00.\n"
    "\n"
    "  --until ISO    rows up to this time, with\n"
    "  --step-min N   minutes from row to row\n";

typedef struct sun_request {
    double latitude_deg, longitude_deg;
    double first_s, last_s, step_s;
    int utc_offset_min;
} sun_request;

/* Returns 0, or the exit code of a misuse. */
static int check_steps(const char *until, const char *step, sun_request *out)
{
    double minutes;
    int offset_min;

    out->last_s = out->first_s;
    out->step_s = 1.0;
    if (!until && !step) return 0;
    if (!until || !step) return command_misuse("sun", "--until and --step-min go together");
    if (site_parse_time(until, &out->last_s, &offset_min) != STATUS_OK)
        return command_misuse("sun", "--until: %s", status_message());
    if (out->last_s < out->first_s) return command_misuse("sun", "--until is before --time");
    if (!command_number(step, 1e-3, 1e9, &minutes))
        return command_misuse("sun", "--step-min '%s': expected minutes from .001", step);
    out->step_s = 60.0 * minutes;
    return 0;
}

static int read_arguments(int argc, char **argv, sun_request *out)
{
    static const struct option options[] = {
        {"site", required_argument, NULL, 's'},  {"time", required_argument, NULL, 't'},
        {"until", required_argument, NULL, 'u'}, {"step-min", required_argument, NULL, 'm'},
        {"help", no_argument, NULL, 'h'},        {0}};
    const char *place = NULL, *time = NULL, *until = NULL, *step = NULL;
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, "+:", options, NULL)) != -1) {
        if (option == 's')
            place = optarg;
        else if (option == 't')
            time = optarg;
        else if (option == 'u')
            until = optarg;
        else if (option == 'm')
            step = optarg;
        else if (option == 'h')
            return -1;
        else
            return command_misuse("sun", "'%s' %s", argv[optind - 1],
                                  option == ':' ? "needs a value" : "is no option");
    }
    if (optind < argc) return command_misuse("sun", "'%s' is no option", argv[optind]);
    if (!place || !time) return command_misuse("sun", "needs --site and --time");
    if (!command_place(place, &out->latitude_deg, &out->longitude_deg))
        return command_misuse("sun", "--site '%s': expected LAT,LON in degrees", place);
    if (site_parse_time(time, &out->first_s, &out->utc_offset_min) != STATUS_OK)
        return command_misuse("sun", "--time: %s", status_message());
    return check_steps(until, step, out);
}

static void print_row(const sun_request *request, double time_s)
{
    const sun_position sun = sun_at(time_s, request->latitude_deg, request->longitude_deg);
    const double azimuth_deg = sun.azimuth_rad * 180.0 / M_PI;
    char text[SITE_TIME_SIZE];

    site_format_time(time_s, request->utc_offset_min, text);
    printf("%s,%.6f,%.6f,%.7f\n", text, sun.zenith_rad * 180.0 / M_PI,
           azimuth_deg < 359.9999995 ? azimuth_deg : 0.0, sun.distance_au);
}

int command_sun(int argc, char **argv)
{
    sun_request request;
    const int misuse = read_arguments(argc, argv, &request);

    if (misuse < 0) fputs(help, stdout);
    if (misuse) return misuse < 0 ? 0 : misuse;
    puts("time,zenith_deg,azimuth_deg,distance_au");
    /* Half a millisecond lets the last row stand where steps do not add up exactly. */
    for (long i = 0; request.first_s + (double)i * request.step_s <= request.last_s + 5e-4; i++)
        print_row(&request, request.first_s + (double)i * request.step_s);
    return 0;
}
