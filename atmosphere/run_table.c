#include "run_table.h"

#include "files/output_file.h"
#include "lowtran_source.h"
#include "sky/atmosphere.h"
#include "sky_weight.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

typedef struct row {
    lowtran_run run; /* its spectra point into `spectra` */
    float *spectra;
    double zenith_deg, azimuth_deg;
    size_t index;
    int grid; /* runs of the same wavenumbers have the same number, from 0 in the order of decks */
} row;

struct run_table {
    size_t count;
    row *rows;
};

enum { SPECTRA = 5, SUN = 3, PATH_TO_SPACE = 3 };
#define EARTH_RADIUS_KM 6371.23 /* LOWTRAN's */
#define DEGREE (M_PI / 180.0)

status run_table_open(run_table **out)
{
    *out = calloc(1, sizeof **out);
    return *out ? STATUS_OK : status_set(STATUS_MEMORY, "no memory for a table of runs");
}

void run_table_free(run_table *t)
{
    if (!t) return;
    for (size_t i = 0; i < t->count; i++) free(t->rows[i].spectra);
    free(t->rows);
    free(t);
}

/* Copies the spectra, turned to ascending wavelength. */
static void turn(float *to, const lowtran_run *run)
{
    const float *const from[SPECTRA] = {run->wavenumber_cm1, run->tau, run->emitted, run->scattered,
                                        run->irradiance};
    const int n = run->point_count;

    for (int k = 0; k < SPECTRA; k++)
        for (int i = 0; i < n; i++) to[k * n + i] = from[k][n - 1 - i];
}

/* Where the path goes: as seen from its lower end. */
static void set_direction(row *r)
{
    const lowtran_run *run = &r->run;

    r->azimuth_deg = run->iparm == 1 ? run->psipo_deg : run->parm1;
    r->zenith_deg = run->angle_deg;
    if (run->angle_deg > 90.0)
        r->zenith_deg =
            asin(fmin(1.0, (EARTH_RADIUS_KM + run->h1_km) / (EARTH_RADIUS_KM + run->h2_km) *
                               sin(run->angle_deg * DEGREE))) /
            DEGREE;
}

status run_table_add(void *table, size_t index, const lowtran_run *run)
{
    status rc = STATUS_OK;
    run_table *t = table;
    const size_t n = (size_t)run->point_count;
    row *larger = realloc(t->rows, (t->count + 1) * sizeof *larger);

    NEED(larger, STATUS_MEMORY, "no memory for a table of runs");
    t->rows = larger;
    row *r = &t->rows[t->count];
    *r = (row){.run = *run, .spectra = malloc(SPECTRA * n * sizeof(float)), .index = index};
    NEED(r->spectra, STATUS_MEMORY, "no memory for a table of runs");
    t->count++;
    turn(r->spectra, run);
    r->run.wavenumber_cm1 = r->spectra;
    r->run.tau = r->spectra + n;
    r->run.emitted = r->spectra + 2 * n;
    r->run.scattered = r->spectra + 3 * n;
    r->run.irradiance = r->spectra + 4 * n;
    set_direction(r);
out:
    return rc;
}

static bool is_sky(const lowtran_run *run)
{
    return run->iemsct != SUN && run->itype == PATH_TO_SPACE;
}

static bool is_path(const lowtran_run *run)
{
    return run->iemsct != SUN && run->itype != PATH_TO_SPACE;
}

static int compare_index(const void *a, const void *b)
{
    const row *x = a, *y = b;

    return (x->index > y->index) - (x->index < y->index);
}

static bool same_grid(const lowtran_run *a, const lowtran_run *b)
{
    return a->point_count == b->point_count &&
           !memcmp(a->wavenumber_cm1, b->wavenumber_cm1,
                   (size_t)a->point_count * sizeof *a->wavenumber_cm1);
}

/* Returns the number of grids. */
static int number_grids(run_table *t)
{
    int count = 0;

    qsort(t->rows, t->count, sizeof *t->rows, compare_index);
    for (size_t i = 0; i < t->count; i++) {
        size_t first = 0;
        while (!same_grid(&t->rows[first].run, &t->rows[i].run)) first++;
        t->rows[i].grid = first < i ? t->rows[first].grid : count++;
    }
    return count;
}

/* By grid; the sun, paths, the sky; each by zenith angle, then by azimuth. */
static int compare(const void *a, const void *b)
{
    const row *x = a, *y = b;
    if (x->grid != y->grid) return x->grid - y->grid;
    const int kind_x = is_path(&x->run) + 2 * is_sky(&x->run);
    const int kind_y = is_path(&y->run) + 2 * is_sky(&y->run);

    if (kind_x != kind_y) return kind_x - kind_y;
    if (x->zenith_deg != y->zenith_deg) return x->zenith_deg < y->zenith_deg ? -1 : 1;
    if (x->azimuth_deg != y->azimuth_deg) return x->azimuth_deg < y->azimuth_deg ? -1 : 1;
    return x->index < y->index ? -1 : 1;
}

