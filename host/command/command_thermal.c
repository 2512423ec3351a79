#include "command/command.h"
#include "command/command_sensitivity.h"
#include "command/command_value.h"
#include "files/file_name.h"
#include "image/curve.h"
#include "image/picture.h"
#include "kernels/constants.h"
#include "scene/scene.h"
#include "station/weather_history.h"
#include "thermal/thermal.h"
#include "weather/weather_place.h"

#include <math.h>
#include <stdbool.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char command[] = "radsig thermal";

static const char purpose[] =
    "Takes one facet in full sun through a weather history and prints time_h,temperature_c, a row\n"
    "per weather record.\n"
    "\n"
    "With --sensitivity one input after the other is off by its measurement error, and the table\n"
    "input,error,unit,rmse_c,sigma_c,thesis_rmse_c,ratio says what that does to the temperatures\n"
    "of the last full day, beside Tables 3.1.1-1 and 3.1.2-1 of the thesis.\n";

typedef struct thermal_request {
    const char *materials, *material, *weather;
    command_day day;
    site place;
    const char *plot, *objects;
    double slope_deg, azimuth_deg, thickness_cm, power_w_m2;
    int64_t runs, seed;
    command_laws laws;
    int model; /* of the words of --model */
    bool is_sensitivity;
} thermal_request;

enum { MODEL_LAYERED = 1 };

/* What only one of the two uses takes. */
static int check_use(const option_table *t, const thermal_request *r)
{
    static const char *const of_study[] = {"objects", "runs", "seed"};
    static const char *const of_facet[] = {"material", "thickness-cm", "slope", "azimuth",
                                           "power-w-m2"};

    for (int i = 0; i < 3; i++)
        if (option_table_has(t, of_study[i]) && !r->is_sensitivity)
            return program_misuse(command, "--%s needs --sensitivity", of_study[i]);
    for (int i = 0; i < 5; i++)
        if (r->objects && option_table_has(t, of_facet[i]))
            return program_misuse(command, "--objects and --%s exclude each other", of_facet[i]);
    if (!r->material && !r->is_sensitivity) return program_misuse(command, "needs --material NAME");
    if (!option_table_has(t, "thickness-cm") && !r->objects)
        return program_misuse(
            command, "needs --thickness-cm X: the thickness is the facet's, not the material's");
    return OPTION_TABLE_DONE;
}

