#include "thermal/sensitivity.h"

#include "kernels/random.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define LANGLEY_PER_HOUR ((double)LANGLEY_PER_HOUR_W_M2)
#define RADIAN (M_PI / 180.0)

enum {
    AIR_TEMPERATURE,
    PRESSURE,
    HUMIDITY,
    WIND,
    DIRECT,
    DIFFUSE,
    EXPOSURE,
    CLOUD,
    SPECIFIC_HEAT,
    DENSITY,
    CONDUCTIVITY,
    THICKNESS,
    VISIBLE_EMISSIVITY,
    THERMAL_EMISSIVITY,
    POWER,
    EXPOSED_AREA,
    SLOPE,
    AZIMUTH
};

/* Tables 3.1.1-1 and 3.1.2-1; the humidity's 0.2 is of a per cent. */
static const struct {
    const char *name, *unit;
    double error, thesis_c;
} inputs[SENSITIVITY_INPUTS] = {
    [AIR_TEMPERATURE] = {"air temperature", "C", 0.2, 0.1027},
    [PRESSURE] = {"air pressure", "mbar", 0.2, 0.0017},
    [HUMIDITY] = {"relative humidity", "%", 0.2, 0.0069},
    [WIND] = {"wind speed", "m/s", 1.111, 0.2978},
    [DIRECT] = {"direct insolation", "ly/h", 0.043, 0.0061},
    [DIFFUSE] = {"diffuse insolation", "ly/h", 0.043, 0.0046},
    [EXPOSURE] = {"sky exposure", "1", 0.05, 0.0728},
    [CLOUD] = {"cloud type", "of 0 1 7 8", 0.0, 0.0518},
    [SPECIFIC_HEAT] = {"specific heat", "%", 10.0, 0.0718},
    [DENSITY] = {"density", "%", 10.0, 0.0720},
    [CONDUCTIVITY] = {"thermal conductivity", "%", 10.0, 0.0477},
    [THICKNESS] = {"thickness", "cm", 0.1, 0.0363},
    [VISIBLE_EMISSIVITY] = {"visible emissivity", "%", 10.0, 0.3934},
    [THERMAL_EMISSIVITY] = {"thermal emissivity", "1", 0.025, 0.0624},
    [POWER] = {"self-generated power", "%", 10.0, 0.0236},
    [EXPOSED_AREA] = {"exposed area", "%", 10.0, 0.2809},
    [SLOPE] = {"slope", "degrees", 3.0, 0.0456},
    [AZIMUTH] = {"azimuth", "degrees", 3.0, 0.1012},
};

static double limited(double value, double low, double high)
{
    return fmin(high, fmax(low, value));
}

static float share_of(float value, double times)
{
    return (float)limited((double)value * times, 0.0, 1.0);
}

void sensitivity_turn(facet_record *facet)
{
    const double slope = (double)facet->slope_rad, azimuth = (double)facet->azimuth_rad;

    facet->normal[0] = (float)(sin(slope) * sin(azimuth));
    facet->normal[1] = (float)(sin(slope) * cos(azimuth));
    facet->normal[2] = (float)cos(slope);
}

/* Where in its range a run's offset lies, 0..1. */
static double place_of(const sensitivity_study *study, int input, uint32_t run)
{
    const uint key[2] = {study->seed, (uint)input};
    uint word[4] = {run, 0, 0, 0};

    random_words(key, word);
    return ((double)run + (double)random_uniform(word[0])) / (double)study->runs;
}

/* What a dew point must rise by to follow the air; the history's own may be a measured one. */
static double dew_point_rise_k(const weather_record *r, double air_k, double humidity)
{
    return weather_dew_point_k(air_k, humidity) -
           weather_dew_point_k(r->air_temperature_k, r->relative_humidity);
}

