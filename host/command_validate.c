#include "command.h"
#include "command_value.h"
#include "constants.h"
#include "curve.h"
#include "output_file.h"
#include "picture.h"
#include "thermal.h"
#include "weather_table.h"

#include <getopt.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char help[] =
    "usage: radsig validate thermal FILE.csv --site LAT,LON --date YYYY-MM-DD --utc-offset H\n"
    "           --solar-absorptance A --thermal-emissivity E --thickness-cm X\n"
    "           --conductivity-w-m-k K --heat-capacity-j-m3-k C\n"
    "           [--surface-resistance-s-m DAY,NIGHT --back adiabatic|air|ground --model "
    "layered|therm\n"
    "            --sky-longwave LAW --convection LAW --roughness-length-m X --wind-height-m X\n"
    "            -o FILE.csv --plot FILE.png]\n"
    "\n"
    "Takes a level surface through measured weather and compares its temperature with the "
    "measured\n"
    "one over the last full day: prints rmse_c, bias_c (predicted less measured), peak_lag_min.\n"
    "The table needs surface_temperature, or longwave_up and longwave_down.\n"
    "\n"
    "  --surface-resistance-s-m   to evaporation; without it the surface is dry\n"
    "  --back                     behind the thickness (default adiabatic); ground: the mean air\n"
    "                             temperature 1 m below the surface\n"
    "  --sky-longwave             where none was measured: brunt (the default), berdahl-martin or\n"
    "                             brutsaert\n"
    "  --convection               therm, mcadams, tarp or similarity; by default the model's own\n"
    "  --roughness-length-m, --wind-height-m   of similarity (default .001 and 10)\n"
    "  -o                         writes time_h,measured_c,predicted_c\n"
    "  --plot                     draws both\n";

typedef struct validation {
    const char *table, *output, *plot;
    site place;
    facet_record facet;
    material_record material;
    layered_matter layered;
    bool is_layered;
    forcing_laws laws;
} validation;

enum {
    SITE,
    DATE,
    OFFSET,
    ABSORPTANCE,
    EMISSIVITY,
    THICKNESS,
    CONDUCTIVITY,
    CAPACITY,
    RESISTANCE,
    BACK,
    MODEL,
    SKY_LONGWAVE,
    CONVECTION,
    ROUGHNESS,
    WIND_HEIGHT,
    OUTPUT,
    PLOT
};
enum { VALUES = PLOT + 1, HELP = VALUES, REQUIRED = RESISTANCE };

static const struct option options[] = {
    [SITE] = {"site", 1, NULL, SITE},
    [DATE] = {"date", 1, NULL, DATE},
    [OFFSET] = {"utc-offset", 1, NULL, OFFSET},
    [ABSORPTANCE] = {"solar-absorptance", 1, NULL, ABSORPTANCE},
    [EMISSIVITY] = {"thermal-emissivity", 1, NULL, EMISSIVITY},
    [THICKNESS] = {"thickness-cm", 1, NULL, THICKNESS},
    [CONDUCTIVITY] = {"conductivity-w-m-k", 1, NULL, CONDUCTIVITY},
    [CAPACITY] = {"heat-capacity-j-m3-k", 1, NULL, CAPACITY},
    [RESISTANCE] = {"surface-resistance-s-m", 1, NULL, RESISTANCE},
    [BACK] = {"back", 1, NULL, BACK},
    [MODEL] = {"model", 1, NULL, MODEL},
    [SKY_LONGWAVE] = {"sky-longwave", 1, NULL, SKY_LONGWAVE},
    [CONVECTION] = {"convection", 1, NULL, CONVECTION},
    [ROUGHNESS] = {"roughness-length-m", 1, NULL, ROUGHNESS},
    [WIND_HEIGHT] = {"wind-height-m", 1, NULL, WIND_HEIGHT},
    [OUTPUT] = {"output", 1, NULL, OUTPUT},
    [PLOT] = {"plot", 1, NULL, PLOT},
    [HELP] = {"help", 0, NULL, HELP},
    {0}};

static int take_number(char *value[VALUES], int option, double low, double high, float *out)
{
    double number = 0.0;

    if (!command_number(value[option], low, high, &number))
        return command_misuse("validate", "--%s '%s': expected a number from %g to %g",
                              options[option].name, value[option], low, high);
    *out = (float)number;
    return 0;
}

static int take_place(char *value[VALUES], site *out)
{
    char midnight[64];
    double offset_h = 0.0;
    int unused;

    if (!command_place(value[SITE], &out->latitude_deg, &out->longitude_deg))
        return command_misuse("validate", "--site '%s': expected LAT,LON in degrees", value[SITE]);
    if (!command_number(value[OFFSET], -14.0, 14.0, &offset_h))
        return command_misuse("validate", "--utc-offset '%s': expected hours", value[OFFSET]);
    snprintf(midnight, sizeof midnight, "%.40sT00:00:00Z", value[DATE]);
    if (site_parse_time(midnight, &out->time_s, &unused) != STATUS_OK)
        return command_misuse("validate", "--date '%s': expected YYYY-MM-DD", value[DATE]);
    out->utc_offset_min = (int)lround(60.0 * offset_h);
    out->time_s -= 60.0 * out->utc_offset_min;
    return 0;
}

