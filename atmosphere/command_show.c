#include "base/terminal_text.h"
#include "command.h"
#include "database_header.h"
#include "database_plot.h"
#include "image/picture.h"

#include <math.h>
#include <stdio.h>
#include <string.h>

static const char command[] = "radsig-atmosphere show";

static const char purpose[] =
    "Prints what a radiance database, text or container, holds, but for the cards of its runs.\n";

/* The mean over the wavelengths, each row standing for its part of the range. */
static double mean(const atmosphere *a, const double *values)
{
    double sum = 0.0, width = 0.0;

    if (a->point_count == 1) return values[0];
    for (int i = 1; i < a->point_count; i++) {
        const double step = a->wavelength_um[i] - a->wavelength_um[i - 1];
        sum += .5 * step * (values[i] + values[i - 1]);
        width += step;
    }
    return sum / width;
}

static void print_grids(const atmosphere *a)
{
    const double last = a->path_zenith_first_deg + (a->path_count - 1) * a->path_zenith_step_deg;

    printf("%.4g to %.4g um, %d points every %g cm-1\n", a->wavelength_min_um, a->wavelength_max_um,
           a->point_count, a->wavenumber_step_cm1);
    printf("sensor at %g m, %d paths from zenith angle %g to %g degrees\n", a->sensor_altitude_m,
           a->path_count, a->path_zenith_first_deg, last);
    printf("sky every %g x %g degrees\n", a->zenith_step_deg, a->azimuth_step_deg);
    printf("profile of %d levels, %.2f K at %g m\n", a->level_count, a->level_temperature_k[0],
           a->level_altitude_m[0]);
}

static void print_means(const atmosphere *a)
{
    const int n = a->point_count;

    puts("means over the wavelengths, W m-2 sr-1 um-1:");
    printf("  E_S %.4g W m-2 um-1, tau1 %.4f\n", mean(a, a->solar_irradiance), mean(a, a->tau1));
    for (int path = 0; path<a->path_count; path += a->path_count> 1 ? a->path_count - 1 : 1)
        printf("  path at %g degrees, %.0f m: tau2 %.4f, emitted %.4g, scattered %.4g\n",
               a->path_zenith_first_deg + path * a->path_zenith_step_deg, a->path_range_m[path],
               mean(a, a->tau2 + path * n), mean(a, a->path_emitted + path * n),
               mean(a, a->path_scattered + path * n));
    printf("  sky: emitted %.4g, scattered %.4g\n", mean(a, a->sky_emitted),
           mean(a, a->sky_scattered));
    for (int zenith = 0; zenith < a->zenith_count; zenith++) {
        const int first = zenith * a->azimuth_count * n;
        printf("  sky at %g degrees, north: emitted %.4g, scattered %.4g\n",
               zenith * a->zenith_step_deg, mean(a, a->sky_emitted_direction + first),
               mean(a, a->sky_scattered_direction + first));
    }
}

static void print_steps(const atmosphere *a)
{
    const int n = a->point_count, m = a->path_count;

    for (int i = 0; i < a->target_count; i++)
        printf("  target at %g m, path at %g degrees, %.0f m: tau %.4f, emitted %.4g, scattered "
               "%.4g\n",
               a->target_altitude_m[i], a->path_zenith_first_deg, a->target_range_m[i * m],
               mean(a, a->target_tau + i * m * n), mean(a, a->target_emitted + i * m * n),
               mean(a, a->target_scattered + i * m * n));
    for (int i = 0; i < a->range_count; i++)
        printf("  level path of %g m: tau %.4f, emitted %.4g, scattered %.4g\n", a->range_m[i],
               mean(a, a->range_tau + i * n), mean(a, a->range_emitted + i * n),
               mean(a, a->range_scattered + i * n));
}

/* All but the cards, which fill pages. */
static void print_header(char *header)
{
    const char *cards = strstr(header, DATABASE_HEADER_CARDS);

    terminal_text_clean(header);
    fwrite(header, 1, cards ? (size_t)(cards - header) : strlen(header), stdout);
    if (cards) puts("# The cards of all runs are in the file.");
}

static status run(const char *path, const char *plot)
{
    status rc = STATUS_OK;
    atmosphere *a = NULL;

    if (plot) TRY(picture_prepare());
    TRY(atmosphere_read(&a, path));
    print_header(a->header);
    print_grids(a);
    print_means(a);
    print_steps(a);
    if (plot) TRY(database_plot_write(a, plot));
out:
    atmosphere_free(a);
    return rc;
}

int command_show(int argc, char **argv)
{
    const char *plot = NULL;
    option list[] = {
        {"plot", 0, "STEM",
         "draw STEM_sun.png, STEM_tau.png, STEM_path.png, STEM_sky.png by wavelength, "
         "STEM_emitted.png and STEM_scattered.png, the sky by direction: zenith in the "
         "middle, north on top",
         .text = &plot}};
    const option_table table = {
        command, "FILE.rad", 1, 1, purpose, list, sizeof list / sizeof *list};
    const int code = option_table_read(&table, argc, argv, NULL);

    return code == OPTION_TABLE_DONE ? program_end(command, run(argv[1], plot)) : code;
}
