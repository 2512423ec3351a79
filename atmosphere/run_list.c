#include "run_list.h"

#include "database_grid.h"
#include "deck_text.h"
#include "run_deck.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

/* What a run gives. */
typedef enum kind { KIND_SUN, KIND_PATH, KIND_SKY, KIND_TARGET, KIND_RANGE, KIND_SOURCE } kind;

typedef struct task {
    kind gives;
    int path, zenith, azimuth; /* which of them */
    int first, last;           /* points of the database, ascending wavelength */
    int step;                  /* which target or range */
} task;

struct run_list {
    atmosphere_plan plan;
    run_sight sight;
    const char *profile_cards, *phase_cards;
    atmosphere *air;
    size_t count;
    task *tasks;
    char **decks, **names;
    double *source; /* of a level path's sunlight: its radiance over 1 - tau, shape (n) */
};

enum { NAME_SIZE = 64 };

#define KILOMETRE 1000.0
#define PER_CM2 1e4 /* W cm-2 to W m-2 */
#define CLEAR 1e-6  /* a fraction that no path of 20 km lets through undiminished */

static double sample_step(const run_list *r)
{
    return r->plan.sample_step_cm1;
}

/* Half the width over which runs are averaged. */
static double half_width(const run_list *r)
{
    return r->plan.wavenumber_step_cm1 > sample_step(r) ? r->plan.wavenumber_step_cm1 / 2.0 : 0.0;
}

static double albedo_at(const atmosphere_plan *plan, double wavelength_um)
{
    int piece = 0;

    while (piece + 1 < plan->piece_count && wavelength_um >= plan->edge_um[piece]) piece++;
    return plan->albedo[piece];
}

static status write_deck(char **out, const run_list *r, const task *t)
{
    const atmosphere *a = r->air;
    card_deck deck = run_deck_sun(&r->sight);

    const double zenith = a->path_zenith_first_deg + t->path * a->path_zenith_step_deg;
    if (t->gives == KIND_PATH) deck = run_deck_path(&r->sight, r->plan.ground_altitude_m, zenith);
    if (t->gives == KIND_TARGET)
        deck = run_deck_path(&r->sight, a->target_altitude_m[t->step], zenith);
    if (t->gives == KIND_RANGE) deck = run_deck_range(&r->sight, a->range_m[t->step]);
    if (t->gives == KIND_SOURCE) deck = run_deck_source(&r->sight);
    if (t->gives == KIND_SKY)
        deck = run_deck_sky(&r->sight, t->zenith * a->zenith_step_deg,
                            t->azimuth * a->azimuth_step_deg);
    if (t->gives != KIND_SUN)
        deck.salb = r->plan.thesis ? 1.0 : albedo_at(&r->plan, a->wavelength_um[t->first]);
    deck.v1_cm1 = a->wavenumber_cm1[t->last] - half_width(r);
    deck.v2_cm1 = a->wavenumber_cm1[t->first] + half_width(r);
    deck.dv_cm1 = sample_step(r);
    return deck_text(out, &deck, r->profile_cards, t->gives == KIND_SUN ? "" : r->phase_cards);
}

static void name_task(char *out, const run_list *r, const task *t, int piece)
{
    const double path = r->plan.path_zenith_first_deg + t->path * r->plan.path_zenith_step_deg;
    int length = 0;

    if (t->gives == KIND_SUN) length = snprintf(out, NAME_SIZE, "sun");
    if (t->gives == KIND_PATH) length = snprintf(out, NAME_SIZE, "path_%06.3f", path);
    if (t->gives == KIND_TARGET)
        length = snprintf(out, NAME_SIZE, "target_%06.0f_%06.3f",
                          r->plan.target_altitude_m[t->step], path);
    if (t->gives == KIND_RANGE)
        length = snprintf(out, NAME_SIZE, "range_%06.0f", r->plan.range_m[t->step]);
    if (t->gives == KIND_SOURCE) length = snprintf(out, NAME_SIZE, "level_source");
    if (t->gives == KIND_SKY)
        length =
            snprintf(out, NAME_SIZE, "sky_%06.3f_%07.3f", t->zenith * r->plan.sky_zenith_step_deg,
                     t->azimuth * r->plan.sky_azimuth_step_deg);
    if (r->plan.piece_count > 1) snprintf(out + length, NAME_SIZE - (size_t)length, "_%d", piece);
}

