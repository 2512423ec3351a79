#include "scene/atmosphere_plan.h"

#include <math.h>
#include <string.h>

static const char *const models[] = {"tropical",         "midlatitude-summer", "midlatitude-winter",
                                     "subarctic-summer", "subarctic-winter",   "us-standard-1976"};
static const char *const aerosols[] = {"none",          "rural",         "navy-maritime",
                                       "maritime",      "urban",         "tropospheric",
                                       "advective-fog", "radiative-fog", "desert"};
static const int aerosol_codes[] = {0, 1, 3, 4, 5, 6, 8, 9, 10};
static const char *const phases[] = {"henyey-greenstein", "table", "lowtran"};
static const char *const modes[] = {"exact", "thesis"};

#define SPACE_M 100000.0
#define DEGREE (M_PI / 180.0)

#define COUNT(list) ((int)(sizeof(list) / sizeof *(list)))

/* LOWTRAN computes every 5 cm-1. */
static bool is_multiple(double value, double of)
{
    return fabs(value / of - round(value / of)) < 1e-9;
}

static void read_air(atmosphere_plan *plan, scene_table *t)
{
    int word;

    scene_table_require(t, "model", "\"midlatitude-summer\" or another of LOWTRAN's six");
    if (scene_table_word(t, "model", models, COUNT(models), &word)) plan->model = word + 1;
    if (scene_table_has(t, "radiosonde")) scene_table_file(t, "radiosonde", &plan->radiosonde);
    scene_table_number(t, "inversion_altitude_m", 1.0, 1e4, &plan->inversion_altitude_m);
    if (scene_table_word(t, "aerosol", aerosols, COUNT(aerosols), &word))
        plan->aerosol = aerosol_codes[word];
    scene_table_number(t, "visibility_km", .1, 500.0, &plan->visibility_km);
    scene_table_number(t, "ground_altitude_m", 0.0, 5900.0, &plan->ground_altitude_m);
}

static void read_phase(atmosphere_plan *plan, scene_table *t)
{
    int word;

    if (scene_table_word(t, "phase_function", phases, COUNT(phases), &word))
        plan->phase = (atmosphere_phase)word;
    if (plan->phase == ATMOSPHERE_PHASE_HENYEY_GREENSTEIN)
        scene_table_require(t, "asymmetry", "a number from -0.99 to 0.99");
    if (plan->phase == ATMOSPHERE_PHASE_TABLE)
        scene_table_require(t, "phase_table", "a file: angle and four phase functions a line");
    scene_table_number(t, "asymmetry", -.99, .99, &plan->asymmetry);
    if (scene_table_has(t, "phase_table")) scene_table_file(t, "phase_table", &plan->phase_table);
}

/* One number, or a list with the wavelengths between its pieces. */
static void read_albedo(atmosphere_plan *plan, scene_table *t)
{
    const toml_node *node = scene_table_node(t, "ground_albedo");
    const toml_node *edges = scene_table_node(t, "ground_albedo_edge_um");
    const size_t count = node && toml_node_kind(node) == TOML_ARRAY ? toml_node_count(node) : 0;

    if (!count) {
        scene_table_number(t, "ground_albedo", 0.0, 1.0, plan->albedo);
        if (edges)
            scene_fail(t->reader, edges, "%s: expected ground_albedo = [...], one more than edges",
                       toml_node_name(edges));
        return;
    }
    if (count > ATMOSPHERE_PLAN_PIECES) {
        scene_fail(t->reader, node, "%s: found %zu numbers, expected up to %d",
                   toml_node_name(node), count, ATMOSPHERE_PLAN_PIECES);
        return;
    }
    plan->piece_count = (int)count;
    scene_table_numbers(t, "ground_albedo", count, 0.0, 1.0, plan->albedo);
    if (count == 1) return;
    scene_table_require(t, "ground_albedo_edge_um", "the wavelengths between the albedos");
    if (!scene_table_numbers(t, "ground_albedo_edge_um", count - 1, .2, 100.0, plan->edge_um))
        return;
    for (size_t i = 1; i + 1 < count; i++)
        if (plan->edge_um[i] <= plan->edge_um[i - 1])
            scene_fail(t->reader, edges, "%s: expected ascending wavelengths",
                       toml_node_name(edges));
}

