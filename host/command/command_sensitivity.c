#include "command/command_sensitivity.h"

#include "base/number.h"
#include "files/csv_row.h"
#include "files/heading.h"
#include "files/record_file.h"
#include "image/curve.h"
#include "image/picture.h"
#include "station/weather_history.h"
#include "thermal/sensitivity.h"
#include "weather/weather_place.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

static const char objects_header[] = "material,thickness_cm,slope_deg,azimuth_deg,power_w_m2";

enum { OBJECT_NUMBERS = 4, LINES = 5 };

typedef struct object_list {
    sensitivity_object *object;
    size_t count;
} object_list;

material_record command_material_record(const material *m)
{
    return (material_record){
        .density_kg_m3 = (float)m->density_kg_m3,
        .specific_heat_j_kg_k = (float)m->specific_heat_j_kg_k,
        .conductivity_w_m_k = (float)m->conductivity_w_m_k,
        .solar_absorptance = (float)m->solar_absorptance,
        .thermal_emissivity = (float)m->thermal_emissivity,
        .exposed_area = (float)m->exposed_area,
    };
}

status command_refuse_material(const material_library *library, const char *path, const char *name)
{
    spelling near = spelling_of(name);
    char hint[SPELLING_HINT_SIZE];

    material_offer_names(library, &near);
    return status_set(STATUS_ARGUMENT, "%s: unknown material '%s'%s", path, name,
                      spelling_hint(&near, "", hint));
}

static status add_object(object_list *list, const material *m, const facet_record *facet)
{
    status rc = STATUS_OK;
    sensitivity_object *more = realloc(list->object, (list->count + 1) * sizeof *more);

    NEED(more, STATUS_MEMORY, "no memory for %zu objects", list->count + 1);
    list->object = more;
    list->object[list->count++] = (sensitivity_object){command_material_record(m), *facet};
out:
    return rc;
}

/* Takes `material,thickness_cm,slope_deg,azimuth_deg,power_w_m2`. */
static status read_object(object_list *list, csv_row *row, char separator, record_file *file,
                          const material_library *library)
{
    status rc = STATUS_OK;
    static const char expected[] = "a material's name and four numbers with commas between";
    const char *name;
    double value[OBJECT_NUMBERS];

    TRY(csv_row_take(row, file, separator, expected));
    bool is_whole = row->count == OBJECT_NUMBERS + 1;
    for (size_t i = 0; is_whole && i < OBJECT_NUMBERS; i++)
        is_whole = number_read(row->field[i + 1], &value[i]);
    if (!is_whole) TRY(record_file_reject(file, "%s", expected));
    name = row->field[0];
    const material *m = material_by_name(library, name);
    if (!m) TRY(record_file_reject(file, "a material of the list, not '%s'", name));
    if (value[0] < 1e-4 || value[0] > 1e4)
        TRY(record_file_reject(file, "a thickness from 1e-4 to 1e4 cm"));
    if (value[1] < 0.0 || value[1] > 180.0)
        TRY(record_file_reject(file, "a slope from 0 to 180 degrees"));
    if (fabs(value[2]) > 360.0)
        TRY(record_file_reject(file, "an azimuth from -360 to 360 degrees"));
    if (value[3] < 0.0 || value[3] > 1e6)
        TRY(record_file_reject(file, "a power from 0 to 1e6 W/m2"));
    facet_record facet = {.thickness_m = (float)(0.01 * value[0]),
                          .slope_rad = (float)(value[1] * M_PI / 180.0),
                          .azimuth_rad = (float)(value[2] * M_PI / 180.0),
                          .power_w_m2 = (float)value[3]};
    sensitivity_turn(&facet);
    TRY(add_object(list, m, &facet));
out:
    return rc;
}

static bool is_objects_header(const csv_row *row)
{
    static const char *const names[] = {"|material|", "|thickness_cm|", "|slope_deg|",
                                        "|azimuth_deg|", "|power_w_m2|"};

    for (size_t i = 0; i < OBJECT_NUMBERS + 1; i++)
        if (!heading_is_named(csv_row_field(row, i), names[i])) return false;
    return row->count == OBJECT_NUMBERS + 1;
}

static status read_objects(object_list *list, const char *path, const material_library *library)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    csv_row row = {0};
    char separator;

    TRY(record_file_open(&file, path));
    TRY(csv_row_names(&row, file, &separator, objects_header));
    if (!is_objects_header(&row)) TRY(record_file_reject(file, "the header %s", objects_header));
    while (!record_file_at_end(file)) TRY(read_object(list, &row, separator, file, library));
    if (list->count == 0) TRY(record_file_reject(file, "objects behind the header"));
out:
    csv_row_free(&row);
    record_file_free(file);
    return rc;
}

static status list_objects(object_list *list, const sensitivity_request *request,
                           const material_library *library)
{
    status rc = STATUS_OK;

    if (request->objects) return read_objects(list, request->objects, library);
    for (int i = 0; i < library->count; i++) {
        const material *m = &library->items[i];
        if (request->material && strcmp(request->material, m->name)) continue;
        TRY(add_object(list, m, &request->facet));
    }
    if (list->count == 0)
        TRY(command_refuse_material(library, request->materials,
                                    request->material ? request->material : ""));
out:
    return rc;
}

