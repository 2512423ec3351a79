#include "base/number.h"
#include "command/command.h"
#include "command/command_validate_scene.h"
#include "command/command_value.h"
#include "files/file_name.h"
#include "files/output_file.h"
#include "image/curve.h"
#include "image/picture.h"
#include "kernels/constants.h"
#include "station/dated_table.h"
#include "station/measured_table.h"
#include "thermal/thermal.h"
#include "thermal/value_check.h"
#include "weather/weather_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char command[] = "radsig validate";

static const char purpose[] =
    "Takes a level surface through measured weather and compares its temperature with the\n"
    "measured one over the last full day: prints rmse_c, bias_c (predicted less measured),\n"
    "peak_lag_min. The table needs surface_temperature, or longwave_up and longwave_down.\n"
    "\n"
    "radsig validate thermal SCENE.toml FILE.csv does it for the facets of a scene, with any\n"
    "weather, over several days: see radsig validate thermal SCENE.toml --help.\n";

typedef struct validation {
    const char *table, *output, *plot;
    command_day day;
    site place;
    double solar_absorptance, thermal_emissivity, thickness_cm, conductivity_w_m_k, capacity_j_m3_k;
    facet_record facet;
    material_record material;
    layered_matter layered;
    int back, model; /* of the words of the options */
    command_laws laws;
} validation;

enum { MODEL_LAYERED, MODEL_THERM };

static status read_resistance(const option *o, const char *text)
{
    status rc = STATUS_OK;
    layered_matter *l = o->out;
    double value[2];

    NEED(number_read_list(text, 2, value) && fmin(value[0], value[1]) >= 0.0 &&
             fmax(value[0], value[1]) <= LAYERED_RESISTANCE_MOST_S_M,
         STATUS_ARGUMENT, "found '%s', expected DAY,NIGHT, each from 0 to %g", text,
         LAYERED_RESISTANCE_MOST_S_M);
    l->resistance_day_s_m = value[0];
    l->resistance_night_s_m = value[1];
out:
    return rc;
}

static int check_use(const option_table *t, validation *out, char **argv)
{
    static const layered_back back[] = {LAYERED_BACK_ADIABATIC, LAYERED_BACK_AIR,
                                        LAYERED_BACK_GROUND};

    if (strcmp(argv[1], "thermal"))
        return program_misuse(command, "found '%s', expected thermal FILE.csv", argv[1]);
    if (out->model == MODEL_THERM &&
        (option_table_has(t, "surface-resistance-s-m") || option_table_has(t, "back")))
        return program_misuse(command, "--surface-resistance-s-m and --back need --model layered");
    out->table = argv[2];
    out->place = command_day_site(&out->day);
    out->layered.back = back[out->back];
    out->facet = (facet_record){.normal = {0.0f, 0.0f, 1.0f},
                                .thickness_m = .01f * (float)out->thickness_cm};
    out->material = (material_record){.solar_absorptance = (float)out->solar_absorptance,
                                      .thermal_emissivity = (float)out->thermal_emissivity,
                                      .conductivity_w_m_k = (float)out->conductivity_w_m_k,
                                      .density_kg_m3 = 1.0f,
                                      .specific_heat_j_kg_k = (float)out->capacity_j_m3_k,
                                      .exposed_area = -.5f};
    return OPTION_TABLE_DONE;
}

