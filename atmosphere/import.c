#include "import.h"

#include "base/number.h"
#include "database_grid.h"
#include "scene/scene_table.h"
#include "tape7.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

/* Texts and numbers belong to the TOML file. */
typedef struct manifest {
    const char *folder; /* of the manifest, with a final slash, "" for none */
    int folder_length;
    database_grid grid;
    const char *sun;
    const char *const *path, *const *sky;
    size_t path_count, sky_count;
    const double *range_m, *altitude_m, *temperature_k;
    size_t blank_emitted, blank_scattered; /* files that left the column blank */
} manifest;

enum { PATH_SIZE = 4096 };

/* Fails for a list of another length. */
static bool has_count(scene_table *t, const toml_node *node, size_t found, size_t count)
{
    if (found == count) return true;
    scene_fail(t->reader, node, "%s: found %zu, expected %zu", toml_node_name(node), found, count);
    return false;
}

static void read_strings(scene_table *t, const char *key, size_t count, const char *const **out,
                         size_t *out_count)
{
    char message[512];
    const toml_node *node = scene_table_node(t, key);

    scene_table_require(t, key, "a list of tape7 files");
    if (!node) return;
    if (toml_node_strings(out, out_count, node, message, sizeof message) != 0)
        scene_took(t->reader, status_set(STATUS_FORMAT, "%s", message));
    else
        has_count(t, node, *out_count, count);
}

/* count 0: any */
static size_t read_list(scene_table *t, const char *key, size_t count, const double **out)
{
    char message[512];
    size_t found = 0;
    const toml_node *node = scene_table_node(t, key);

    scene_table_require(t, key, "a list of numbers");
    if (!node) return 0;
    if (toml_node_numbers(out, &found, node, message, sizeof message) != 0)
        scene_took(t->reader, status_set(STATUS_FORMAT, "%s", message));
    else
        has_count(t, node, found, count ? count : found);
    return found;
}

static bool divides(double step, double range)
{
    return step > 0.0 && fabs(range / step - round(range / step)) < 1e-6;
}

static void read_grid(scene_table *t, database_grid *grid)
{
    double zenith[3] = {0.0, 0.0, 1.0};
    scene_table sky =
        scene_table_open(t->reader, scene_table_node(t, "sky_step_deg"), "sky_step_deg");

    scene_table_require(t, "sensor_altitude_m", "metres above sea level");
    scene_table_require(t, "path_zenith_deg", "[first, last, step]");
    scene_table_require(t, "sky_step_deg", "{ zenith = 15, azimuth = 30 }");
    scene_table_number(t, "sensor_altitude_m", 0.0, 1e6, &grid->sensor_altitude_m);
    scene_table_numbers(t, "path_zenith_deg", 3, 0.0, 90.0, zenith);
    grid->path_zenith_first_deg = zenith[0];
    grid->path_zenith_last_deg = zenith[1];
    grid->path_zenith_step_deg = zenith[2];
    grid->sky_zenith_step_deg = 15.0;
    grid->sky_azimuth_step_deg = 30.0;
    scene_table_number(&sky, "zenith", 1.0, 45.0, &grid->sky_zenith_step_deg);
    scene_table_number(&sky, "azimuth", 1.0, 180.0, &grid->sky_azimuth_step_deg);
    scene_table_close(&sky);
    if (!divides(grid->sky_zenith_step_deg, 90.0) || !divides(grid->sky_azimuth_step_deg, 360.0) ||
        zenith[1] < zenith[0] || zenith[2] < .01 || !divides(zenith[2], zenith[1] - zenith[0]))
        scene_fail(t->reader, t->node,
                   "path_zenith_deg, sky_step_deg: expected steps that divide "
                   "their ranges");
}

