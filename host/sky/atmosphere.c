#include "sky/atmosphere.h"

#include "files/output_file.h"
#include "files/record_file.h"
#include "sky/atmosphere_container.h"

#include <errno.h>
#include <math.h>
#include <stdlib.h>
#include <string.h>

#define PER_CM2 1e4        /* W cm-2 to W m-2 */
#define KILOMETRE 1000.0   /* m */
#define RADIANCE_LIMIT 1.0 /* W cm-2 sr-1 um-1: two orders above a bright cloud */
#define ANGLE_TOLERANCE_DEG 1e-3
#define WAVELENGTH_TOLERANCE 1e-4 /* relative */

enum { COUNT_LIMIT = 1000000 };

/* A column of a row: the file's values go from 0 to `limit` and are scaled on the way in. */
typedef struct column {
    double limit, scale;
    double *out;
} column;

static status allocate(double **out, size_t count)
{
    *out = malloc(count * sizeof **out);
    return *out ? STATUS_OK
                : status_set(STATUS_MEMORY, "no memory for %zu numbers of a radiance database",
                             count);
}

static status read_row(record_file *file, const column *columns, size_t count, size_t row,
                       const char *expected)
{
    status rc = STATUS_OK;
    double values[4];

    TRY(record_file_numbers(file, count, values, expected));
    for (size_t i = 0; i < count; i++) {
        if (values[i] < 0.0 || values[i] > columns[i].limit) {
            rc = record_file_reject(file, "%s; number %zu from 0 to %g", expected, i + 1,
                                    columns[i].limit);
            goto out;
        }
        columns[i].out[row] = values[i] * columns[i].scale;
    }
out:
    return rc;
}

static status read_rows(record_file *file, const column *columns, size_t count, int rows,
                        const char *expected)
{
    status rc = STATUS_OK;

    for (int row = 0; row < rows; row++) TRY(read_row(file, columns, count, (size_t)row, expected));
out:
    return rc;
}

static status read_count(record_file *file, int *out, const char *expected)
{
    status rc = STATUS_OK;
    long count;

    TRY(record_file_count(file, 1, COUNT_LIMIT, &count, expected));
    *out = (int)count;
out:
    return rc;
}

/* Is `count` the number of steps from low to high, ends included? */
static bool counts(int count, double low, double high, double step)
{
    return fabs((high - low) - (count - 1) * step) <= 0.01 * step + 1e-9;
}

static bool is_wavelength(double wavelength_um, double wavenumber_cm1)
{
    return fabs(wavelength_um * wavenumber_cm1 / 1e4 - 1.0) <= WAVELENGTH_TOLERANCE;
}

static status read_spectral_grid(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;
    const double low = 100.0, high = 50000.0;

    TRY(record_file_number(file, 1e4 / high, 1e4 / low, &a->wavelength_min_um,
                           "the minimum wavelength in um"));
    TRY(record_file_number(file, a->wavelength_min_um, 1e4 / low, &a->wavelength_max_um,
                           "the maximum wavelength in um"));
    TRY(record_file_number(file, low, high, &a->wavenumber_min_cm1,
                           "the minimum wavenumber in cm-1"));
    if (!is_wavelength(a->wavelength_max_um, a->wavenumber_min_cm1))
        rc = record_file_reject(file, "the wavenumber of %g um", a->wavelength_max_um);
    if (rc != STATUS_OK) goto out;
    TRY(record_file_number(file, low, high, &a->wavenumber_max_cm1,
                           "the maximum wavenumber in cm-1"));
    if (!is_wavelength(a->wavelength_min_um, a->wavenumber_max_cm1))
        rc = record_file_reject(file, "the wavenumber of %g um", a->wavelength_min_um);
    if (rc != STATUS_OK) goto out;
    TRY(record_file_number(file, 1e-3, high, &a->wavenumber_step_cm1,
                           "the wavenumber increment in cm-1"));
    TRY(read_count(file, &a->point_count, "the number of spectral points"));
    if (!counts(a->point_count, a->wavenumber_min_cm1, a->wavenumber_max_cm1,
                a->wavenumber_step_cm1))
        rc = record_file_reject(file, "the number of points from %g to %g cm-1 by %g",
                                a->wavenumber_min_cm1, a->wavenumber_max_cm1,
                                a->wavenumber_step_cm1);
out:
    return rc;
}