static status add_task(run_list *r, task t, int piece)
{
    status rc = STATUS_OK;
    char name[NAME_SIZE];

    r->tasks[r->count] = t;
    TRY(write_deck(&r->decks[r->count], r, &t));
    name_task(name, r, &t, piece);
    r->names[r->count] = strdup(name);
    NEED(r->names[r->count], STATUS_MEMORY, "no memory for a deck's name");
    r->count++;
out:
    return rc;
}

static status add_steps(run_list *r, int first, int last, int piece)
{
    status rc = STATUS_OK;
    const atmosphere *a = r->air;
    task t = {.gives = KIND_TARGET, .first = first, .last = last};

    for (t.step = 0; t.step < a->target_count; t.step++)
        for (t.path = 0; t.path < a->path_count; t.path++) TRY(add_task(r, t, piece));
    t.gives = KIND_RANGE;
    t.path = 0;
    for (t.step = 0; t.step < a->range_count; t.step++) TRY(add_task(r, t, piece));
    t.gives = KIND_SOURCE;
    t.step = 0;
    if (a->range_count) TRY(add_task(r, t, piece));
out:
    return rc;
}

/* At the zenith all azimuths are one direction. */
static status add_piece(run_list *r, int first, int last, int piece)
{
    status rc = STATUS_OK;
    const atmosphere *a = r->air;

    TRY(add_task(r, (task){.gives = KIND_SUN, .first = first, .last = last}, piece));
    for (int path = 0; path < a->path_count; path++)
        TRY(add_task(r, (task){.gives = KIND_PATH, .path = path, .first = first, .last = last},
                     piece));
    for (int zenith = 0; zenith < a->zenith_count; zenith++)
        for (int azimuth = 0; azimuth < (zenith ? a->azimuth_count : 1); azimuth++)
            TRY(add_task(r, (task){KIND_SKY, 0, zenith, azimuth, first, last, 0}, piece));
    TRY(add_steps(r, first, last, piece));
out:
    return rc;
}

/* One set of runs for each stretch of the spectrum with one albedo. */
static status add_pieces(run_list *r)
{
    status rc = STATUS_OK;
    const atmosphere *a = r->air;
    const size_t most =
        (size_t)r->plan.piece_count * (size_t)(2 + (1 + a->target_count) * a->path_count +
                                               a->zenith_count * a->azimuth_count + a->range_count);
    int first = 0, piece = 1;

    r->tasks = calloc(most, sizeof *r->tasks);
    r->decks = calloc(most + 1, sizeof *r->decks);
    r->names = calloc(most, sizeof *r->names);
    NEED(r->tasks && r->decks && r->names, STATUS_MEMORY, "no memory for %zu decks", most);
    for (int i = 1; i <= a->point_count; i++) {
        if (i < a->point_count && albedo_at(&r->plan, a->wavelength_um[i]) ==
                                      albedo_at(&r->plan, a->wavelength_um[first]))
            continue;
        TRY(add_piece(r, first, i - 1, piece++));
        first = i;
    }
out:
    return rc;
}

static status make_air(run_list *r)
{
    const atmosphere_plan *plan = &r->plan;
    const database_grid grid = {plan->sensor_altitude_m,     plan->wavenumber_min_cm1,
                                plan->wavenumber_max_cm1,    plan->wavenumber_step_cm1,
                                plan->path_zenith_first_deg, plan->path_zenith_last_deg,
                                plan->path_zenith_step_deg,  plan->sky_zenith_step_deg,
                                plan->sky_azimuth_step_deg,  LOWTRAN_LEVELS,
                                plan->target_count,          plan->range_count,
                                plan->target_altitude_m,     plan->range_m};

    return database_grid_make(&r->air, &grid);
}

