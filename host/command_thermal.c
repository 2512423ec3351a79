#include "command.h"
#include "command_sensitivity.h"
#include "command_value.h"
#include "constants.h"
#include "curve.h"
#include "picture.h"
#include "thermal.h"
#include "weather_history.h"
#include "weather_place.h"

#include <getopt.h>
#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: radsig thermal --materials FILE --material NAME --weather FILE --site LAT,LON\n"
    "                      --date YYYY-MM-DD --utc-offset H --thickness-cm X\n"
    "                      [--slope D --azimuth D --power-w-m2 X --model therm|layered\n"
    "                       --sky-longwave LAW --convection LAW --diffuse LAW\n"
    "                       --roughness-length-m X --wind-height-m X --plot FILE.png]\n"
    "       radsig thermal --sensitivity --materials FILE --weather FILE --site LAT,LON\n"
    "                      --date YYYY-MM-DD --utc-offset H\n"
    "                      [--objects FILE.csv | --thickness-cm X ...] [--runs N --seed N]\n"
    "\n"
    "Takes one facet in full sun through a weather history and prints time_h,temperature_c, a row\n"
    "per weather record. Degrees north and east are positive.\n"
    "\n"
    "  --date         the last full day of the history: hours 24 to 48 of 48 hours\n"
    "  --utc-offset   hours that local time is ahead of UTC\n"
    "  --slope        0 level and facing up (the default), 90 a wall\n"
    "  --azimuth      of the outward normal, clockwise from north (default 0)\n"
    "  --power-w-m2   self-generated (default 0)\n"
    "  --model        therm (the default), or layered: unequal nodes, McAdams' convection, air\n"
    "                 behind where abs(exposed area) is above .75\n"
    "  --sky-longwave brunt (the default), berdahl-martin or brutsaert\n"
    "  --convection   therm, mcadams, tarp or similarity; by default the model's own\n"
    "  --roughness-length-m, --wind-height-m   of similarity (default .001 and 10)\n"
    "  --diffuse      isotropic (the default) or hay-davies\n"
    "  --plot         draws the temperatures and the air's\n"
    "\n"
    "With --sensitivity one input after the other is off by its measurement error, and the table\n"
    "input,error,unit,rmse_c,sigma_c,thesis_rmse_c,ratio says what that does to the temperatures "
    "of\n"
    "the last full day, beside Tables 3.1.1-1 and 3.1.2-1 of the thesis.\n"
    "\n"
    "  --objects      what is studied: a table with the header\n"
    "                 material,thickness_cm,slope_deg,azimuth_deg,power_w_m2; without it "
    "--material,\n"
    "                 or every material of the list, as the options above say\n"
    "  --runs         of each input (default 100)\n"
    "  --seed         of the random numbers (default 1)\n"
    "  --plot         draws the standard deviations over the hours\n";

typedef struct thermal_request {
    const char *materials, *material, *weather;
    site place;
    const char *plot, *objects;
    double slope_deg, azimuth_deg, thickness_cm, power_w_m2;
    double runs, seed;
    forcing_laws laws;
    bool is_layered, is_sensitivity;
} thermal_request;

enum {
    MATERIALS,
    WEATHER,
    SITE,
    DATE,
    OFFSET,
    MATERIAL,
    SLOPE,
    AZIMUTH,
    THICKNESS,
    POWER,
    MODEL,
    SKY_LONGWAVE,
    CONVECTION,
    DIFFUSE,
    ROUGHNESS,
    WIND_HEIGHT,
    PLOT,
    OBJECTS,
    RUNS,
    SEED,
    VALUES,
    HELP = VALUES,
    SENSITIVITY,
    REQUIRED = MATERIAL
};

static const struct option options[] = {[MATERIALS] = {"materials", 1, NULL, MATERIALS},
                                        [WEATHER] = {"weather", 1, NULL, WEATHER},
                                        [SITE] = {"site", 1, NULL, SITE},
                                        [DATE] = {"date", 1, NULL, DATE},
                                        [OFFSET] = {"utc-offset", 1, NULL, OFFSET},
                                        [MATERIAL] = {"material", 1, NULL, MATERIAL},
                                        [SLOPE] = {"slope", 1, NULL, SLOPE},
                                        [AZIMUTH] = {"azimuth", 1, NULL, AZIMUTH},
                                        [THICKNESS] = {"thickness-cm", 1, NULL, THICKNESS},
                                        [POWER] = {"power-w-m2", 1, NULL, POWER},
                                        [MODEL] = {"model", 1, NULL, MODEL},
                                        [SKY_LONGWAVE] = {"sky-longwave", 1, NULL, SKY_LONGWAVE},
                                        [CONVECTION] = {"convection", 1, NULL, CONVECTION},
                                        [DIFFUSE] = {"diffuse", 1, NULL, DIFFUSE},
                                        [ROUGHNESS] = {"roughness-length-m", 1, NULL, ROUGHNESS},
                                        [WIND_HEIGHT] = {"wind-height-m", 1, NULL, WIND_HEIGHT},
                                        [PLOT] = {"plot", 1, NULL, PLOT},
                                        [OBJECTS] = {"objects", 1, NULL, OBJECTS},
                                        [RUNS] = {"runs", 1, NULL, RUNS},
                                        [SEED] = {"seed", 1, NULL, SEED},
                                        [HELP] = {"help", 0, NULL, HELP},
                                        [SENSITIVITY] = {"sensitivity", 0, NULL, SENSITIVITY},
                                        {0}};