static size_t count_kind(const run_table *t, bool (*is_kind)(const lowtran_run *), size_t *first)
{
    size_t count = 0;

    for (size_t i = t->count; i-- > 0;)
        if (is_kind(&t->rows[i].run)) {
            *first = i;
            count++;
        }
    return count;
}

static void write_header(FILE *stream, const run_table *t, const char *const *decks)
{
    fprintf(
        stream,
        "# Runs of LOWTRAN 7 as their decks stand (thesis Figure 2.4-3, Appendix A items 2 and "
        "4).\n"
        "# W cm-2 sr-1 um-1 and km; not averaged. Rows ascend in wavelength. The last value of\n"
        "# the solar rows is the transmission of the run that looks at the sun, else of the\n"
        "# first run. Sections of which no deck speaks are left out; what no run computes is 0.\n"
        "# A deck of several runs gives the last one's numbers.\n" LOWTRAN_SOURCE_HEADER);
    for (size_t i = 0; i < t->count; i++) {
        fprintf(stream, "# Deck %zu:\n", t->rows[i].index + 1);
        for (const char *line = decks[t->rows[i].index]; *line; line += strcspn(line, "\n") + 1)
            fprintf(stream, "#    %.*s\n", (int)strcspn(line, "\n"), line);
    }
}

static void write_grids(FILE *stream, const run_table *t, size_t path, size_t paths)
{
    const lowtran_run *run = &t->rows[0].run;
    const int n = run->point_count;
    const float *nu = run->wavenumber_cm1;
    double sensor_km = run->h1_km, low = 0.0, high = 0.0;

    if (paths) {
        sensor_km = fmax(t->rows[path].run.h1_km, t->rows[path].run.h2_km);
        low = t->rows[path].zenith_deg;
        high = t->rows[path + paths - 1].zenith_deg;
    }
    fprintf(stream, "%f\n%f\n%f\n%f\n%f\n%f\n%d\n", sensor_km, 1e4 / (double)nu[0],
            1e4 / (double)nu[n - 1], (double)nu[n - 1], (double)nu[0],
            n > 1 ? (double)(nu[0] - nu[1]) : 1.0, n);
    fprintf(stream, "%f\n%f\n%f\n%f\n%zu\n", low, high,
            paths > 1 ? (high - low) / (double)(paths - 1) : 1.0, high, paths);
}

static void write_solar(FILE *stream, const run_table *t)
{
    const lowtran_run *run = &t->rows[0].run;

    for (int i = 0; i < run->point_count; i++) {
        const double nu = (double)run->wavenumber_cm1[i];
        fprintf(stream, "%f %f %e %e\n", 1e4 / nu, nu, (double)run->irradiance[i],
                (double)run->tau[i]);
    }
}

static void write_path(FILE *stream, const row *r)
{
    fprintf(stream, "%f %f\n", r->zenith_deg, r->run.range_km);
    for (int i = 0; i < r->run.point_count; i++)
        fprintf(stream, "%e %e %e\n", (double)r->run.tau[i], (double)r->run.emitted[i],
                (double)r->run.scattered[i]);
}

static void write_direction(FILE *stream, const row *r)
{
    fprintf(stream, "%f %f\n", r->zenith_deg, r->azimuth_deg);
    for (int i = 0; i < r->run.point_count; i++)
        fprintf(stream, "%e %e\n", (double)r->run.emitted[i], (double)r->run.scattered[i]);
}

/* Number of azimuths where the directions fill a grid of zenith 0 to 90 and azimuth 0 to 360; else
 * 0. */
static int whole_sky(const row *sky, size_t count)
{
    size_t azimuths = 0;

    while (azimuths < count && sky[azimuths].zenith_deg == 0.0) azimuths++;
    if (azimuths < 2 || count % azimuths || count == azimuths) return 0;
    const size_t zeniths = count / azimuths;
    for (size_t i = 0; i < count; i++) {
        const double zenith = 90.0 * (double)(i / azimuths) / (double)(zeniths - 1);
        const double azimuth = 360.0 * (double)(i % azimuths) / (double)(azimuths - 1);
        if (fabs(sky[i].zenith_deg - zenith) > 1e-3 || fabs(sky[i].azimuth_deg - azimuth) > 1e-3)
            return 0;
    }
    return (int)azimuths;
}