static void read_paths(atmosphere_plan *plan, scene_table *t)
{
    double grid[3];
    const toml_node *node = toml_node_get(t->node, "path_zenith_deg");

    scene_table_number(t, "sensor_altitude_m", 0.0, SPACE_M, &plan->sensor_altitude_m);
    scene_table_number(t, "sensor_azimuth_deg", -360.0, 360.0, &plan->sensor_azimuth_deg);
    if (plan->sensor_altitude_m <= plan->ground_altitude_m || plan->sensor_altitude_m > SPACE_M)
        scene_fail(t->reader, t->node,
                   "%s.sensor_altitude_m: found %g, expected metres above the ground, up to %g",
                   toml_node_name(t->node), plan->sensor_altitude_m, SPACE_M);
    if (!scene_table_numbers(t, "path_zenith_deg", 3, 0.0, 89.0, grid)) return;
    plan->path_zenith_first_deg = grid[0];
    plan->path_zenith_last_deg = grid[1];
    plan->path_zenith_step_deg = grid[2];
    if (grid[2] < .01 || grid[1] < grid[0] || !is_multiple(grid[1] - grid[0], grid[2]))
        scene_fail(t->reader, node,
                   "%s: found %s, expected [first, last, step], a whole number of "
                   "steps",
                   toml_node_name(node), toml_node_text(node));
}

static int read_ascending(scene_table *t, const char *key, double low, double high, double *out)
{
    const toml_node *node = scene_table_node(t, key);
    const size_t count = node && toml_node_kind(node) == TOML_ARRAY ? toml_node_count(node) : 0;
    bool rises = true;

    if (!node) return 0;
    if (!count || count > ATMOSPHERE_PLAN_STEPS) {
        scene_fail(t->reader, node, "%s: found %s, expected a list of up to %d numbers",
                   toml_node_name(node), toml_node_text(node), ATMOSPHERE_PLAN_STEPS);
        return 0;
    }
    if (!scene_table_numbers(t, key, count, low, high, out)) return 0;
    for (size_t i = 1; i < count; i++) rises = rises && out[i] > out[i - 1];
    if (!rises) scene_fail(t->reader, node, "%s: expected rising numbers", toml_node_name(node));
    return (int)count;
}

/* Ranges from a metre to the farthest, whole metres as LOWTRAN's cards hold them, one about as many times the
 * other: between them the radiance of surfaces warmer than the air errs by less than 0.5 %. */
static void choose_ranges(atmosphere_plan *plan, double farthest_m)
{
    const int most = ATMOSPHERE_PLAN_STEPS;

    for (int i = 0; i < most; i++) {
        const double range_m = round(pow(farthest_m, (double)i / (most - 1)));
        if (i == 0 || range_m > plan->range_m[plan->range_count - 1])
            plan->range_m[plan->range_count++] = range_m;
    }
}

/* A list, or the farthest. */
static void read_ranges(atmosphere_plan *plan, scene_table *t)
{
    const toml_node *node = scene_table_node(t, "range_m");
    double farthest_m = 0.0;

    if (node && toml_node_kind(node) == TOML_NUMBER) {
        if (scene_table_number(t, "range_m", 10.0, 1e5, &farthest_m))
            choose_ranges(plan, round(farthest_m));
        return;
    }
    plan->range_count = read_ascending(t, "range_m", 1.0, 1e5, plan->range_m);
    for (int i = 0; i < plan->range_count; i++)
        if (plan->range_m[i] != round(plan->range_m[i])) {
            scene_fail(t->reader, node, "%s: found %g, expected whole metres", toml_node_name(node),
                       plan->range_m[i]);
            return;
        }
}

static void read_grids(atmosphere_plan *plan, scene_table *t)
{
    plan->target_count = read_ascending(t, "target_altitude_m", plan->ground_altitude_m + 1.0,
                                        plan->sensor_altitude_m - 1.0, plan->target_altitude_m);
    read_ranges(plan, t);
    if (plan->thesis && (plan->target_count || plan->range_count))
        scene_fail(t->reader, t->node,
                   "%s: mode \"thesis\" has neither target_altitude_m nor range_m",
                   toml_node_name(t->node));
}

