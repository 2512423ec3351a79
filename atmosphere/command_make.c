#include "command.h"
#include "database_header.h"
#include "database_output.h"
#include "files/output_folder.h"
#include "phase_table.h"
#include "range_error.h"
#include "sonde_profile.h"

#include <limits.h>
#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

static const char command[] = "radsig-atmosphere make";

static const char purpose[] =
    "Makes the radiance database of a scene from its site, time, weather, camera and its table\n"
    "[atmosphere.generate] with LOWTRAN 7, on all processors. A FILE that ends in .radc is "
    "written\n"
    "as the compact container.\n";

#define MOST_RANGE_ERROR 0.005 /* of a radiance */
#define THERMAL_FROM_UM 3.0
#define AUREOLE_BELOW_UM 5.0
#define NEAR_SUN_DEG 2.0
#define DEGREE (M_PI / 180.0)

typedef struct progress {
    run_list *r;
    size_t done;
} progress;

static status take(void *receiver, size_t index, const lowtran_run *run)
{
    progress *p = receiver;
    const status rc = run_list_take(p->r, index, run);

    p->done++;
    if (isatty(STDERR_FILENO))
        fprintf(stderr, "\r%zu of %zu runs%s", p->done, run_list_count(p->r),
                p->done == run_list_count(p->r) ? "\n" : "");
    return rc;
}

static status keep_decks(const run_list *r, const char *path)
{
    status rc = STATUS_OK;
    output_folder *folder = NULL;
    output_file *file = NULL;
    char name[NAME_MAX + 1];

    TRY(output_folder_open(&folder, path));
    for (size_t i = 0; i < run_list_count(r); i++) {
        snprintf(name, sizeof name, "%s.cdk", run_list_names(r)[i]);
        TRY(output_folder_add(folder, name, &file));
        fputs(run_list_decks(r)[i], output_file_stream(file));
        TRY(output_file_close(file));
    }
    TRY(output_folder_commit(folder));
out:
    output_folder_free(folder);
    return rc;
}

static void warn_of_night(const database_plan *g, const run_list *r)
{
    const double shortest_um = 1e4 / g->plan.wavenumber_max_cm1;

    if (!run_list_is_night(r) || shortest_um > THERMAL_FROM_UM) return;
    status_warn("%s: the sun is %.1f degrees below the horizon: every solar term is 0 and the "
                "database holds no light below %g um; choose another time, or wavenumbers of "
                "thermal bands alone",
                g->s->path, run_list_sun(r).zenith_rad * 180.0 / M_PI - 90.0, THERMAL_FROM_UM);
}

/* Towards the sun LOWTRAN's single scattering peaks, and a table's cell would spread the peak. */
static void warn_of_aureole(const database_plan *g, const run_list *r)
{
    const sun_position sun = run_list_sun(r);
    const double zenith_step = g->plan.sky_zenith_step_deg * DEGREE;
    const double azimuth_step = g->plan.sky_azimuth_step_deg * DEGREE;
    const double zenith = zenith_step * round(sun.zenith_rad / zenith_step);
    const double azimuth = azimuth_step * round(sun.azimuth_rad / azimuth_step);
    const double off =
        acos(fmin(1.0, cos(zenith) * cos(sun.zenith_rad) +
                           sin(zenith) * sin(sun.zenith_rad) * cos(azimuth - sun.azimuth_rad)));

    if (run_list_is_night(r) || off > NEAR_SUN_DEG * DEGREE ||
        1e4 / g->plan.wavenumber_max_cm1 > AUREOLE_BELOW_UM)
        return;
    status_warn("%s: a direction of the sky lies %.1f degrees from the sun, whose aureole is then "
                "spread over a whole cell; choose another sky_step_deg for bands with sunlight",
                g->s->path, off / DEGREE);
}

/* Between ranges that lie far apart. */
static void warn_of_ranges(const database_plan *g, const atmosphere *air)
{
    double from_m, to_m;
    const double error = range_error_most(air, &from_m, &to_m);

    if (error <= MOST_RANGE_ERROR) return;
    status_warn(
        "%s: range_m: between %g and %g m the radiance of a surface 20 K above the air errs by "
        "%.2g %%: range_m = %g, the farthest alone, has ranges chosen that keep it below 0.5 %%",
        g->s->path, from_m, to_m, 100.0 * error, air->range_m[air->range_count - 1]);
}

typedef struct make_options {
    const char *output, *keep_decks;
    site when; /* the time alone */
    bool has_time;
} make_options;

static status run(const char *scene_path, const make_options *options)
{
    status rc = STATUS_OK;
    database_plan *g = NULL;
    char *profile_cards = NULL, *phase_cards = NULL;
    progress p = {0};
    atmosphere *air = NULL;

    TRY(database_plan_read(&g, scene_path));
    if (options->has_time) {
        g->s->place.time_s = options->when.time_s;
        g->s->place.utc_offset_min = options->when.utc_offset_min;
    }
    NEED(database_output_is_container(options->output) ||
             (!g->plan.target_count && !g->plan.range_count),
         STATUS_ARGUMENT,
         "%s: a text file cannot hold target_altitude_m and range_m, expected -o FILE.radc",
         options->output);
    TRY(database_output_check(options->output));
    TRY(sonde_profile_cards(&profile_cards, g));
    TRY(phase_table_cards(&phase_cards, g->plan.phase_table));
    TRY(run_list_open(&p.r, &g->plan, &g->s->place, profile_cards, phase_cards));
    warn_of_night(g, p.r);
    warn_of_aureole(g, p.r);
    if (options->keep_decks) TRY(keep_decks(p.r, options->keep_decks));
    TRY(lowtran_run_decks(run_list_decks(p.r), run_list_names(p.r), run_list_count(p.r), take, &p));
    TRY(run_list_finish(p.r, &air));
    warn_of_ranges(g, air);
    TRY(database_header(&air->header, g, p.r));
    TRY(database_output_write(air, options->output));
out:
    atmosphere_free(air);
    run_list_free(p.r);
    free(phase_cards);
    free(profile_cards);
    database_plan_free(g);
    return rc;
}

static status read_time(const option *o, const char *text)
{
    make_options *options = o->out;

    options->has_time = true;
    return site_parse_time(text, &options->when.time_s, &options->when.utc_offset_min);
}

int command_make(int argc, char **argv)
{
    make_options options = {0};
    option list[] = {database_output_option(&options.output, "FILE.rad"),
                     {"time", 0, "ISO", "instead of the scene's: 1987-06-24T10:00:00-05:00",
                      .out = &options, .read = read_time},
                     {"keep-decks", 0, "FOLDER", "write the card deck of each run there",
                      .text = &options.keep_decks}};
    const option_table table = {
        command, "SCENE.toml", 1, 1, purpose, list, sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    return code == OPTION_TABLE_DONE ? program_end(command, run(argv[1], &options)) : code;
}
