#include "command/command_validate_scene.h"

#include "base/interrupt.h"
#include "base/spelling.h"
#include "command/command_scene.h"
#include "files/file_name.h"
#include "files/output_file.h"
#include "kernels/constants.h"
#include "options/program.h"
#include "render/facet_course.h"
#include "station/measured_table.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define STEP_S 900.0
#define DAY_S 86400.0

static const char command[] = "radsig validate";

static const char purpose[] =
    "Takes the facets of a scene through its weather and compares their temperatures with those\n"
    "that were measured, on one day or several. A column of FILE.csv, as roof [C], names an\n"
    "object, a part or a material, whose mean over the area is taken. Prints for each column\n"
    "name,count,rmse_c,bias_c,peak_lag_min: predicted less measured, the lag in the mean of "
    "days.\n"
    "SURFRAD days, FILE.dat, hold the longwave from the ground, which --facets names.\n";

enum { STEPS = 97 /* of a day, both midnights */ };

typedef struct validation {
    const char *scene, *measured, *output, *facets;
    command_settings settings;
    measured_table table;
    double *predicted_k; /* shape (rows, columns) */
    device *dev;
    int utc_offset_min;
} validation;

/* Temperatures of the columns at the steps of a day. */
typedef struct day {
    scene *s;
    facet_course *course;
    double midnight_s;
    float *facet_k; /* shape (facet_count) */
    double *step_k; /* shape (STEPS, columns); not-a-number: not computed yet */
} day;

static bool is_named(const scene *s, uint32_t facet, const char *name)
{
    const geometry *g = s->shape;
    const uint32_t part = g->part[facet];

    return !strcmp(g->object_name[g->part_object[part]], name) ||
           !strcmp(g->part_name[part], name) ||
           !strcmp(s->materials[s->material_of[g->material[facet]]].name, name);
}

static status check_name(const scene *s, const char *name, const char *path)
{
    status rc = STATUS_OK;
    const geometry *g = s->shape;
    char hint[SPELLING_HINT_SIZE];
    spelling near = spelling_of(name);

    for (uint32_t i = 0; i < g->facet_count; i++)
        if (is_named(s, i, name) && g->area_m2[i] > 0.0f) return STATUS_OK;
    for (uint32_t i = 0; i < g->object_count; i++) spelling_offer(&near, g->object_name[i]);
    for (uint32_t i = 0; i < g->part_count; i++) spelling_offer(&near, g->part_name[i]);
    for (uint32_t i = 0; i < s->material_count; i++) spelling_offer(&near, s->materials[i].name);
    TRY(status_set(STATUS_FORMAT, "%s: the scene has no object, part or material '%s'%s", path,
                   name, spelling_hint(&near, "", hint)));
out:
    return rc;
}

static double emissivity_of(const scene *s, uint32_t facet)
{
    const uint32_t material = s->material_of[s->shape->material[facet]];

    return (double)s->materials[material].record.thermal_emissivity;
}

/* The mean over the area of what a column names, of temperatures or, NULL, emissivities. */
static double mean_of(const scene *s, const char *name, const float *facet_k)
{
    double sum = 0.0, area = 0.0;

    for (uint32_t i = 0; i < s->shape->facet_count; i++) {
        const double here = (double)s->shape->area_m2[i];
        if (!(here > 0.0) || !is_named(s, i, name)) continue;
        sum += here * (facet_k ? (double)facet_k[i] : emissivity_of(s, i));
        area += here;
    }
    return sum / area;
}

static status day_open(day *d, validation *v, double time_s)
{
    status rc = STATUS_OK;
    char iso[SITE_TIME_SIZE];
    const size_t columns = v->table.column_count;

    site_format_time(time_s, v->utc_offset_min, iso);
    TRY(command_settings_add(&v->settings, "site.time", iso));
    rc = command_scene_read(&d->s, v->scene, &v->settings);
    free(v->settings.text[--v->settings.count]);
    if (rc != STATUS_OK) goto out;
    d->midnight_s = site_midnight_s(&d->s->place);
    d->facet_k = malloc((d->s->shape->facet_count + 1) * sizeof *d->facet_k);
    d->step_k = malloc(STEPS * columns * sizeof *d->step_k);
    NEED(d->facet_k && d->step_k, STATUS_MEMORY, "no memory for the temperatures of a day");
    for (size_t i = 0; i < STEPS * columns; i++) d->step_k[i] = NAN;
    for (size_t i = 0; i < columns; i++) TRY(check_name(d->s, v->table.name[i], v->measured));
    TRY(facet_course_open(&d->course, v->dev, d->s));
out:
    return rc;
}