static void vary_record(weather_record *r, int input, double place)
{
    static const int cloud_types[] = {0, 1, 7, 8};
    const double offset = inputs[input].error * (2.0 * place - 1.0);
    const double air_k = r->air_temperature_k + (input == AIR_TEMPERATURE ? offset : 0.0);
    const double humidity =
        limited(r->relative_humidity + (input == HUMIDITY ? 0.01 * offset : 0.0), 0.0, 1.0);

    if (input == AIR_TEMPERATURE || input == HUMIDITY)
        r->dew_point_k += dew_point_rise_k(r, air_k, humidity);
    r->air_temperature_k = air_k;
    r->relative_humidity = humidity;
    if (input == PRESSURE) r->pressure_pa += 100.0 * offset;
    if (input == WIND) r->wind_m_s = fmax(0.0, r->wind_m_s + offset);
    if (input == DIRECT) r->direct_w_m2 = fmax(0.0, r->direct_w_m2 + LANGLEY_PER_HOUR * offset);
    if (input == DIFFUSE) r->diffuse_w_m2 = fmax(0.0, r->diffuse_w_m2 + LANGLEY_PER_HOUR * offset);
    if (input == EXPOSURE) r->sky_exposure = limited(r->sky_exposure + offset, 0.0, 1.0);
    if (input == CLOUD) r->cloud_type = cloud_types[(int)(4.0 * place)];
}

/* A sheet thinner than the error keeps a tenth of its thickness. */
static void vary_object(sensitivity_object *o, int input, double place)
{
    const double offset = inputs[input].error * (2.0 * place - 1.0), times = 1.0 + 0.01 * offset;
    material_record *m = &o->material;
    facet_record *f = &o->facet;

    if (input == SPECIFIC_HEAT) m->specific_heat_j_kg_k *= (float)times;
    if (input == DENSITY) m->density_kg_m3 *= (float)times;
    if (input == CONDUCTIVITY) m->conductivity_w_m_k *= (float)times;
    if (input == THICKNESS)
        f->thickness_m = fmaxf(0.1f * f->thickness_m, f->thickness_m + (float)(0.01 * offset));
    if (input == VISIBLE_EMISSIVITY) m->solar_absorptance = share_of(m->solar_absorptance, times);
    if (input == THERMAL_EMISSIVITY)
        m->thermal_emissivity = (float)limited((double)m->thermal_emissivity + offset, 0.0, 1.0);
    if (input == POWER) f->power_w_m2 *= (float)times;
    if (input == EXPOSED_AREA)
        m->exposed_area = (float)limited((double)m->exposed_area * times, -1.0, 1.0);
    if (input == SLOPE) f->slope_rad += (float)(RADIAN * offset);
    if (input == AZIMUTH) f->azimuth_rad += (float)(RADIAN * offset);
    sensitivity_turn(f);
}

/* What a run needs; the same room serves all. */
typedef struct bench {
    device *dev;
    const sensitivity_study *study;
    weather *history;
    sensitivity_object *object;
    material_record *material;
    facet_record *facet;
    layered_matter *layered;
    float *stated_k, *varied_k; /* shape (steps, objects) */
} bench;

static void bench_free(bench *b)
{
    free(b->varied_k);
    free(b->stated_k);
    free(b->layered);
    free(b->facet);
    free(b->material);
    free(b->object);
    weather_free(b->history);
}

static status bench_open(bench *b, device *dev, const sensitivity_study *study)
{
    status rc = STATUS_OK;
    const size_t n = study->count, values = n * study->history->count;

    *b = (bench){.dev = dev, .study = study};
    TRY(weather_allocate(&b->history, study->history->count, study->history->interval_s));
    b->object = malloc(n * sizeof *b->object);
    b->material = malloc(n * sizeof *b->material);
    b->facet = malloc(n * sizeof *b->facet);
    b->layered = malloc(n * sizeof *b->layered);
    b->stated_k = malloc(values * sizeof *b->stated_k);
    b->varied_k = malloc(values * sizeof *b->varied_k);
    NEED(b->object && b->material && b->facet && b->layered && b->stated_k && b->varied_k,
         STATUS_MEMORY, "no memory for %zu objects", n);
    for (size_t i = 0; i < n; i++) b->layered[i] = layered_matter_default();
out:
    return rc;
}

static void bench_reset(bench *b)
{
    const sensitivity_study *s = b->study;

    memcpy(b->history->record, s->history->record, s->history->count * sizeof *b->history->record);
    memcpy(b->object, s->object, s->count * sizeof *b->object);
}

