#include "database_plot.h"

#include "image/curve.h"
#include "sky_plot.h"

#include <math.h>
#include <stdio.h>

enum { PATH_SIZE = 4096, SHOWN = 3, NAME_SIZE = 48 };

#define LOG_ABOVE 20.0
#define LOG_X_ABOVE 5.0
#define DARK 1e-9 /* W m-2 sr-1 um-1 */

/* Warm for what is emitted, cold for what is scattered. */
static const uint8_t emitted_rgb[SHOWN][3] = {{240, 160, 60}, {215, 80, 30}, {130, 20, 20}};
static const uint8_t scattered_rgb[SHOWN][3] = {{110, 190, 235}, {40, 110, 200}, {30, 40, 120}};

static curve_line line_of(const char *name, const double *value, const uint8_t rgb[3])
{
    return (curve_line){name, value, {rgb[0], rgb[1], rgb[2]}};
}

/* The lowest value above 0 and the highest of all lines. */
static void span_of(const curve *c, double *lowest, double *highest)
{
    *lowest = INFINITY;
    *highest = 0.0;
    for (size_t k = 0; k < c->line_count; k++)
        for (size_t i = 0; i < c->count; i++) {
            const double value = c->line[k].value[i];
            if (value > 0.0) *lowest = fmin(*lowest, value);
            *highest = fmax(*highest, value);
        }
}

/* Writes a picture of the spectra that are not dark all along. */
static status write_spectra(const atmosphere *a, const char *stem, const char *what, curve c)
{
    status rc = STATUS_OK;
    curve_line lit[2 * SHOWN];
    curve one;
    char path[PATH_SIZE];
    double lowest, highest;
    size_t count = 0;

    c.x_unit = "um";
    c.x = a->wavelength_um;
    c.count = (size_t)a->point_count;
    c.is_log_x = a->wavelength_um[c.count - 1] > LOG_X_ABOVE * a->wavelength_um[0];
    one = c;
    one.line_count = 1;
    for (size_t k = 0; k < c.line_count; k++) {
        one.line = &c.line[k];
        span_of(&one, &lowest, &highest);
        if (highest > DARK) lit[count++] = c.line[k];
    }
    if (!count) goto out;
    c.line = lit;
    c.line_count = count;
    span_of(&c, &lowest, &highest);
    c.is_log = c.unit[0] == 'W' && highest > LOG_ABOVE * lowest;
    NEED(snprintf(path, sizeof path, "%s_%s.png", stem, what) < (int)sizeof path, STATUS_ARGUMENT,
         "%s: the name is too long", stem);
    TRY(curve_write(path, &c));
out:
    return rc;
}

/* The first, middle and last path, each once. */
static size_t choose_paths(const atmosphere *a, int out[SHOWN])
{
    const int chosen[SHOWN] = {0, a->path_count / 2, a->path_count - 1};
    size_t count = 0;
    int last = -1;

    for (int i = 0; i < SHOWN; i++)
        if (chosen[i] > last) last = out[count++] = chosen[i];
    return count;
}

static status write_paths(const atmosphere *a, const char *stem)
{
    status rc = STATUS_OK;
    int path[SHOWN];
    char name[3][SHOWN][NAME_SIZE];
    curve_line tau[1 + SHOWN], light[2 * SHOWN];
    const size_t count = choose_paths(a, path);

    tau[0] = line_of("tau1", a->tau1, scattered_rgb[1]);
    for (size_t i = 0; i < count; i++) {
        const size_t first = (size_t)path[i] * (size_t)a->point_count;
        const double zenith = a->path_zenith_first_deg + path[i] * a->path_zenith_step_deg;
        snprintf(name[0][i], NAME_SIZE, "tau2 %g deg", zenith);
        snprintf(name[1][i], NAME_SIZE, "L_uE %g deg", zenith);
        snprintf(name[2][i], NAME_SIZE, "L_uS %g deg", zenith);
        tau[1 + i] = line_of(name[0][i], a->tau2 + first, emitted_rgb[i]);
        light[i] = line_of(name[1][i], a->path_emitted + first, emitted_rgb[i]);
        light[count + i] = line_of(name[2][i], a->path_scattered + first, scattered_rgb[i]);
    }
    TRY(write_spectra(a, stem, "tau",
                      (curve){.title = "transmission: sun to ground, ground to sensor",
                              .unit = "1",
                              .line = tau,
                              .line_count = 1 + count}));
    TRY(write_spectra(a, stem, "path",
                      (curve){.title = "path radiance by zenith angle at the ground",
                              .unit = "W m-2 sr-1 um-1",
                              .line = light,
                              .line_count = 2 * count}));
out:
    return rc;
}

static status write_sun_and_sky(const atmosphere *a, const char *stem)
{
    status rc = STATUS_OK;
    const curve_line sun[] = {line_of("E_S", a->solar_irradiance, emitted_rgb[1])};
    const curve_line sky[] = {line_of("L_DE", a->sky_emitted, emitted_rgb[1]),
                              line_of("L_DS", a->sky_scattered, scattered_rgb[1])};

    TRY(write_spectra(a, stem, "sun",
                      (curve){.title = "solar irradiance outside the atmosphere",
                              .unit = "W m-2 um-1",
                              .line = sun,
                              .line_count = 1}));
    TRY(write_spectra(a, stem, "sky",
                      (curve){.title = "sky, integrated over the hemisphere",
                              .unit = "W m-2 sr-1 um-1",
                              .line = sky,
                              .line_count = 2}));
out:
    return rc;
}

static status write_direction(const atmosphere *a, const char *stem, const char *what,
                              const double *direction)
{
    status rc = STATUS_OK;
    const size_t size = (size_t)a->zenith_count * (size_t)a->azimuth_count * (size_t)a->point_count;
    char path[PATH_SIZE], title[64];
    size_t i = 0;

    while (i < size && direction[i] <= DARK) i++;
    if (i == size) goto out;
    snprintf(title, sizeof title, "sky by direction, %s", what);
    NEED(snprintf(path, sizeof path, "%s_%s.png", stem, what) < (int)sizeof path, STATUS_ARGUMENT,
         "%s: the name is too long", stem);
    TRY(sky_plot_write(path, title, a, direction));
out:
    return rc;
}

status database_plot_write(const atmosphere *a, const char *stem)
{
    status rc = STATUS_OK;

    NEED(a->point_count > 1, STATUS_ARGUMENT, "a database of one wavelength has no curves to draw");
    TRY(write_sun_and_sky(a, stem));
    TRY(write_paths(a, stem));
    TRY(write_direction(a, stem, "emitted", a->sky_emitted_direction));
    TRY(write_direction(a, stem, "scattered", a->sky_scattered_direction));
out:
    return rc;
}