static void day_free(day *d)
{
    facet_course_free(d->course);
    scene_free(d->s);
    free(d->step_k);
    free(d->facet_k);
}

/* The temperatures of the columns at a step; the last is that of the day's last second. */
static status take_step(day *d, const validation *v, int step, const double **out_k)
{
    status rc = STATUS_OK;
    const size_t columns = v->table.column_count;
    double *k = d->step_k + (size_t)step * columns;

    *out_k = k;
    if (!isnan(k[0])) return STATUS_OK;
    TRY(interrupt_check());
    TRY(facet_course_at(d->course, d->midnight_s + fmin(step * STEP_S, DAY_S - 1.0), d->facet_k));
    for (size_t i = 0; i < columns; i++) k[i] = mean_of(d->s, v->table.name[i], d->facet_k);
out:
    return rc;
}

static bool has_values(const measured_table *t, size_t row)
{
    for (size_t i = 0; i < t->column_count; i++)
        if (!isnan(t->temperature_k[row * t->column_count + i])) return true;
    return false;
}

/* Predicts a row, linear between steps. */
static status predict_row(day *d, validation *v, size_t row)
{
    status rc = STATUS_OK;
    const size_t columns = v->table.column_count;
    const double at = (v->table.time_s[row] - d->midnight_s) / STEP_S;
    const int step = (int)fmin(floor(at + 1e-9), STEPS - 2);
    const double fraction = fmax(0.0, at - step);
    const double *low, *high;

    TRY(take_step(d, v, step, &low));
    high = low;
    if (fraction > 1e-9) TRY(take_step(d, v, step + 1, &high));
    for (size_t i = 0; i < columns; i++)
        v->predicted_k[row * columns + i] = low[i] + fraction * (high[i] - low[i]);
out:
    return rc;
}

static long day_of(const validation *v, size_t row)
{
    return (long)floor((v->table.time_s[row] + 60.0 * v->utc_offset_min) / DAY_S);
}

/* Predicts the rows of one local day, from `first` on; *out_end is the next day's first. */
static status predict_day(validation *v, size_t first, size_t *out_end)
{
    status rc = STATUS_OK;
    const measured_table *t = &v->table;
    day d = {0};
    size_t row = first;
    bool is_wanted = false;

    while (*out_end = row, row < t->count && day_of(v, row) == day_of(v, first))
        is_wanted |= has_values(t, row++);
    if (!is_wanted) goto out;
    TRY(day_open(&d, v, t->time_s[first]));
    for (row = first; row < *out_end; row++)
        if (has_values(t, row)) TRY(predict_row(&d, v, row));
out:
    day_free(&d);
    return rc;
}

static double difference_k(const validation *v, size_t row, size_t i)
{
    const size_t at = row * v->table.column_count + i;

    return v->predicted_k[at] - v->table.temperature_k[at];
}

/* Minutes from the measured peak to the predicted one, in the mean of days with values. */
static double peak_lag_min(const validation *v, size_t i)
{
    const measured_table *t = &v->table;
    const size_t n = t->column_count;
    double sum = 0.0;
    int days = 0;

    for (size_t row = 0, end; row < t->count; row = end) {
        size_t peak = t->count, measured = t->count;
        for (end = row; end < t->count && day_of(v, end) == day_of(v, row); end++) {
            if (isnan(difference_k(v, end, i))) continue;
            if (peak == t->count) peak = measured = end;
            if (v->predicted_k[end * n + i] > v->predicted_k[peak * n + i]) peak = end;
            if (t->temperature_k[end * n + i] > t->temperature_k[measured * n + i]) measured = end;
        }
        if (peak == t->count) continue;
        sum += (t->time_s[peak] - t->time_s[measured]) / 60.0;
        days++;
    }
    return sum / days;
}