status run_list_open(run_list **out, const atmosphere_plan *plan, const site *place,
                     const char *profile_cards, const char *phase_cards)
{
    status rc = STATUS_OK;
    run_list *r = calloc(1, sizeof *r);

    NEED(r, STATUS_MEMORY, "no memory for a radiance database");
    r->plan = *plan;
    r->sight = (run_sight){
        .plan = &r->plan,
        .place = *place,
        .sun = sun_at(place->time_s, place->latitude_deg, place->longitude_deg),
        .has_profile = *profile_cards != '\0',
    };
    r->profile_cards = profile_cards;
    r->phase_cards = phase_cards;
    TRY(make_air(r));
    r->source = calloc((size_t)r->air->point_count, sizeof *r->source);
    NEED(r->source, STATUS_MEMORY, "no memory for a radiance database");
    TRY(add_pieces(r));
    *out = r;
    r = NULL;
out:
    run_list_free(r);
    return rc;
}

void run_list_free(run_list *r)
{
    if (!r) return;
    /* A task that failed half-way is the one behind the last. */
    for (size_t i = 0; i < r->count; i++) {
        free(r->decks[i]);
        free(r->names[i]);
    }
    if (r->decks) free(r->decks[r->count]);
    free(r->decks);
    free(r->names);
    free(r->source);
    free(r->tasks);
    atmosphere_free(r->air);
    free(r);
}

size_t run_list_count(const run_list *r)
{
    return r->count;
}

const char *const *run_list_decks(const run_list *r)
{
    return (const char *const *)r->decks;
}

const char *const *run_list_names(const run_list *r)
{
    return (const char *const *)r->names;
}

sun_position run_list_sun(const run_list *r)
{
    return r->sight.sun;
}

bool run_list_is_night(const run_list *r)
{
    return run_sight_is_night(&r->sight);
}

/* Box averages by the trapezoid rule, from a run's spectrum to the points of a task; sums are in
 * double precision. LOWTRAN's smallest radiances can lie a little below 0. */
static void average(const run_list *r, const task *t, const float *from, double scale, double *to)
{
    const double sample = sample_step(r), half = half_width(r);
    const int reach = (int)lround(half / sample);
    const double lowest = r->air->wavenumber_cm1[t->last] - half;

    for (int i = t->first; i <= t->last; i++) {
        const int centre = (int)lround((r->air->wavenumber_cm1[i] - lowest) / sample);
        double sum = reach ? 0.0 : (double)from[centre];
        for (int k = -reach; reach && k <= reach; k++)
            sum += (double)from[centre + k] * (abs(k) == reach ? .5 : 1.0) / (2.0 * reach);
        to[i] = fmax(0.0, sum) * scale;
    }
}

static void take_sun(run_list *r, const task *t, const lowtran_run *run)
{
    atmosphere *a = r->air;

    a->level_count = run->level_count;
    for (int i = 0; i < run->level_count; i++) {
        a->level_altitude_m[i] = (double)run->altitude_km[i] * KILOMETRE;
        a->level_temperature_k[i] = (double)run->temperature_k[i];
    }
    if (run_list_is_night(r)) return;
    average(r, t, run->irradiance, PER_CM2, a->solar_irradiance);
    average(r, t, run->tau, 1.0, a->tau1);
}

static void take_path(run_list *r, const task *t, const lowtran_run *run)
{
    atmosphere *a = r->air;
    const size_t first = (size_t)t->path * (size_t)a->point_count;

    a->path_range_m[t->path] = run->range_km * KILOMETRE;
    average(r, t, run->tau, 1.0, a->tau2 + first);
    average(r, t, run->emitted, PER_CM2, a->path_emitted + first);
    if (!run_list_is_night(r)) average(r, t, run->scattered, PER_CM2, a->path_scattered + first);
}