static status read_path_grid(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;
    double last;

    TRY(record_file_number(file, 0.0, 90.0, &a->path_zenith_first_deg,
                           "the minimum zenith angle in degrees"));
    TRY(record_file_number(file, a->path_zenith_first_deg, 90.0, &last,
                           "the maximum zenith angle in degrees"));
    TRY(record_file_number(file, 1e-6, 90.0, &a->path_zenith_step_deg,
                           "the zenith angle's increment in degrees"));
    TRY(record_file_number(file, a->path_zenith_first_deg, 90.0, &a->path_zenith_meaningful_deg,
                           "the largest meaningful zenith angle in degrees"));
    TRY(read_count(file, &a->path_count, "the number of zenith angles"));
    if (!counts(a->path_count, a->path_zenith_first_deg, last, a->path_zenith_step_deg))
        rc = record_file_reject(file, "the number of angles from %g to %g degrees by %g",
                                a->path_zenith_first_deg, last, a->path_zenith_step_deg);
out:
    return rc;
}

static status read_sun(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;
    const size_t n = (size_t)a->point_count;

    TRY(allocate(&a->wavelength_um, n));
    TRY(allocate(&a->wavenumber_cm1, n));
    TRY(allocate(&a->solar_irradiance, n));
    TRY(allocate(&a->tau1, n));
    const column columns[] = {{1e3, 1.0, a->wavelength_um},
                              {1e6, 1.0, a->wavenumber_cm1},
                              {RADIANCE_LIMIT, PER_CM2, a->solar_irradiance},
                              {1.0, 1.0, a->tau1}};
    for (size_t i = 0; i < n; i++) {
        const double wavenumber = a->wavenumber_max_cm1 - (double)i * a->wavenumber_step_cm1;
        TRY(read_row(file, columns, 4, i,
                     "wavelength, wavenumber, solar irradiance and transmission"));
        if (fabs(a->wavenumber_cm1[i] - wavenumber) > 0.01 * a->wavenumber_step_cm1 ||
            !is_wavelength(a->wavelength_um[i], a->wavenumber_cm1[i])) {
            rc =
                record_file_reject(file, "%.6f um and %g cm-1 first", 1e4 / wavenumber, wavenumber);
            goto out;
        }
    }
out:
    return rc;
}

static status read_path(atmosphere *a, record_file *file, int path)
{
    status rc = STATUS_OK;
    const size_t first = (size_t)path * (size_t)a->point_count;
    const double zenith_deg = a->path_zenith_first_deg + path * a->path_zenith_step_deg;
    const column columns[] = {{1.0, 1.0, a->tau2 + first},
                              {RADIANCE_LIMIT, PER_CM2, a->path_emitted + first},
                              {RADIANCE_LIMIT, PER_CM2, a->path_scattered + first}};
    double head[2];

    TRY(record_file_numbers(file, 2, head, "a zenith angle and a range in km"));
    if (fabs(head[0] - zenith_deg) > ANGLE_TOLERANCE_DEG || head[1] <= 0.0 || head[1] > 1e5) {
        rc = record_file_reject(file, "the zenith angle %g and a range above 0 km", zenith_deg);
        goto out;
    }
    a->path_range_m[path] = head[1] * KILOMETRE;
    TRY(read_rows(file, columns, 3, a->point_count,
                  "a transmission, emitted and scattered path radiance"));
out:
    return rc;
}

static status read_paths(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;
    const size_t paths = (size_t)a->path_count, size = paths * (size_t)a->point_count;

    TRY(allocate(&a->path_range_m, paths));
    TRY(allocate(&a->tau2, size));
    TRY(allocate(&a->path_emitted, size));
    TRY(allocate(&a->path_scattered, size));
    for (int path = 0; path < a->path_count; path++) TRY(read_path(a, file, path));
out:
    return rc;
}