static status write_integral(FILE *stream, const row *sky, int zeniths, int azimuths)
{
    status rc = STATUS_OK;
    const int count = zeniths * azimuths;
    double *weight = malloc((size_t)zeniths * sizeof *weight);
    double *values = malloc((size_t)count * 2 * sizeof *values);

    NEED(weight && values, STATUS_MEMORY, "no memory for the integrated sky");
    sky_weight(zeniths, true, weight);
    for (int i = 0; i < sky[0].run.point_count; i++) {
        for (int k = 0; k < count; k++) {
            values[k] = (double)sky[k].run.emitted[i];
            values[count + k] = (double)sky[k].run.scattered[i];
        }
        fprintf(stream, "%e %e\n", sky_weight_integrate(values, 1, zeniths, azimuths, weight),
                sky_weight_integrate(values + count, 1, zeniths, azimuths, weight));
    }
out:
    free(values);
    free(weight);
    return rc;
}

static status write_rows(FILE *stream, const run_table *t)
{
    status rc = STATUS_OK;
    size_t path = 0, sky = 0;
    const size_t paths = count_kind(t, is_path, &path), skies = count_kind(t, is_sky, &sky);
    const int azimuths = whole_sky(t->rows + sky, skies);

    write_grids(stream, t, path, paths);
    write_solar(stream, t);
    for (size_t i = 0; i < paths; i++) write_path(stream, &t->rows[path + i]);
    if (azimuths) TRY(write_integral(stream, t->rows + sky, (int)skies / azimuths, azimuths));
    for (size_t i = 0; i < skies; i++) write_direction(stream, &t->rows[sky + i]);
    const lowtran_run *last = &t->rows[t->count - 1].run;
    fprintf(stream, "%d\n", last->level_count);
    for (int i = 0; i < last->level_count; i++)
        fprintf(stream, "%f %.3f\n", (double)last->altitude_km[i], (double)last->temperature_k[i]);
out:
    return rc;
}

/* FILE.rad, FILE_2.rad, FILE_3.rad; the caller frees it. */
static char *number_path(const char *path, int grid)
{
    const char *slash = strrchr(path, '/'), *dot = strrchr(path, '.');
    const size_t stem = dot && (!slash || dot > slash) ? (size_t)(dot - path) : strlen(path);
    const size_t size = strlen(path) + 16;
    char *out = malloc(size);

    if (!out) return NULL;
    if (grid == 0)
        snprintf(out, size, "%s", path);
    else
        snprintf(out, size, "%.*s_%d%s", (int)stem, path, grid + 1, path + stem);
    return out;
}

/* Writes the rows of one grid, of which all stand together; the caller commits. */
static status write_grid(run_table *t, const char *const *decks, const char *path, int grid,
                         output_file **out)
{
    status rc = STATUS_OK;
    run_table part = {0};
    char *numbered = number_path(path, grid);

    NEED(numbered, STATUS_MEMORY, "no memory for the name of %s", path);
    for (part.rows = t->rows; part.rows->grid < grid;) part.rows++;
    while (part.rows + part.count < t->rows + t->count && part.rows[part.count].grid == grid)
        part.count++;
    TRY(output_file_open(out, numbered));
    qsort(part.rows, part.count, sizeof *part.rows, compare_index);
    write_header(output_file_stream(*out), &part, decks);
    qsort(part.rows, part.count, sizeof *part.rows, compare);
    TRY(write_rows(output_file_stream(*out), &part));
out:
    free(numbered);
    return rc;
}

/* What ends in .rad is read by radsig. */
static status check_database(output_file *file)
{
    status rc = STATUS_OK;
    const char *dot = strrchr(output_file_path(file), '.');
    char reason[1024];

    if (!dot || strcmp(dot, ".rad") != 0) return STATUS_OK;
    rc = atmosphere_check_file(file);
    if (rc == STATUS_OK || rc == STATUS_MEMORY) return rc;
    snprintf(reason, sizeof reason, "%s", status_last());
    return status_set(
        rc,
        "%s: the decks do not fill a radiance database; what they hold goes to a file "
        "that does not end in .rad",
        reason);
}

status run_table_write(run_table *t, const char *const *decks, const char *path)
{
    status rc = STATUS_OK;
    const int grids = number_grids(t);
    output_file **files = calloc((size_t)grids, sizeof *files);

    NEED(files, STATUS_MEMORY, "no memory for %d files", grids);
    qsort(t->rows, t->count, sizeof *t->rows, compare);
    for (int i = 0; i < grids; i++) TRY(write_grid(t, decks, path, i, &files[i]));
    for (int i = 0; i < grids; i++) TRY(check_database(files[i]));
    TRY(output_file_commit_all(files, (size_t)grids));
out:
    for (int i = 0; files && i < grids; i++) output_file_free(files[i]);
    free(files);
    return rc;
}