static int take_layered(char *value[VALUES], validation *out)
{
    static const char *const backs[] = {"adiabatic", "air", "ground"};
    static const layered_back back[] = {LAYERED_BACK_ADIABATIC, LAYERED_BACK_AIR,
                                        LAYERED_BACK_GROUND};
    layered_matter *l = &out->layered;
    int which = 0;

    *l = layered_matter_default();
    if (value[RESISTANCE] && (sscanf(value[RESISTANCE], "%lf,%lf", &l->resistance_day_s_m,
                                     &l->resistance_night_s_m) != 2 ||
                              !(l->resistance_day_s_m >= 0.0) || !(l->resistance_night_s_m >= 0.0)))
        return command_misuse("validate", "--surface-resistance-s-m '%s': expected DAY,NIGHT",
                              value[RESISTANCE]);
    while (value[BACK] && which < 3 && strcmp(value[BACK], backs[which])) which++;
    if (which == 3)
        return command_misuse("validate", "--back '%s': expected adiabatic, air or ground",
                              value[BACK]);
    l->back = back[which];
    out->is_layered = !value[MODEL] || !strcmp(value[MODEL], "layered");
    if (!out->is_layered && strcmp(value[MODEL], "therm"))
        return command_misuse("validate", "--model '%s': expected layered or therm", value[MODEL]);
    if (!out->is_layered && (value[RESISTANCE] || value[BACK]))
        return command_misuse("validate",
                              "--surface-resistance-s-m and --back need --model layered");
    return 0;
}

static int take_values(char *value[VALUES], validation *out)
{
    const command_law_texts laws = {value[SKY_LONGWAVE], value[CONVECTION], NULL, value[ROUGHNESS],
                                    value[WIND_HEIGHT]};
    float thickness_cm = 0.0f, capacity = 0.0f;

    for (int i = 0; i < REQUIRED; i++)
        if (!value[i]) return command_misuse("validate", "needs --%s", options[i].name);
    if (take_place(value, &out->place) || take_layered(value, out) ||
        command_laws("validate", &laws, &out->laws) ||
        take_number(value, ABSORPTANCE, 0.0, 1.0, &out->material.solar_absorptance) ||
        take_number(value, EMISSIVITY, 0.1, 1.0, &out->material.thermal_emissivity) ||
        take_number(value, THICKNESS, 1e-4, 1e4, &thickness_cm) ||
        take_number(value, CONDUCTIVITY, 1e-3, 5e3, &out->material.conductivity_w_m_k) ||
        take_number(value, CAPACITY, 1e3, 1e7, &capacity))
        return EXIT_USAGE;
    out->facet = (facet_record){.normal = {0.0f, 0.0f, 1.0f}, .thickness_m = .01f * thickness_cm};
    out->material.density_kg_m3 = 1.0f;
    out->material.specific_heat_j_kg_k = capacity;
    out->material.exposed_area = -.5f;
    out->output = value[OUTPUT];
    out->plot = value[PLOT];
    return 0;
}

/* Returns 0, -1 where help is asked for, or the exit code of a misuse. */
static int read_arguments(int argc, char **argv, validation *out)
{
    char *value[VALUES] = {0};
    int option;

    opterr = 0;
    while ((option = getopt_long(argc, argv, ":o:", options, NULL)) != -1) {
        if (option == HELP) return -1;
        if (option == 'o') option = OUTPUT;
        if (option < 0 || option >= VALUES)
            return command_misuse("validate", "'%s' %s", argv[optind - 1],
                                  option == ':' ? "needs a value" : "is no option");
        value[option] = optarg;
    }
    if (argc - optind != 2 || strcmp(argv[optind], "thermal"))
        return command_misuse("validate", "expected: validate thermal FILE.csv");
    out->table = argv[optind + 1];
    return take_values(value, out);
}

/* Temperature of a grey surface from what it emits and reflects. */
static double radiating_k(double up_w_m2, double down_w_m2, double emissivity)
{
    const double emitted_w_m2 = up_w_m2 - (1.0 - emissivity) * down_w_m2;

    return pow(fmax(0.0, emitted_w_m2) / (emissivity * (double)STEFAN_BOLTZMANN), 0.25);
}