static status read_sky_rows(double *emitted, double *scattered, record_file *file, int n)
{
    const column columns[] = {{RADIANCE_LIMIT, PER_CM2, emitted},
                              {RADIANCE_LIMIT, PER_CM2, scattered}};

    return read_rows(file, columns, 2, n, "emitted and scattered sky radiance");
}

static status read_sky(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;

    TRY(allocate(&a->sky_emitted, (size_t)a->point_count));
    TRY(allocate(&a->sky_scattered, (size_t)a->point_count));
    TRY(read_sky_rows(a->sky_emitted, a->sky_scattered, file, a->point_count));
out:
    return rc;
}

/* Checks direction number `index` and learns the grid from the first ones: azimuths run until the
 * zenith angle leaves 0, and that angle is then the zenith step. */
static status check_direction(atmosphere *a, const record_file *file, int index,
                              const double direction[2], double last_azimuth)
{
    if (index == 1 && direction[0] == 0.0) a->azimuth_step_deg = direction[1];
    if (a->azimuth_count == 0 && direction[0] > 0.0) {
        a->azimuth_count = index;
        a->zenith_step_deg = direction[0];
        if (index == 0) return record_file_reject(file, "zenith 0 and azimuth 0 first");
        if (index > 1 && fabs(last_azimuth - 360.0) > ANGLE_TOLERANCE_DEG)
            return record_file_reject(file, "zenith 0 and the azimuths up to 360 first");
    }
    const int per_zenith = a->azimuth_count ? a->azimuth_count : index + 1;
    const double zenith = index / per_zenith * a->zenith_step_deg;
    const double azimuth = index % per_zenith * a->azimuth_step_deg;
    if (fabs(direction[0] - zenith) > ANGLE_TOLERANCE_DEG ||
        fabs(direction[1] - azimuth) > ANGLE_TOLERANCE_DEG || zenith > 90.0 + ANGLE_TOLERANCE_DEG)
        return record_file_reject(file, "the zenith angle %g and the azimuth %g", zenith, azimuth);
    return STATUS_OK;
}

static status enlarge_sky(atmosphere *a, int directions)
{
    status rc = STATUS_OK;
    const size_t size = (size_t)directions * (size_t)a->point_count * sizeof(double);
    double *emitted, *scattered;

    emitted = realloc(a->sky_emitted_direction, size);
    NEED(emitted, STATUS_MEMORY, "no memory for the sky radiance of %d directions", directions);
    a->sky_emitted_direction = emitted;
    scattered = realloc(a->sky_scattered_direction, size);
    NEED(scattered, STATUS_MEMORY, "no memory for the sky radiance of %d directions", directions);
    a->sky_scattered_direction = scattered;
out:
    return rc;
}

static status finish_directions(atmosphere *a, const record_file *file, int directions,
                                const double last[2])
{
    a->zenith_count = a->azimuth_count ? directions / a->azimuth_count : 0;
    if (a->zenith_count && directions % a->azimuth_count == 0 &&
        fabs(last[0] - 90.0) <= ANGLE_TOLERANCE_DEG)
        return STATUS_OK;
    return record_file_reject(file,
                              "the direction after zenith %g, azimuth %g: zenith angles go to "
                              "90, each with all azimuths",
                              last[0], last[1]);
}