static void print_row(const char *name, const sensitivity_row *row)
{
    if (row->input)
        printf("%s,%g,%s,", name, row->error, row->unit);
    else
        printf("%s,,,", name);
    printf("%.4f,%.4f,%.4f,%.3f\n", row->rmse_c, row->sigma_c, row->thesis_c,
           row->rmse_c / row->thesis_c);
}

static void print_table(const sensitivity *s, const sensitivity_request *request, size_t objects)
{
    const int of_objects = SENSITIVITY_INPUTS - SENSITIVITY_WEATHER;
    const sensitivity_row sums[] = {
        sensitivity_sum(s, 0, SENSITIVITY_WEATHER, SENSITIVITY_INPUTS),
        sensitivity_sum(s, SENSITIVITY_WEATHER, of_objects, SENSITIVITY_POWER),
        sensitivity_sum(s, SENSITIVITY_WEATHER, of_objects, SENSITIVITY_INPUTS)};
    int alike = 0;

    printf("# %zu objects, %u runs of each input, seed %u\n", objects, request->runs,
           request->seed);
    puts("input,error,unit,rmse_c,sigma_c,thesis_rmse_c,ratio");
    for (int i = 0; i < SENSITIVITY_INPUTS; i++) {
        const double ratio = s->row[i].rmse_c / s->row[i].thesis_c;
        print_row(s->row[i].input, &s->row[i]);
        alike += ratio >= 0.5 && ratio <= 2.0;
    }
    print_row("root sum of squares: weather", &sums[0]);
    print_row("root sum of squares: passive object", &sums[1]);
    print_row("root sum of squares: active object", &sums[2]);
    printf("# within a factor of 2 of the thesis: %d of %d\n", alike, SENSITIVITY_INPUTS);
}

/* The inputs that matter most, the strongest first. */
static void find_strongest(const sensitivity *s, int out[LINES - 1])
{
    bool taken[SENSITIVITY_INPUTS] = {false};

    for (int k = 0; k < LINES - 1; k++) {
        int best = -1;
        for (int i = 0; i < SENSITIVITY_INPUTS; i++)
            if (!taken[i] && (best < 0 || s->row[i].sigma_c > s->row[best].sigma_c)) best = i;
        taken[best] = true;
        out[k] = best;
    }
}

static status plot(const sensitivity *s, const weather *w, const char *path)
{
    status rc = STATUS_OK;
    static const uint8_t colours[LINES][3] = {
        {0, 0, 0}, {200, 60, 20}, {30, 90, 200}, {30, 140, 60}, {150, 60, 160}};
    double *values = malloc(2 * w->count * sizeof *values), *all_c = values + w->count;
    int strongest[LINES - 1];
    curve_line line[LINES];

    NEED(values, STATUS_MEMORY, "no memory to draw %zu steps", w->count);
    for (size_t i = 0; i < w->count; i++) {
        double squares = 0.0;
        for (int k = 0; k < SENSITIVITY_INPUTS; k++)
            squares += s->row[k].at_step_c[i] * s->row[k].at_step_c[i];
        values[i] = w->record[i].time_h;
        all_c[i] = sqrt(squares);
    }
    find_strongest(s, strongest);
    line[0] = (curve_line){.name = "all", .value = all_c};
    for (int k = 1; k < LINES; k++)
        line[k] = (curve_line){.name = s->row[strongest[k - 1]].input,
                               .value = s->row[strongest[k - 1]].at_step_c};
    for (int k = 0; k < LINES; k++) memcpy(line[k].rgb, colours[k], sizeof colours[k]);
    const curve c = {.title = "standard deviation of temperature",
                     .unit = "C",
                     .x_unit = "h",
                     .x = values,
                     .count = w->count,
                     .line = line,
                     .line_count = LINES};
    TRY(curve_write(path, &c));
out:
    free(values);
    return rc;
}

status command_sensitivity(const sensitivity_request *request)
{
    status rc = STATUS_OK;
    material_library *library = NULL;
    object_list list = {0};
    weather *w = NULL;
    device *dev = NULL;
    sensitivity result = {0};

    if (request->plot) TRY(picture_prepare());
    TRY(material_library_read(&library, request->materials));
    TRY(list_objects(&list, request, library));
    TRY(weather_history_read(&w, request->weather, &request->place));
    weather_place_check_day(w, &request->place, request->weather);
    TRY(device_open(&dev, -1));
    const sensitivity_study study = {.object = list.object,
                                     .count = list.count,
                                     .is_layered = request->is_layered,
                                     .laws = request->laws,
                                     .history = w,
                                     .place = request->place,
                                     .runs = request->runs,
                                     .seed = request->seed};
    TRY(sensitivity_run(&result, dev, &study));
    if (request->plot) TRY(plot(&result, w, request->plot));
    print_table(&result, request, list.count);
out:
    sensitivity_free(&result);
    device_free(dev);
    weather_free(w);
    free(list.object);
    material_library_free(library);
    return rc;
}
