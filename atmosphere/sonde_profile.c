#include "sonde_profile.h"

#include "lowtran.h"
#include "model_sonde.h"
#include "sonde.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define ZERO_C_K 273.15
#define MODEL_GAP_M 1000.0 /* between the sonde's last level and the model's first */
#define GAP_K_PER_KM .05   /* what a wide gap counts as, where the lines are straight */
#define DEW_POINT_SHARE .3 /* of a dew point's deviation, against a temperature's */

/* Altitudes of LOWTRAN's models from which a profile is continued; 24 km gives way to a level of the
 * boundary layer. */
static const double model_km[] = {5,  6,  7,  8,  9,  10, 11, 12, 13, 14, 15, 16, 17, 18,
                                  19, 20, 21, 22, 23, 25, 30, 35, 40, 45, 50, 70, 100};

#define LEAST_TOP_M 4000.0 /* one level of LOWTRAN's models below those above */

enum { MODEL_LEVELS = sizeof model_km / sizeof *model_km, OTHER_GASES = 11 };

/* With a level more LOWTRAN gives NaN on a path from an altitude down to the ground. */
enum { PROFILE_LEVELS = LOWTRAN_LEVELS - 1 };

static status check_reach(const sonde *s, const atmosphere_plan *plan)
{
    const double low = s->level[0].altitude_m, high = s->level[s->count - 1].altitude_m;

    if (low > plan->ground_altitude_m + 1.0)
        return status_set(STATUS_ARGUMENT,
                          "%s: starts at %g m, expected levels from the ground on: raise "
                          "ground_altitude_m, now %g",
                          plan->radiosonde, low, plan->ground_altitude_m);
    if (high < plan->ground_altitude_m + 1000.0 || high < plan->inversion_altitude_m)
        return status_set(STATUS_ARGUMENT,
                          "%s: ends at %g m, expected at least 1 km above the ground and the "
                          "inversion altitude",
                          plan->radiosonde, high);
    if (plan->inversion_altitude_m > 0.0 && plan->inversion_altitude_m <= plan->ground_altitude_m)
        return status_set(STATUS_ARGUMENT,
                          "inversion_altitude_m: found %g, expected metres above sea level, more "
                          "than the ground's %g",
                          plan->inversion_altitude_m, plan->ground_altitude_m);
    return STATUS_OK;
}

/* The hour's weather, linear between records. */
static sonde_level surface(const database_plan *g)
{
    const weather *w = g->s->history;
    const double since_s = g->s->place.time_s - weather_origin_s(w, &g->s->place);
    const double place = fmin(fmax(since_s / w->interval_s, 0.0), (double)(w->count - 1));
    const size_t i = place < (double)(w->count - 1) ? (size_t)place : w->count - 2;
    const weather_record *a = &w->record[i], *b = &w->record[i + 1];
    const double fraction = place - (double)i;

    return (sonde_level){.altitude_m = g->plan.ground_altitude_m,
                         .temperature_k = a->air_temperature_k +
                                          fraction * (b->air_temperature_k - a->air_temperature_k),
                         .dew_point_k =
                             a->dew_point_k + fraction * (b->dew_point_k - a->dew_point_k)};
}

static void bend(sonde *s, const sonde_level *ground, const sonde_level *inversion)
{
    for (size_t i = 0; i < s->count && s->level[i].altitude_m < inversion->altitude_m; i++) {
        const double fraction = (s->level[i].altitude_m - ground->altitude_m) /
                                (inversion->altitude_m - ground->altitude_m);
        s->level[i].temperature_k =
            ground->temperature_k + fraction * (inversion->temperature_k - ground->temperature_k);
        s->level[i].dew_point_k =
            ground->dew_point_k + fraction * (inversion->dew_point_k - ground->dew_point_k);
    }
}

/* The sounding from the ground on, with a level at the ground and at the inversion. */
static status cut(sonde **out, const sonde *s, const atmosphere_plan *plan)
{
    status rc = STATUS_OK;
    const double ground = plan->ground_altitude_m, inversion = plan->inversion_altitude_m;
    sonde *c = calloc(1, sizeof *c);
    bool has_inversion = inversion <= 0.0;

    NEED(c, STATUS_MEMORY, "no memory for a profile");
    c->level = malloc((s->count + 2) * sizeof *c->level);
    NEED(c->level, STATUS_MEMORY, "no memory for a profile");
    c->level[c->count++] = sonde_at(s, ground);
    for (size_t i = 0; i < s->count; i++) {
        const double altitude = s->level[i].altitude_m;
        if (altitude <= ground + 1.0) continue;
        if (!has_inversion && altitude >= inversion) {
            if (altitude > inversion + 1.0) c->level[c->count++] = sonde_at(s, inversion);
            has_inversion = true;
        }
        c->level[c->count++] = s->level[i];
    }
    *out = c;
    c = NULL;
out:
    sonde_free(c);
    return rc;
}

static double least_top_m(const atmosphere_plan *plan)
{
    return fmax(LEAST_TOP_M, fmax(plan->inversion_altitude_m, plan->ground_altitude_m + 1000.0));
}