/* Takes directions until a line holds one number, the count of levels. */
static status read_directions(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;
    const char *text;
    double head[2], last[2] = {0.0, 0.0};
    int index = 0, numbers;

    for (;; index++) {
        TRY(record_file_text(file, &text, "a direction of the sky, or the number of levels"));
        numbers = record_numbers(text, 2, head);
        if (numbers != 2) break;
        TRY(check_direction(a, file, index, head, last[1]));
        TRY(enlarge_sky(a, index + 1));
        const size_t first = (size_t)index * (size_t)a->point_count;
        TRY(read_sky_rows(a->sky_emitted_direction + first, a->sky_scattered_direction + first,
                          file, a->point_count));
        memcpy(last, head, sizeof last);
    }
    if (numbers != 1 || head[0] < 1.0 || head[0] > COUNT_LIMIT || head[0] != floor(head[0])) {
        rc = record_file_reject(file, "two angles of a direction, or the number of levels");
        goto out;
    }
    a->level_count = (int)head[0];
    TRY(finish_directions(a, file, index, last));
out:
    return rc;
}

static status read_levels(atmosphere *a, record_file *file)
{
    status rc = STATUS_OK;
    double level[2];

    TRY(allocate(&a->level_altitude_m, (size_t)a->level_count));
    TRY(allocate(&a->level_temperature_k, (size_t)a->level_count));
    for (int i = 0; i < a->level_count; i++) {
        TRY(record_file_numbers(file, 2, level, "an altitude in km and a temperature in K"));
        a->level_altitude_m[i] = level[0] * KILOMETRE;
        a->level_temperature_k[i] = level[1];
        if (level[1] < 100.0 || level[1] > 1000.0 || level[0] < -1.0 || level[0] > 1000.0 ||
            (i > 0 && a->level_altitude_m[i] <= a->level_altitude_m[i - 1])) {
            rc = record_file_reject(file, "a rising altitude in km and a temperature from 100 to "
                                          "1000 K");
            goto out;
        }
    }
    TRY(record_file_finish(file));
out:
    return rc;
}

status atmosphere_read(atmosphere **out, const char *path)
{
    status rc = STATUS_OK;
    record_file *file = NULL;
    double altitude_km;
    atmosphere *a = NULL;

    if (atmosphere_container_is(path)) return atmosphere_container_read(out, path);
    a = calloc(1, sizeof *a);
    NEED(a, STATUS_MEMORY, "no memory for a radiance database");
    TRY(record_file_open(&file, path));
    TRY(record_file_header(file, &a->header));
    TRY(record_file_number(file, 0.0, 1000.0, &altitude_km, "the sensor altitude in km"));
    a->sensor_altitude_m = altitude_km * KILOMETRE;
    TRY(read_spectral_grid(a, file));
    TRY(read_path_grid(a, file));
    TRY(read_sun(a, file));
    TRY(read_paths(a, file));
    TRY(read_sky(a, file));
    TRY(read_directions(a, file));
    TRY(read_levels(a, file));
    NEED(record_file_is_whole(file), STATUS_FORMAT,
         "%s:%d: the file ends within the line, expected "
         "its line end: a number may be cut",
         path, record_file_line(file));
    *out = a;
    a = NULL;
out:
    record_file_free(file);
    atmosphere_free(a);
    return rc;
}

static void write_spectral_rows(FILE *stream, int n, const double *transmission,
                                const double *emitted, const double *scattered)
{
    for (int i = 0; i < n; i++) {
        if (transmission) fprintf(stream, "%.6e ", transmission[i]);
        fprintf(stream, "%.6e %.6e\n", emitted[i] / PER_CM2, scattered[i] / PER_CM2);
    }
}

static void write_grids(FILE *stream, const atmosphere *a)
{
    fprintf(stream, "%s%.6f\n", a->header, a->sensor_altitude_m / KILOMETRE);
    fprintf(stream, "%.6f\n%.6f\n", a->wavelength_min_um, a->wavelength_max_um);
    fprintf(stream, "%.6f\n%.6f\n", a->wavenumber_min_cm1, a->wavenumber_max_cm1);
    fprintf(stream, "%.6f\n%d\n", a->wavenumber_step_cm1, a->point_count);
    fprintf(stream, "%.6f\n", a->path_zenith_first_deg);
    fprintf(stream, "%.6f\n",
            a->path_zenith_first_deg + (a->path_count - 1) * a->path_zenith_step_deg);
    fprintf(stream, "%.6f\n%.6f\n%d\n", a->path_zenith_step_deg, a->path_zenith_meaningful_deg,
            a->path_count);
}