static status set_measured(weather_table *t, const validation *v)
{
    status rc = STATUS_OK;
    const weather *w = t->history;

    if (t->surface_k) return STATUS_OK;
    NEED(t->longwave_up_w_m2 && w->record[0].longwave_w_m2 > 0.0, STATUS_FORMAT,
         "%s: has neither surface_temperature nor longwave_up and longwave_down", v->table);
    t->surface_k = malloc(w->count * sizeof *t->surface_k);
    NEED(t->surface_k, STATUS_MEMORY, "no memory for %zu temperatures", w->count);
    for (size_t i = 0; i < w->count; i++)
        t->surface_k[i] = radiating_k(t->longwave_up_w_m2[i], w->record[i].longwave_w_m2,
                                      (double)v->material.thermal_emissivity);
out:
    return rc;
}

static status predict(const validation *v, const weather *w, float *out_k)
{
    status rc = STATUS_OK;
    const thermal_matter matter = {&v->material, v->is_layered ? &v->layered : NULL, NULL, 1,
                                   v->laws};
    device *dev = NULL;
    thermal *t = NULL;

    TRY(device_open(&dev, -1));
    TRY(thermal_open(&t, dev, &matter, w, &v->place));
    TRY(thermal_histories(t, &v->facet, 1, out_k));
out:
    thermal_free(t);
    device_free(dev);
    return rc;
}

/* Compares from the last full day on. */
static void print_difference(const weather_table *t, const float *predicted_k)
{
    const weather *w = t->history;
    const double start_h = weather_day_start_h(w) - 1e-6;
    size_t count = 0, peak = 0, measured_peak = 0;
    double sum = 0.0, squares = 0.0;

    for (size_t i = 0; i < w->count; i++) {
        const double difference = (double)predicted_k[i] - t->surface_k[i];
        if (w->record[i].time_h < start_h) continue;
        if (count++ == 0) peak = measured_peak = i;
        if (predicted_k[i] > predicted_k[peak]) peak = i;
        if (t->surface_k[i] > t->surface_k[measured_peak]) measured_peak = i;
        sum += difference;
        squares += difference * difference;
    }
    printf("rmse_c %.3f\nbias_c %.3f\npeak_lag_min %.0f\n", sqrt(squares / (double)count),
           sum / (double)count, 60.0 * (w->record[peak].time_h - w->record[measured_peak].time_h));
}

static status write_rows(const char *path, const weather_table *t, const float *predicted_k)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    fputs("time_h,measured_c,predicted_c\n", output_file_stream(file));
    for (size_t i = 0; i < t->history->count; i++)
        fprintf(output_file_stream(file), "%.4f,%.4f,%.4f\n", t->history->record[i].time_h,
                t->surface_k[i] - (double)ZERO_CELSIUS_K,
                (double)predicted_k[i] - (double)ZERO_CELSIUS_K);
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

static status plot(const char *path, const weather_table *t, const float *predicted_k)
{
    status rc = STATUS_OK;
    const size_t count = t->history->count;
    double *values = malloc(3 * count * sizeof *values);
    double *time_h = values, *measured_c = values + count, *predicted_c = values + 2 * count;
    const curve_line lines[] = {{"measured", measured_c, {120, 120, 120}},
                                {"predicted", predicted_c, {200, 60, 20}}};
    const curve c = {.title = "surface temperature",
                     .unit = "C",
                     .x_unit = "h",
                     .x = time_h,
                     .count = count,
                     .line = lines,
                     .line_count = 2};

    NEED(values, STATUS_MEMORY, "no memory to draw %zu temperatures", count);
    for (size_t i = 0; i < count; i++) {
        time_h[i] = t->history->record[i].time_h;
        measured_c[i] = t->surface_k[i] - (double)ZERO_CELSIUS_K;
        predicted_c[i] = (double)predicted_k[i] - (double)ZERO_CELSIUS_K;
    }
    TRY(curve_write(path, &c));
out:
    free(values);
    return rc;
}

static status run(const validation *v)
{
    status rc = STATUS_OK;
    weather_table t = {0};
    float *predicted_k = NULL;

    if (v->plot) TRY(picture_prepare());
    TRY(weather_table_read(&t, v->table));
    TRY(set_measured(&t, v));
    predicted_k = malloc(t.history->count * sizeof *predicted_k);
    NEED(predicted_k, STATUS_MEMORY, "no memory for %zu temperatures", t.history->count);
    TRY(predict(v, t.history, predicted_k));
    if (v->output) TRY(write_rows(v->output, &t, predicted_k));
    if (v->plot) TRY(plot(v->plot, &t, predicted_k));
    print_difference(&t, predicted_k);
out:
    free(predicted_k);
    weather_table_free(&t);
    return rc;
}

int command_validate(int argc, char **argv)
{
    validation v = {0};
    const int misuse = read_arguments(argc, argv, &v);

    if (misuse < 0) fputs(help, stdout);
    if (misuse) return misuse < 0 ? 0 : misuse;
    return command_end("validate", run(&v));
}