static int read_arguments(int argc, char **argv, thermal_request *out)
{
    static const char *const models[] = {"therm", "layered"};
    option list[] = {
        {"materials", 0, "FILE", "the materials: a .mat, or without --sensitivity a .toml library",
         .text = &out->materials, .is_required = true},
        {"weather", 0, "FILE", "the history", .text = &out->weather, .is_required = true},
        command_site_option(&out->day.place),
        command_date_option(&out->day),
        command_offset_option(&out->day),
        {"material", 0, "NAME", "one of the list", .text = &out->material},
        {"thickness-cm", 0, "X", "of the facet", .number = &out->thickness_cm, .low = 1e-4,
         .high = 1e4},
        {"slope", 0, "D", "0 level and facing up (the default), 90 a wall",
         .number = &out->slope_deg, .low = 0.0, .high = 180.0},
        {"azimuth", 0, "D", "of the outward normal, clockwise from north (default 0)",
         .number = &out->azimuth_deg, .low = -360.0, .high = 360.0},
        {"power-w-m2", 0, "X", "self-generated (default 0)", .number = &out->power_w_m2, .low = 0.0,
         .high = 1e6},
        {"model", 0, "MODEL",
         "therm (the default), or layered: unequal nodes, McAdams' convection, air behind if "
         "abs(exposed area) is above 0.75",
         .index = &out->model, .word = models, .word_count = 2},
        command_mode_option(&out->laws),
        command_sky_option(&out->laws),
        command_convection_option(&out->laws),
        command_roughness_option(&out->laws),
        command_wind_height_option(&out->laws),
        {"diffuse", 0, "LAW", "isotropic (the default) or hay-davies", .index = &out->laws.diffuse,
         .word = forcing_diffuse_names, .word_count = FORCING_DIFFUSES},
        {"plot", 0, "FILE.png", "draw temperatures, or standard deviations", .text = &out->plot},
        {"sensitivity", 0, NULL, "study the inputs, see above", .flag = &out->is_sensitivity},
        {"objects", 0, "FILE.csv",
         "what is studied, instead of --material: a table with the header "
         "material,thickness_cm,slope_deg,azimuth_deg,power_w_m2",
         .text = &out->objects},
        {"runs", 0, "N", "of each input (default 100)", .whole = &out->runs, .low = 1, .high = 1e6},
        {"seed", 0, "N", "of the random numbers (default 1)", .whole = &out->seed, .low = 0,
         .high = UINT32_MAX}};
    const option_table table = {
        .command = command, .purpose = purpose, .list = list, .count = sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    out->place = command_day_site(&out->day);
    if (out->laws.mode < 0) out->laws.mode = out->is_sensitivity ? COMMAND_THESIS : COMMAND_EXACT;
    return code == OPTION_TABLE_DONE ? check_use(&table, out) : code;
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

/* What a material has for heat: of a .mat its record, of a .toml layers and power by the clock too. */
typedef struct heat_matter {
    material_record record;
    layered_matter layered;
    heat_schedule power;
} heat_matter;

static status read_mat(heat_matter *out, const thermal_request *request)
{
    status rc = STATUS_OK;
    material_library *library = NULL;

    TRY(material_library_read(&library, request->materials));
    const material *named = material_by_name(library, request->material);
    if (!named) TRY(command_refuse_material(library, request->materials, request->material));
    *out = (heat_matter){.record = command_material_record(named),
                         .layered = layered_matter_default()};
out:
    material_library_free(library);
    return rc;
}

static status read_toml(heat_matter *out, const thermal_request *request)
{
    status rc = STATUS_OK;
    scene *s = NULL;

    TRY(scene_read_libraries(&s, &request->materials, 1, request->material,
                             request->model == MODEL_LAYERED ? SCENE_THERMAL_LAYERED
                                                             : SCENE_THERMAL_THERM));
    NEED(s->materials[0].medium == RECORD_NONE, STATUS_ARGUMENT,
         "%s: material '%s' is transmissive", request->materials, request->material);
    *out = (heat_matter){s->materials[0].record, s->materials[0].layered, s->materials[0].power};
out:
    scene_free(s);
    return rc;
}

static status run(const thermal_request *request)
{
    status rc = STATUS_OK;
    weather *w = NULL;
    float *temperature_k = NULL;
    const facet_record facet = facet_of(request);
    heat_matter own;
    const thermal_matter matter = {&own.record,
                                   request->model == MODEL_LAYERED ? &own.layered : NULL,
                                   &own.power, 1, command_laws_of(&request->laws)};

    if (request->plot) TRY(picture_prepare());
    TRY(file_name_ends(request->materials, ".toml") ? read_toml(&own, request)
                                                    : read_mat(&own, request));
    TRY(weather_history_read(&w, request->weather, &request->place));
    weather_place_check_day(w, &request->place, request->weather);
    forcing_check(w, &matter.laws, request->weather);
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
                                         .laws = command_laws_of(&r->laws),
                                         .is_layered = r->model == MODEL_LAYERED,
                                         .runs = (uint32_t)r->runs,
                                         .seed = (uint32_t)r->seed};

    return command_sensitivity(&request);
}

int command_thermal(int argc, char **argv)
{
    thermal_request request = {.runs = 100, .seed = 1, .laws = {.convection = -1, .mode = -1}};
    const int code = read_arguments(argc, argv, &request);

    if (code != OPTION_TABLE_DONE) return code;
    return program_end(command, request.is_sensitivity ? run_sensitivity(&request) : run(&request));
}