static void take_sky(run_list *r, const task *t, const lowtran_run *run)
{
    atmosphere *a = r->air;
    const int last = t->zenith ? t->azimuth : a->azimuth_count - 1;

    for (int azimuth = t->azimuth; azimuth <= last; azimuth++) {
        const size_t first =
            (size_t)(t->zenith * a->azimuth_count + azimuth) * (size_t)a->point_count;
        average(r, t, run->emitted, PER_CM2, a->sky_emitted_direction + first);
        if (!run_list_is_night(r))
            average(r, t, run->scattered, PER_CM2, a->sky_scattered_direction + first);
    }
}

static void take_target(run_list *r, const task *t, const lowtran_run *run)
{
    atmosphere *a = r->air;
    const size_t place = (size_t)(t->step * a->path_count + t->path);
    const size_t first = place * (size_t)a->point_count;

    a->target_range_m[place] = run->range_km * KILOMETRE;
    average(r, t, run->tau, 1.0, a->target_tau + first);
    average(r, t, run->emitted, PER_CM2, a->target_emitted + first);
    if (!run_list_is_night(r)) average(r, t, run->scattered, PER_CM2, a->target_scattered + first);
}

static void take_range(run_list *r, const task *t, const lowtran_run *run)
{
    const size_t first = (size_t)t->step * (size_t)r->air->point_count;

    average(r, t, run->tau, 1.0, r->air->range_tau + first);
    average(r, t, run->emitted, PER_CM2, r->air->range_emitted + first);
}

static status take_source(run_list *r, const task *t, const lowtran_run *run)
{
    status rc = STATUS_OK;
    double *tau = calloc((size_t)r->air->point_count, sizeof *tau);

    NEED(tau, STATUS_MEMORY, "no memory for a level path");
    average(r, t, run->tau, 1.0, tau);
    average(r, t, run->scattered, PER_CM2, r->source);
    for (int i = t->first; i <= t->last; i++) r->source[i] /= fmax(1.0 - tau[i], CLEAR);
out:
    free(tau);
    return rc;
}

/* assumed: along the ground air and sun are the same everywhere, so sunlight grows as 1 - tau. */
static void scatter_ranges(run_list *r)
{
    atmosphere *a = r->air;

    if (run_list_is_night(r)) return;
    for (int step = 0; step < a->range_count; step++)
        for (int i = 0; i < a->point_count; i++) {
            const int at = step * a->point_count + i;
            a->range_scattered[at] = r->source[i] * (1.0 - a->range_tau[at]);
        }
}

status run_list_take(void *receiver, size_t index, const lowtran_run *run)
{
    status rc = STATUS_OK;
    run_list *r = receiver;
    const task *t = &r->tasks[index];
    const double low = r->air->wavenumber_cm1[t->last] - half_width(r);
    const double high = r->air->wavenumber_cm1[t->first] + half_width(r);
    const int last = (int)lround((high - low) / sample_step(r));

    NEED(run->point_count == last + 1 && (double)run->wavenumber_cm1[0] == low &&
             (double)run->wavenumber_cm1[last] == high,
         STATUS_FORMAT, "%s: LOWTRAN gave %d points, expected %d from %g to %g cm-1",
         r->names[index], run->point_count, last + 1, low, high);
    if (t->gives == KIND_SUN) take_sun(r, t, run);
    if (t->gives == KIND_PATH) take_path(r, t, run);
    if (t->gives == KIND_SKY) take_sky(r, t, run);
    if (t->gives == KIND_TARGET) take_target(r, t, run);
    if (t->gives == KIND_RANGE) take_range(r, t, run);
    if (t->gives == KIND_SOURCE) TRY(take_source(r, t, run));
out:
    return rc;
}

status run_list_finish(run_list *r, atmosphere **out)
{
    status rc = STATUS_OK;

    scatter_ranges(r);
    TRY(database_grid_integrate(r->air, r->plan.thesis));
    *out = r->air;
    r->air = NULL;
out:
    return rc;
}