static status print(const validation *v)
{
    status rc = STATUS_OK;

    for (size_t i = 0; i < v->table.column_count; i++) {
        bool has_one = false;
        for (size_t row = 0; row < v->table.count; row++)
            has_one |= !isnan(difference_k(v, row, i));
        NEED(has_one, STATUS_FORMAT, "%s: no value of '%s'", v->measured, v->table.name[i]);
    }
    puts("name,count,rmse_c,bias_c,peak_lag_min");
    for (size_t i = 0; i < v->table.column_count; i++) {
        double sum = 0.0, squares = 0.0;
        size_t count = 0;
        for (size_t row = 0; row < v->table.count; row++) {
            const double difference = difference_k(v, row, i);
            if (isnan(difference)) continue;
            sum += difference;
            squares += difference * difference;
            count++;
        }
        printf("%s,%zu,%.3f,%.3f,%.0f\n", v->table.name[i], count, sqrt(squares / (double)count),
               sum / (double)count, peak_lag_min(v, i));
    }
out:
    return rc;
}

static status write_rows(const validation *v)
{
    status rc = STATUS_OK;
    const measured_table *t = &v->table;
    output_file *file = NULL;
    char iso[SITE_TIME_SIZE];

    TRY(output_file_open(&file, v->output));
    fputs("time,name,measured_c,predicted_c\n", output_file_stream(file));
    for (size_t row = 0; row < t->count; row++)
        for (size_t i = 0; i < t->column_count; i++) {
            const size_t at = row * t->column_count + i;
            if (isnan(t->temperature_k[at])) continue;
            site_format_time(t->time_s[row], v->utc_offset_min, iso);
            fprintf(output_file_stream(file), "%s,%s,%.4f,%.4f\n", iso, t->name[i],
                    t->temperature_k[at] - (double)ZERO_CELSIUS_K,
                    v->predicted_k[at] - (double)ZERO_CELSIUS_K);
        }
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

static status read_measured(validation *v, const scene *s)
{
    status rc = STATUS_OK;

    if (!file_name_ends(v->measured, ".dat"))
        return measured_table_read(&v->table, v->measured, &s->place);
    NEED(v->facets, STATUS_ARGUMENT,
         "%s: expected --facets NAME, the object, part or material that SURFRAD looks at",
         v->measured);
    TRY(check_name(s, v->facets, v->scene));
    TRY(measured_table_surfrad(&v->table, v->measured, &s->place, v->facets,
                               mean_of(s, v->facets, NULL)));
out:
    return rc;
}

static status run(validation *v)
{
    status rc = STATUS_OK;
    scene *s = NULL;

    TRY(command_scene_read(&s, v->scene, &v->settings));
    NEED(s->history, STATUS_FORMAT, "%s: has no [weather], expected one that warms its facets",
         v->scene);
    v->utc_offset_min = s->place.utc_offset_min;
    TRY(read_measured(v, s));
    v->predicted_k = malloc(v->table.count * v->table.column_count * sizeof *v->predicted_k);
    NEED(v->predicted_k, STATUS_MEMORY, "no memory for %zu temperatures", v->table.count);
    for (size_t i = 0; i < v->table.count * v->table.column_count; i++) v->predicted_k[i] = NAN;
    TRY(device_open(&v->dev, -1));
    for (size_t row = 0; row < v->table.count;) TRY(predict_day(v, row, &row));
    if (v->output) TRY(write_rows(v));
    TRY(print(v));
out:
    scene_free(s);
    return rc;
}

int command_validate_scene(int argc, char **argv)
{
    validation v = {0};
    option list[] = {
        command_set_option(&v.settings),
        {"facets", 0, "NAME", "what SURFRAD's longwave from the ground is of", .text = &v.facets},
        {"output", 'o', "FILE.csv", "write time,name,measured_c,predicted_c", .text = &v.output}};
    const option_table table = {command, "thermal SCENE.toml FILE", 3, 3, purpose,
                                list,    sizeof list / sizeof *list};
    int code = option_table_read(&table, argc, argv, NULL);

    if (code == OPTION_TABLE_DONE) {
        v.scene = argv[2];
        v.measured = argv[3];
        code = program_end(command, run(&v));
    }
    device_free(v.dev);
    measured_table_free(&v.table);
    free(v.predicted_k);
    command_settings_free(&v.settings);
    return code;
}