static int check_number(const char *text, int option, double low, double high, double *out)
{
    if (!text || command_number(text, low, high, out)) return 0;
    return command_misuse("thermal", "--%s '%s': expected a number from %g to %g",
                          options[option].name, text, low, high);
}

static int check_whole(const char *text, int option, double low, double high, double *out)
{
    if (!text || (command_number(text, low, high, out) && *out == floor(*out))) return 0;
    return command_misuse("thermal", "--%s '%s': expected a whole number from %.0f to %.0f",
                          options[option].name, text, low, high);
}

static int check_place(char *value[VALUES], site *out)
{
    char midnight[64];
    double offset_h = 0.0;
    int unused;

    if (!command_place(value[SITE], &out->latitude_deg, &out->longitude_deg))
        return command_misuse("thermal", "--site '%s': expected LAT,LON in degrees", value[SITE]);
    if (check_number(value[OFFSET], OFFSET, -14.0, 14.0, &offset_h)) return EXIT_USAGE;
    snprintf(midnight, sizeof midnight, "%.40sT00:00:00Z", value[DATE]);
    if (site_parse_time(midnight, &out->time_s, &unused) != STATUS_OK)
        return command_misuse("thermal", "--date '%s': expected YYYY-MM-DD", value[DATE]);
    out->utc_offset_min = (int)lround(60.0 * offset_h);
    out->time_s -= 60.0 * out->utc_offset_min;
    return 0;
}

/* What only one of the two uses takes. */
static int check_use(char *value[VALUES], const thermal_request *request)
{
    const bool has_facet =
        value[MATERIAL] || value[THICKNESS] || value[SLOPE] || value[AZIMUTH] || value[POWER];

    for (int i = OBJECTS; i <= SEED; i++)
        if (value[i] && !request->is_sensitivity)
            return command_misuse("thermal", "--%s needs --sensitivity", options[i].name);
    if (value[OBJECTS] && has_facet)
        return command_misuse("thermal", "--objects says what a facet's options say: give one");
    if (!value[MATERIAL] && !request->is_sensitivity)
        return command_misuse("thermal", "needs --material");
    if (!value[THICKNESS] && !value[OBJECTS])
        return command_misuse("thermal",
                              "needs --thickness-cm: a material has none, its facets have");
    return 0;
}

static int check_values(char *value[VALUES], thermal_request *out)
{
    const command_law_texts laws = {value[SKY_LONGWAVE], value[CONVECTION], value[DIFFUSE],
                                    value[ROUGHNESS], value[WIND_HEIGHT]};

    for (int i = 0; i < REQUIRED; i++)
        if (!value[i]) return command_misuse("thermal", "needs --%s", options[i].name);
    if (check_use(value, out)) return EXIT_USAGE;
    if (value[MODEL] && strcmp(value[MODEL], "therm") && strcmp(value[MODEL], "layered"))
        return command_misuse("thermal", "--model '%s': expected therm or layered", value[MODEL]);
    out->is_layered = value[MODEL] && !strcmp(value[MODEL], "layered");
    if (check_place(value, &out->place) || command_laws("thermal", &laws, &out->laws))
        return EXIT_USAGE;
    if (check_number(value[SLOPE], SLOPE, 0.0, 180.0, &out->slope_deg) ||
        check_number(value[AZIMUTH], AZIMUTH, -360.0, 360.0, &out->azimuth_deg) ||
        check_number(value[THICKNESS], THICKNESS, 1e-4, 1e4, &out->thickness_cm) ||
        check_number(value[POWER], POWER, 0.0, 1e6, &out->power_w_m2) ||
        check_whole(value[RUNS], RUNS, 1.0, 1e6, &out->runs) ||
        check_whole(value[SEED], SEED, 0.0, 4294967295.0, &out->seed))
        return EXIT_USAGE;
    out->materials = value[MATERIALS];
    out->material = value[MATERIAL];
    out->weather = value[WEATHER];
    out->plot = value[PLOT];
    out->objects = value[OBJECTS];
    return 0;
}