static void write_sky(FILE *stream, const atmosphere *a)
{
    const int n = a->point_count;

    write_spectral_rows(stream, n, NULL, a->sky_emitted, a->sky_scattered);
    for (int i = 0; i < a->zenith_count * a->azimuth_count; i++) {
        const size_t first = (size_t)i * (size_t)n;
        fprintf(stream, "%.6f %.6f\n", i / a->azimuth_count * a->zenith_step_deg,
                i % a->azimuth_count * a->azimuth_step_deg);
        write_spectral_rows(stream, n, NULL, a->sky_emitted_direction + first,
                            a->sky_scattered_direction + first);
    }
}

static void write_all(FILE *stream, const atmosphere *a)
{
    write_grids(stream, a);
    for (int i = 0; i < a->point_count; i++)
        fprintf(stream, "%.6f %.6f %.6e %.6e\n", a->wavelength_um[i], a->wavenumber_cm1[i],
                a->solar_irradiance[i] / PER_CM2, a->tau1[i]);
    for (int i = 0; i < a->path_count; i++) {
        const size_t first = (size_t)i * (size_t)a->point_count;
        fprintf(stream, "%.6f %.6f\n", a->path_zenith_first_deg + i * a->path_zenith_step_deg,
                a->path_range_m[i] / KILOMETRE);
        write_spectral_rows(stream, a->point_count, a->tau2 + first, a->path_emitted + first,
                            a->path_scattered + first);
    }
    write_sky(stream, a);
    fprintf(stream, "%d\n", a->level_count);
    for (int i = 0; i < a->level_count; i++)
        fprintf(stream, "%.6f %.3f\n", a->level_altitude_m[i] / KILOMETRE,
                a->level_temperature_k[i]);
}

/* The file has no name yet that a reader could open, but its descriptor has. */
status atmosphere_check_file(output_file *file)
{
    status rc = STATUS_OK;
    FILE *stream = output_file_stream(file);
    char path[32], reason[1024];
    atmosphere *a = NULL;

    NEED(fflush(stream) == 0, STATUS_FILE, "%s: %s", output_file_path(file), strerror(errno));
    snprintf(path, sizeof path, "/proc/self/fd/%d", fileno(stream));
    rc = atmosphere_read(&a, path);
    if (rc == STATUS_OK || strncmp(status_last(), path, strlen(path)) != 0) goto out;
    snprintf(reason, sizeof reason, "%s", status_last() + strlen(path));
    rc = status_set(rc, "%s%s", output_file_path(file), reason);
out:
    atmosphere_free(a);
    return rc;
}

status atmosphere_write(const atmosphere *a, const char *path)
{
    status rc = STATUS_OK;
    output_file *file = NULL;

    TRY(output_file_open(&file, path));
    write_all(output_file_stream(file), a);
    TRY(atmosphere_check_file(file));
    TRY(output_file_commit(file));
out:
    output_file_free(file);
    return rc;
}

void atmosphere_free(atmosphere *a)
{
    if (!a) return;
    double *const arrays[] = {a->wavelength_um,
                              a->wavenumber_cm1,
                              a->solar_irradiance,
                              a->tau1,
                              a->path_range_m,
                              a->tau2,
                              a->path_emitted,
                              a->path_scattered,
                              a->sky_emitted,
                              a->sky_scattered,
                              a->sky_emitted_direction,
                              a->sky_scattered_direction,
                              a->level_altitude_m,
                              a->level_temperature_k,
                              a->target_altitude_m,
                              a->target_range_m,
                              a->target_tau,
                              a->target_emitted,
                              a->target_scattered,
                              a->range_m,
                              a->range_tau,
                              a->range_emitted,
                              a->range_scattered};
    for (size_t i = 0; i < sizeof arrays / sizeof arrays[0]; i++) free(arrays[i]);
    free(a->header);
    free(a);
}