/* Above the inversion LOWTRAN's model has its own humidity. */
static void leave_water(sonde *s, double inversion_m)
{
    for (size_t i = 0; i < s->count; i++)
        if (s->level[i].altitude_m > inversion_m) s->level[i].dew_point_k = NAN;
}

/* How far level i lies off the straight line between two others, in kelvin. */
static double deviation(const sonde *s, size_t low, size_t i, size_t high)
{
    const sonde line = {2, (sonde_level[]){s->level[low], s->level[high]}};
    const sonde_level straight = sonde_at(&line, s->level[i].altitude_m);
    const double dew = fabs(straight.dew_point_k - s->level[i].dew_point_k);
    const double gap_m = fmin(s->level[i].altitude_m - s->level[low].altitude_m,
                              s->level[high].altitude_m - s->level[i].altitude_m);

    return fabs(straight.temperature_k - s->level[i].temperature_k) +
           GAP_K_PER_KM * gap_m / 1000.0 + (isnan(dew) ? 0.0 : DEW_POINT_SHARE * dew);
}

/* Keeps `limit` levels: the ends, then always the one that lies farthest off the lines. */
static void thin(sonde *s, size_t limit)
{
    size_t kept[LOWTRAN_LEVELS] = {0, s->count - 1}, count = 2;

    if (s->count <= limit) return;
    while (count < limit) {
        double largest = -1.0;
        size_t best = 0, behind = 0;
        for (size_t k = 0; k + 1 < count; k++)
            for (size_t i = kept[k] + 1; i < kept[k + 1]; i++) {
                const double off = deviation(s, kept[k], i, kept[k + 1]);
                if (off <= largest) continue;
                largest = off;
                best = i;
                behind = k + 1;
            }
        memmove(&kept[behind + 1], &kept[behind], (count - behind) * sizeof *kept);
        kept[behind] = best;
        count++;
    }
    for (size_t k = 0; k < count; k++) s->level[k] = s->level[kept[k]];
    s->count = count;
}

/* One card: altitude, pressure, temperature, water and two gases, then whence each comes. */
static void print_level(FILE *stream, const sonde_level *level, int model)
{
    const bool is_dry = isnan(level->dew_point_k);

    fprintf(stream, "%10.3f%10.3f%10.3f%10.3f%10.3f%10.3fAA", level->altitude_m / 1000.0,
            level->pressure_hpa, level->temperature_k, is_dry ? 0.0 : level->dew_point_k - ZERO_C_K,
            0.0, 0.0);
    fputc(is_dry ? '0' + model : 'G', stream);
    for (int i = 0; i < OTHER_GASES; i++) fprintf(stream, "%d", model);
    fputc('\n', stream);
}

static status print_cards(char **out, sonde *s, int model)
{
    status rc = STATUS_OK;
    char *text = NULL;
    size_t length, above = 0;
    FILE *stream = open_memstream(&text, &length);
    const double top_m = s->level[s->count - 1].altitude_m;

    NEED(stream, STATUS_MEMORY, "no memory for a profile");
    while (above < MODEL_LEVELS && model_km[above] * 1000.0 < top_m + MODEL_GAP_M) above++;
    const size_t continued = MODEL_LEVELS - above;
    thin(s, PROFILE_LEVELS - continued);
    fprintf(stream, "%5d%5d%5d%s\n", (int)(s->count + continued), 0, 0, "RADIOSONDE");
    for (size_t i = 0; i < s->count; i++) print_level(stream, &s->level[i], model);
    for (; above < MODEL_LEVELS; above++) {
        fprintf(stream, "%10.3f%10.3f%10.3f%10.3f%10.3f%10.3f", model_km[above], 0.0, 0.0, 0.0, 0.0,
                0.0);
        for (int i = 0; i < OTHER_GASES + 3; i++) fprintf(stream, "%d", model);
        fputc('\n', stream);
    }
    NEED(fclose(stream) == 0, STATUS_MEMORY, "no memory for a profile");
    *out = text;
out:
    return rc;
}

status sonde_profile_cards(char **out, const database_plan *g)
{
    status rc = STATUS_OK;
    const atmosphere_plan *plan = &g->plan;
    sonde *read = NULL, *profile = NULL;

    if (!plan->radiosonde && plan->inversion_altitude_m <= 0.0) {
        *out = strdup("");
        NEED(*out, STATUS_MEMORY, "no memory for a profile");
        goto out;
    }
    if (plan->radiosonde)
        TRY(sonde_read(&read, plan->radiosonde, &g->s->place));
    else
        TRY(model_sonde_make(&read, plan->model, least_top_m(plan)));
    TRY(check_reach(read, plan));
    TRY(cut(&profile, read, plan));
    if (plan->inversion_altitude_m > 0.0) {
        const sonde_level ground = surface(g);
        const sonde_level inversion = sonde_at(read, plan->inversion_altitude_m);
        bend(profile, &ground, &inversion);
    }
    if (!plan->radiosonde) leave_water(profile, plan->inversion_altitude_m);
    TRY(print_cards(out, profile, plan->model));
out:
    sonde_free(profile);
    sonde_free(read);
    return rc;
}