static void read_manifest(manifest *m, scene_reader *reader)
{
    scene_table t = scene_table_open(reader, reader->root, "manifest");
    database_grid *grid = &m->grid;

    read_grid(&t, grid);
    if (reader->failure_count > 0) return;
    const size_t paths =
        1 + (size_t)lround((grid->path_zenith_last_deg - grid->path_zenith_first_deg) /
                           grid->path_zenith_step_deg);
    const size_t rings = (size_t)lround(90.0 / grid->sky_zenith_step_deg);
    const size_t azimuths = (size_t)lround(360.0 / grid->sky_azimuth_step_deg);
    scene_table_require(&t, "sun", "the tape7 file of the run that looks at the sun");
    scene_table_string(&t, "sun", &m->sun);
    read_strings(&t, "path", paths, &m->path, &m->path_count);
    read_strings(&t, "sky", 1 + rings * azimuths, &m->sky, &m->sky_count);
    read_list(&t, "path_range_m", paths, &m->range_m);
    grid->level_count = read_list(&t, "level_altitude_m", 0, &m->altitude_m);
    read_list(&t, "level_temperature_k", grid->level_count, &m->temperature_k);
    scene_table_close(&t);
}

/* Takes the number of a run off a name, "tape7#2"; 0 without one. A file of the whole name is that file. */
static int split_run(char *path)
{
    char *mark = strrchr(path, '#');
    int64_t run = 0;

    if (!mark || access(path, F_OK) == 0 || !number_read_whole(mark + 1, 1, 1000000, &run))
        return 0;
    *mark = '\0';
    return (int)run;
}

/* Reads one file and checks its grid against the database's, if there is one. */
static status read_file(tape7 **out, manifest *m, const char *name, const atmosphere *a)
{
    status rc = STATUS_OK;
    char path[PATH_SIZE];
    tape7 *t = NULL;

    snprintf(path, sizeof path, "%.*s%s", *name == '/' ? 0 : m->folder_length, m->folder, name);
    const int run = split_run(path);
    TRY(tape7_read(&t, path, run));
    m->blank_emitted += t->is_emitted_blank;
    m->blank_scattered += t->is_scattered_blank;
    if (a)
        NEED(t->count == a->point_count &&
                 fabs(t->wavenumber_cm1[0] - a->wavenumber_min_cm1) < 1e-3 &&
                 fabs(t->wavenumber_cm1[t->count - 1] - a->wavenumber_max_cm1) < 1e-3,
             STATUS_FORMAT, "%s: %d points from %g to %g cm-1, expected %d from %g to %g", path,
             t->count, t->wavenumber_cm1[0], t->wavenumber_cm1[t->count - 1], a->point_count,
             a->wavenumber_min_cm1, a->wavenumber_max_cm1);
    *out = t;
    t = NULL;
out:
    tape7_free(t);
    return rc;
}

/* Copies a column, turned to ascending wavelength. */
static status take(double *to, const double *from, int n, const char *file, const char *column)
{
    status rc = STATUS_OK;

    NEED(from, STATUS_FORMAT, "%s: expected a column %s", file, column);
    for (int i = 0; i < n; i++) to[i] = from[n - 1 - i];
out:
    return rc;
}

static status take_sun(atmosphere **out, manifest *m)
{
    status rc = STATUS_OK;
    tape7 *t = NULL;

    TRY(read_file(&t, m, m->sun, NULL));
    m->grid.wavenumber_min_cm1 = t->wavenumber_cm1[0];
    m->grid.wavenumber_max_cm1 = t->wavenumber_cm1[t->count - 1];
    m->grid.wavenumber_step_cm1 = t->wavenumber_cm1[1] - t->wavenumber_cm1[0];
    TRY(database_grid_make(out, &m->grid));
    TRY(take((*out)->solar_irradiance, t->solar, t->count, m->sun, "SOLAR"));
    TRY(take((*out)->tau1, t->transmission, t->count, m->sun, "TRANS"));
out:
    tape7_free(t);
    return rc;
}