/* Temperatures of the objects as they stand on the bench. */
static status bench_run(bench *b, float *out_k)
{
    status rc = STATUS_OK;
    const sensitivity_study *s = b->study;
    const thermal_matter matter = {b->material, s->is_layered ? b->layered : NULL, NULL, s->count,
                                   s->laws};
    thermal *t = NULL;

    for (size_t i = 0; i < s->count; i++) {
        b->material[i] = b->object[i].material;
        b->facet[i] = b->object[i].facet;
        b->facet[i].material = (uint32_t)i;
    }
    TRY(thermal_open(&t, b->dev, &matter, b->history, &s->place));
    TRY(thermal_histories(t, b->facet, s->count, out_k));
out:
    thermal_free(t);
    return rc;
}

/* Adds the squares of a run's differences to the row's, and the mean of their roots. */
static void add_run(const bench *b, sensitivity_row *row)
{
    const weather *w = b->study->history;
    const size_t n = b->study->count;
    const double start_h = weather_day_start_h(w) - 1e-6;

    for (size_t k = 0; k < n; k++) {
        double squares = 0.0;
        size_t steps = 0;
        for (size_t i = 0; i < w->count; i++) {
            const double rise = (double)b->varied_k[i * n + k] - (double)b->stated_k[i * n + k];
            row->at_step_c[i] += rise * rise;
            if (w->record[i].time_h < start_h) continue;
            squares += rise * rise;
            steps++;
        }
        row->rmse_c += sqrt(squares / (double)steps);
        row->sigma_c += squares / (double)steps;
    }
}

static status run_input(bench *b, int input, sensitivity_row *row)
{
    status rc = STATUS_OK;
    const sensitivity_study *s = b->study;
    const double all = (double)s->runs * (double)s->count;

    for (uint32_t run = 0; run < s->runs; run++) {
        const double place = place_of(s, input, run);
        bench_reset(b);
        for (size_t i = 0; i < s->history->count && input < SENSITIVITY_WEATHER; i++)
            vary_record(&b->history->record[i], input, place);
        for (size_t i = 0; i < s->count && input >= SENSITIVITY_WEATHER; i++)
            vary_object(&b->object[i], input, place);
        TRY(bench_run(b, b->varied_k));
        add_run(b, row);
    }
    row->rmse_c /= all;
    row->sigma_c = sqrt(row->sigma_c / all);
    for (size_t i = 0; i < s->history->count; i++)
        row->at_step_c[i] = sqrt(row->at_step_c[i] / all);
out:
    return rc;
}

status sensitivity_run(sensitivity *out, device *dev, const sensitivity_study *study)
{
    status rc = STATUS_OK;
    const size_t steps = study->history->count;
    sensitivity result = {.at_step_c = calloc(SENSITIVITY_INPUTS * steps, sizeof(double))};
    bench b = {0};

    NEED(result.at_step_c, STATUS_MEMORY, "no memory for %zu steps", steps);
    TRY(bench_open(&b, dev, study));
    bench_reset(&b);
    TRY(bench_run(&b, b.stated_k));
    for (int i = 0; i < SENSITIVITY_INPUTS; i++) {
        result.row[i] = (sensitivity_row){.input = inputs[i].name,
                                          .unit = inputs[i].unit,
                                          .error = inputs[i].error,
                                          .thesis_c = inputs[i].thesis_c,
                                          .at_step_c = result.at_step_c + (size_t)i * steps};
        TRY(run_input(&b, i, &result.row[i]));
    }
    *out = result;
    result.at_step_c = NULL;
out:
    free(result.at_step_c);
    bench_free(&b);
    return rc;
}

void sensitivity_free(sensitivity *result)
{
    free(result->at_step_c);
    *result = (sensitivity){0};
}

sensitivity_row sensitivity_sum(const sensitivity *result, int first, int count, int without)
{
    sensitivity_row sum = {0};

    for (int i = first; i < first + count; i++) {
        const sensitivity_row *row = &result->row[i];
        if (i == without) continue;
        sum.rmse_c += row->rmse_c * row->rmse_c;
        sum.sigma_c += row->sigma_c * row->sigma_c;
        sum.thesis_c += row->thesis_c * row->thesis_c;
    }
    sum.rmse_c = sqrt(sum.rmse_c);
    sum.sigma_c = sqrt(sum.sigma_c);
    sum.thesis_c = sqrt(sum.thesis_c);
    return sum;
}