/* Returns 0, -1 where help is asked for, or the exit code of a misuse. */
static int read_arguments(int argc, char **argv, thermal_request *out)
{
    char *value[VALUES] = {0};
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, "+:", options, NULL)) != -1) {
        if (option == HELP) return -1;
        if (option == SENSITIVITY) {
            out->is_sensitivity = true;
            continue;
        }
        if (option < 0 || option >= VALUES)
            return command_misuse("thermal", "'%s' %s", argv[optind - 1],
                                  option == ':' ? "needs a value" : "is no option");
        value[option] = optarg;
    }
    if (optind < argc) return command_misuse("thermal", "'%s' is no option", argv[optind]);
    return check_values(value, out);
}

static facet_record facet_of(const thermal_request *request)
{
    const double slope = request->slope_deg * M_PI / 180.0;
    const double azimuth = request->azimuth_deg * M_PI / 180.0;

    return (facet_record){
        .normal = {(float)(sin(slope) * sin(azimuth)), (float)(sin(slope) * cos(azimuth)),
                   (float)cos(slope)},
        .slope_rad = (float)slope,
        .azimuth_rad = (float)azimuth,
        .thickness_m = (float)(0.01 * request->thickness_cm),
        .power_w_m2 = (float)request->power_w_m2,
    };
}

static status compute(const facet_record *facet, const thermal_matter *matter, const weather *w,
                      const site *place, float *out_temperature_k)
{
    status rc = STATUS_OK;
    device *dev = NULL;
    thermal *t = NULL;

    TRY(device_open(&dev, -1));
    TRY(thermal_open(&t, dev, matter, w, place));
    TRY(thermal_histories(t, facet, 1, out_temperature_k));
out:
    thermal_free(t);
    device_free(dev);
    return rc;
}

static status plot(const thermal_request *request, const weather *w, const float *temperature_k)
{
    status rc = STATUS_OK;
    double *values = malloc(3 * w->count * sizeof *values);
    double *time_h = values, *surface_c = values + w->count, *air_c = values + 2 * w->count;
    const curve_line lines[] = {{"air", air_c, {120, 120, 120}},
                                {request->material, surface_c, {200, 60, 20}}};
    const curve c = {.title = request->material,
                     .unit = "C",
                     .x_unit = "h",
                     .x = time_h,
                     .count = w->count,
                     .line = lines,
                     .line_count = 2};

    NEED(values, STATUS_MEMORY, "no memory to draw %zu temperatures", w->count);
    for (size_t i = 0; i < w->count; i++) {
        time_h[i] = w->record[i].time_h;
        surface_c[i] = (double)temperature_k[i] - (double)ZERO_CELSIUS_K;
        air_c[i] = w->record[i].air_temperature_k - (double)ZERO_CELSIUS_K;
    }
    TRY(curve_write(request->plot, &c));
out:
    free(values);
    return rc;
}

static status run(const thermal_request *request)
{
    status rc = STATUS_OK;
    material_library *library = NULL;
    weather *w = NULL;
    float *temperature_k = NULL;
    const facet_record facet = facet_of(request);
    const layered_matter layered = layered_matter_default();
    material_record record;
    const thermal_matter matter = {&record, request->is_layered ? &layered : NULL, NULL, 1,
                                   request->laws};

    if (request->plot) TRY(picture_prepare());
    TRY(material_library_read(&library, request->materials));
    const material *named = material_by_name(library, request->material);
    NEED(named, STATUS_ARGUMENT, "%s: has no material '%s'", request->materials, request->material);
    record = command_material_record(named);
    TRY(weather_history_read(&w, request->weather, &request->place));
    weather_place_check_day(w, &request->place, request->weather);
    temperature_k = malloc(w->count * sizeof *temperature_k);
    NEED(temperature_k, STATUS_MEMORY, "no memory for %zu temperatures", w->count);
    TRY(compute(&facet, &matter, w, &request->place, temperature_k));
    if (request->plot) TRY(plot(request, w, temperature_k));
    puts("time_h,temperature_c");
    for (size_t i = 0; i < w->count; i++)
        printf("%.4f,%.4f\n", w->record[i].time_h,
               (double)temperature_k[i] - (double)ZERO_CELSIUS_K);
out:
    free(temperature_k);
    weather_free(w);
    material_library_free(library);
    return rc;
}

static status run_sensitivity(const thermal_request *r)
{
    const sensitivity_request request = {.materials = r->materials,
                                         .weather = r->weather,
                                         .material = r->material,
                                         .objects = r->objects,
                                         .plot = r->plot,
                                         .facet = facet_of(r),
                                         .place = r->place,
                                         .laws = r->laws,
                                         .is_layered = r->is_layered,
                                         .runs = (uint32_t)r->runs,
                                         .seed = (uint32_t)r->seed};

    return command_sensitivity(&request);
}

int command_thermal(int argc, char **argv)
{
    thermal_request request = {.runs = 100.0, .seed = 1.0};
    const int misuse = read_arguments(argc, argv, &request);

    if (misuse < 0) fputs(help, stdout);
    if (misuse) return misuse < 0 ? 0 : misuse;
    return command_end("thermal",
                       request.is_sensitivity ? run_sensitivity(&request) : run(&request));
}