static status take_path(atmosphere *a, manifest *m, size_t path)
{
    status rc = STATUS_OK;
    tape7 *t = NULL;
    const char *name = m->path[path];
    const size_t first = path * (size_t)a->point_count;

    TRY(read_file(&t, m, name, a));
    a->path_range_m[path] = m->range_m[path];
    TRY(take(a->tau2 + first, t->transmission, t->count, name, "TOT TRANS"));
    TRY(take(a->path_emitted + first, t->emitted, t->count, name, "PTH THRML"));
    TRY(take(a->path_scattered + first, t->scattered, t->count, name, "SOL SCAT"));
out:
    tape7_free(t);
    return rc;
}

/* File 0 is the zenith; then each ring from azimuth 0 on, whose 360 repeats its 0. */
static status take_sky(atmosphere *a, manifest *m, size_t file)
{
    status rc = STATUS_OK;
    tape7 *t = NULL;
    const char *name = m->sky[file];
    const int azimuths = a->azimuth_count - 1;
    const int zenith = file ? 1 + (int)(file - 1) / azimuths : 0;
    const int azimuth = file ? (int)(file - 1) % azimuths : 0;

    TRY(read_file(&t, m, name, a));
    for (int i = 0; i < a->azimuth_count; i++) {
        if (zenith && i != azimuth && !(azimuth == 0 && i == azimuths)) continue;
        const size_t first = (size_t)(zenith * a->azimuth_count + i) * (size_t)a->point_count;
        TRY(take(a->sky_emitted_direction + first, t->emitted, t->count, name, "PTH THRML"));
        TRY(take(a->sky_scattered_direction + first, t->scattered, t->count, name, "SOL SCAT"));
    }
out:
    tape7_free(t);
    return rc;
}

static void warn_of_blanks(const manifest *m)
{
    if (m->blank_emitted)
        status_warn("PTH THRML is blank in %zu files, of runs without heat (IEMSCT 4): 0 is taken",
                    m->blank_emitted);
    if (m->blank_scattered)
        status_warn(
            "SOL SCAT is blank in %zu files, of runs without sunlight (IEMSCT 1): 0 is taken",
            m->blank_scattered);
}

static status take_all(atmosphere **out, manifest *m)
{
    status rc = STATUS_OK;
    atmosphere *a = NULL;

    TRY(take_sun(&a, m));
    for (size_t i = 0; i < m->path_count; i++) TRY(take_path(a, m, i));
    for (size_t i = 0; i < m->sky_count; i++) TRY(take_sky(a, m, i));
    for (size_t i = 0; i < m->grid.level_count; i++) {
        a->level_altitude_m[i] = m->altitude_m[i];
        a->level_temperature_k[i] = m->temperature_k[i];
    }
    TRY(database_grid_integrate(a, false));
    warn_of_blanks(m);
    a->header = strdup("# Radiance database imported from MODTRAN's tape7 files by "
                       "radsig-atmosphere " RADSIG_VERSION ".\n");
    NEED(a->header, STATUS_MEMORY, "no memory for the header of a radiance database");
    *out = a;
    a = NULL;
out:
    atmosphere_free(a);
    return rc;
}

status import_read(atmosphere **out, const char *path)
{
    status rc = STATUS_OK;
    char message[2048];
    toml_file *file = NULL;
    const char *slash = strrchr(path, '/');
    manifest m = {.folder = path, .folder_length = slash ? (int)(slash - path) + 1 : 0};
    scene paper = {.path = (char *)path}; /* messages name it */
    scene_reader reader = {.s = &paper};

    NEED(toml_file_read(&file, path, NULL, 0, message, sizeof message) == 0, STATUS_FORMAT, "%s",
         message);
    reader.root = toml_file_root(file);
    read_manifest(&m, &reader);
    if (reader.failure_count > 0) {
        rc = STATUS_FORMAT;
        goto out;
    }
    TRY(take_all(out, &m));
out:
    toml_file_free(file);
    return rc;
}