static void read_spectrum(atmosphere_plan *plan, scene_table *t)
{
    double range[2];
    const bool stated = plan->wavenumber_step_cm1 > 0.0;

    if (!stated) scene_table_require(t, "wavenumber_cm1", "[low, high]");
    if (!stated) scene_table_require(t, "wavenumber_step_cm1", "5, or a multiple of 10");
    if (scene_table_numbers(t, "wavenumber_cm1", 2, 100.0, 50000.0, range)) {
        plan->wavenumber_min_cm1 = range[0];
        plan->wavenumber_max_cm1 = range[1];
    }
    scene_table_number(t, "wavenumber_step_cm1", 5.0, 1000.0, &plan->wavenumber_step_cm1);
    const double step = plan->wavenumber_step_cm1, low = plan->wavenumber_min_cm1;
    if (step <= 0.0 || low <= 0.0) return;
    plan->sample_step_cm1 = plan->thesis ? step : fmin(5.0, step);
    scene_table_number(t, "sample_step_cm1", 5.0, step, &plan->sample_step_cm1);
    const double sample = plan->sample_step_cm1;
    if (!is_multiple(step, 5.0) || !is_multiple(sample, 5.0) ||
        (step != sample && !is_multiple(step, 2.0 * sample)))
        scene_fail(
            t->reader, t->node,
            "%s: found wavenumber_step_cm1 %g and sample_step_cm1 %g, expected multiples of 5, "
            "the first the second or an even multiple of it",
            toml_node_name(t->node), step, sample);
    else if (!is_multiple(low, 5.0) || plan->wavenumber_max_cm1 < low ||
             !is_multiple(plan->wavenumber_max_cm1 - low, step))
        scene_fail(t->reader, t->node,
                   "%s.wavenumber_cm1: found %g to %g, expected multiples of 5, a whole number of "
                   "steps of %g apart",
                   toml_node_name(t->node), low, plan->wavenumber_max_cm1, step);
}

static void read_sky(atmosphere_plan *plan, scene_table *t)
{
    scene_table steps = scene_table_open(t->reader, scene_table_node(t, "sky_step_deg"),
                                         "atmosphere.generate.sky_step_deg");

    scene_table_require(&steps, "zenith", "degrees, a divisor of 90");
    scene_table_require(&steps, "azimuth", "degrees, a divisor of 360");
    scene_table_number(&steps, "zenith", 1.0, 45.0, &plan->sky_zenith_step_deg);
    scene_table_number(&steps, "azimuth", 1.0, 180.0, &plan->sky_azimuth_step_deg);
    scene_table_close(&steps);
    if (!is_multiple(90.0, plan->sky_zenith_step_deg) ||
        !is_multiple(360.0, plan->sky_azimuth_step_deg))
        scene_fail(t->reader, steps.node,
                   "sky_step_deg: found %g and %g, expected divisors of 90 and of 360",
                   plan->sky_zenith_step_deg, plan->sky_azimuth_step_deg);
    if (plan->thesis && steps.node)
        scene_fail(t->reader, steps.node, "sky_step_deg: expected 15 and 30 in mode \"thesis\"");
}

/* What the scene says elsewhere. */
static void set_defaults(atmosphere_plan *plan, scene_reader *reader)
{
    const double *from = reader->s->camera.target_m, *to = reader->s->camera.position_m;
    const toml_node *node = toml_node_get(toml_node_get(reader->root, "site"), "node");
    char message[256];
    const char *name;
    site_node stated;

    *plan = (atmosphere_plan){.aerosol = 1,
                              .phase = ATMOSPHERE_PHASE_LOWTRAN,
                              .piece_count = 1,
                              .path_zenith_last_deg = 80.0,
                              .path_zenith_step_deg = 2.0,
                              .sky_zenith_step_deg = 15.0,
                              .sky_azimuth_step_deg = 30.0};
    plan->sensor_altitude_m = to[2];
    plan->sensor_azimuth_deg = atan2(to[0] - from[0], to[1] - from[1]) / DEGREE;
    if (!node || toml_node_string(&name, node, message, sizeof message) != 0) return;
    const char *path = scene_add_input(reader, node, reader->s->folder, name);
    if (!path || !scene_took(reader, site_read_node(&stated, path))) return;
    plan->sensor_altitude_m = stated.sensor_altitude_m;
    plan->path_zenith_first_deg = stated.path_zenith_min_deg;
    plan->path_zenith_last_deg = stated.path_zenith_max_deg;
    plan->path_zenith_step_deg = stated.path_zenith_step_deg;
    plan->wavenumber_min_cm1 = stated.wavenumber_min_cm1;
    plan->wavenumber_max_cm1 = stated.wavenumber_max_cm1;
    plan->wavenumber_step_cm1 = stated.wavenumber_step_cm1;
}

void atmosphere_plan_read(atmosphere_plan *out, scene_reader *reader, const toml_node *node)
{
    scene_table t = scene_table_open(reader, node, "atmosphere.generate");
    int mode;

    if (!t.node) return;
    set_defaults(out, reader);
    if (scene_table_word(&t, "mode", modes, COUNT(modes), &mode)) out->thesis = mode == 1;
    read_air(out, &t);
    read_phase(out, &t);
    read_albedo(out, &t);
    read_paths(out, &t);
    read_grids(out, &t);
    read_spectrum(out, &t);
    read_sky(out, &t);
    scene_table_close(&t);
}