static int read_arguments(int argc, char **argv, validation *out)
{
    static const char *const backs[] = {"adiabatic", "air", "ground"};
    static const char *const models[] = {"layered", "therm"};
    option list[] = {
        command_site_option(&out->day.place),
        command_date_option(&out->day),
        command_offset_option(&out->day),
        {"solar-absorptance", 0, "A", "of the surface", .number = &out->solar_absorptance,
         .low = 0.0, .high = 1.0, .is_required = true},
        {"thermal-emissivity", 0, "E", "of the surface", .number = &out->thermal_emissivity,
         .low = 0.1, .high = 1.0, .is_required = true},
        {"thickness-cm", 0, "X", "of the matter", .number = &out->thickness_cm, .low = 1e-4,
         .high = 1e4, .is_required = true},
        {"conductivity-w-m-k", 0, "K", "of the matter", .number = &out->conductivity_w_m_k,
         .low = 1e-3, .high = 5e3, .is_required = true},
        {"heat-capacity-j-m3-k", 0, "C", "of the matter", .number = &out->capacity_j_m3_k,
         .low = 1e3, .high = 1e7, .is_required = true},
        {"surface-resistance-s-m", 0, "DAY,NIGHT", "to evaporation; without it the surface is dry",
         .out = &out->layered, .read = read_resistance},
        {"back", 0, "BACK",
         "behind the thickness: adiabatic (the default), air, or ground: the mean air temperature "
         "1 m below the surface",
         .index = &out->back, .word = backs, .word_count = 3},
        {"model", 0, "MODEL", "layered (the default) or therm", .index = &out->model,
         .word = models, .word_count = 2},
        command_sky_option(&out->laws),
        command_convection_option(&out->laws),
        command_roughness_option(&out->laws),
        command_wind_height_option(&out->laws),
        {"output", 'o', "FILE.csv", "write time_h,measured_c,predicted_c", .text = &out->output},
        {"plot", 0, "FILE.png", "draw both", .text = &out->plot}};
    const option_table table = {command, "thermal FILE.csv",        2, 2, purpose,
                                list,    sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    return code == OPTION_TABLE_DONE ? check_use(&table, out, argv) : code;
}

static bool has_longwave(const weather *w)
{
    for (size_t i = 0; i < w->count; i++)
        if (w->record[i].longwave_w_m2 > 0.0) return true;
    return false;
}

static status set_measured(weather_table *t, const validation *v)
{
    status rc = STATUS_OK;
    const weather *w = t->history;

    if (t->surface_k) return STATUS_OK;
    NEED(t->longwave_up_w_m2 && has_longwave(w), STATUS_FORMAT,
         "%s: has neither surface_temperature nor longwave_up and longwave_down", v->table);
    t->surface_k = malloc(w->count * sizeof *t->surface_k);
    NEED(t->surface_k, STATUS_MEMORY, "no memory for %zu temperatures", w->count);
    for (size_t i = 0; i < w->count; i++) {
        t->surface_k[i] = NAN;
        if (isnan(t->longwave_up_w_m2[i]) || !(w->record[i].longwave_w_m2 > 0.0)) continue;
        t->surface_k[i] =
            measured_table_radiating_k(t->longwave_up_w_m2[i], w->record[i].longwave_w_m2,
                                       (double)v->material.thermal_emissivity);
        NEED(value_check_kelvin((float)t->surface_k[i]), STATUS_FORMAT,
             "%s: record %zu: longwave_up of %g and longwave_down of %g W/m2 make a surface of %g "
             "K, expected %s",
             v->table, i + 1, t->longwave_up_w_m2[i], w->record[i].longwave_w_m2, t->surface_k[i],
             VALUE_CHECK_RANGE);
    }
out:
    return rc;
}

static status predict(const validation *v, const weather *w, float *out_k)
{
    status rc = STATUS_OK;
    const bool is_layered = v->model == MODEL_LAYERED;
    const thermal_matter matter = {&v->material, is_layered ? &v->layered : NULL, NULL, 1,
                                   command_laws_of(&v->laws)};
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

/* Compares from the last full day on, where there are measurements. */
static status print_difference(const weather_table *t, const float *predicted_k, const char *path)
{
    status rc = STATUS_OK;
    const weather *w = t->history;
    const double start_h = weather_day_start_h(w) - 1e-6;
    size_t count = 0, peak = 0, measured_peak = 0;
    double sum = 0.0, squares = 0.0;

    for (size_t i = 0; i < w->count; i++) {
        const double difference = (double)predicted_k[i] - t->surface_k[i];
        if (w->record[i].time_h < start_h || isnan(difference)) continue;
        if (count++ == 0) peak = measured_peak = i;
        if (predicted_k[i] > predicted_k[peak]) peak = i;
        if (t->surface_k[i] > t->surface_k[measured_peak]) measured_peak = i;
        sum += difference;
        squares += difference * difference;
    }
    NEED(count > 0, STATUS_FORMAT, "%s: no measured temperature on the last full day", path);
    printf("rmse_c %.3f\nbias_c %.3f\npeak_lag_min %.0f\n", sqrt(squares / (double)count),
           sum / (double)count, 60.0 * (w->record[peak].time_h - w->record[measured_peak].time_h));
out:
    return rc;
}

static status write_rows(const char *path, const weather_table *t, const float *predicted_k)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    fputs("time_h,measured_c,predicted_c\n", output_file_stream(file));
    for (size_t i = 0; i < t->history->count; i++) {
        if (isnan(t->surface_k[i])) continue;
        fprintf(output_file_stream(file), "%.4f,%.4f,%.4f\n", t->history->record[i].time_h,
                t->surface_k[i] - (double)ZERO_CELSIUS_K,
                (double)predicted_k[i] - (double)ZERO_CELSIUS_K);
    }
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

/* Weather with dates goes with a scene, which tells its place and surfaces. */
static status check_kind(const char *path)
{
    status rc = STATUS_OK;
    bool has_dates = !file_name_ends(path, ".csv");

    if (!has_dates) TRY(dated_table_is(&has_dates, path));
    NEED(!has_dates, STATUS_FORMAT,
         "%s: expected a .csv with hours; other weather is a scene's: radsig validate thermal "
         "SCENE.toml FILE",
         path);
out:
    return rc;
}

static status run(const validation *v)
{
    status rc = STATUS_OK;
    weather_table t = {0};
    float *predicted_k = NULL;

    if (v->plot) TRY(picture_prepare());
    TRY(check_kind(v->table));
    TRY(weather_table_read(&t, v->table));
    TRY(set_measured(&t, v));
    predicted_k = malloc(t.history->count * sizeof *predicted_k);
    NEED(predicted_k, STATUS_MEMORY, "no memory for %zu temperatures", t.history->count);
    TRY(predict(v, t.history, predicted_k));
    if (v->output) TRY(write_rows(v->output, &t, predicted_k));
    if (v->plot) TRY(plot(v->plot, &t, predicted_k));
    TRY(print_difference(&t, predicted_k, v->table));
out:
    free(predicted_k);
    weather_table_free(&t);
    return rc;
}

int command_validate(int argc, char **argv)
{
    if (argc > 2 && file_name_ends(argv[2], ".toml")) return command_validate_scene(argc, argv);
    validation v = {.layered = layered_matter_default(), .laws.convection = -1};
    const int code = read_arguments(argc, argv, &v);

    return code == OPTION_TABLE_DONE ? program_end(command, run(&v)) : code;
}
