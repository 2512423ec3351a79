#include "command/material_plot.h"

#include "image/curve.h"
#include "image/picture.h"

#include <math.h>

static const double LOW_UM = 0.35, HIGH_UM = 15.0;

enum { WAVELENGTHS = 2000, DEGREES = 91, LINES = 3 };

/* Not-a-number where nothing is known. */
static double value_at(const scene_material *m, double um, double degrees)
{
    const emissivity *e = m->table;

    if (m->medium != RECORD_NONE) return NAN;
    if (!e) return m->grey_emissivity;
    if (isnan(e->outside) && !wavelength_grid_covers(&e->grid, um)) return NAN;
    return emissivity_at(e, 1e4 / um, degrees);
}

static status draw(const char *path, const char *title, const char *x_unit, const double *x,
                   size_t count, const double *values, const char *const *names)
{
    const curve_line line[LINES] = {{names[0], values, {20, 60, 160}},
                                    {names[1], values + count, {40, 140, 60}},
                                    {names[2], values + 2 * count, {190, 60, 40}}};
    const curve c = {.title = title,
                     .unit = "emissivity",
                     .x_unit = x_unit,
                     .x = x,
                     .count = count,
                     .line = line,
                     .line_count = LINES,
                     .is_log_x = x_unit[0] == 'u'};

    return curve_write(path, &c);
}

status material_plot_write(const scene_material *m, const char *spectrum_path,
                           const char *angle_path)
{
    static const char *const angles[LINES] = {"0 degrees", "60 degrees", "80 degrees"};
    static const char *const wavelengths[LINES] = {"0.55 um", "4 um", "10 um"};
    static const double angle_deg[LINES] = {0.0, 60.0, 80.0}, line_um[LINES] = {.55, 4.0, 10.0};
    static double um[WAVELENGTHS], degrees[DEGREES], over_um[LINES * WAVELENGTHS],
        over_angle[LINES * DEGREES];
    status rc = STATUS_OK;

    if (spectrum_path || angle_path) TRY(picture_prepare());
    for (int i = 0; i < WAVELENGTHS; i++) {
        um[i] = LOW_UM * pow(HIGH_UM / LOW_UM, (double)i / (WAVELENGTHS - 1));
        for (int k = 0; k < LINES; k++)
            over_um[k * WAVELENGTHS + i] = value_at(m, um[i], angle_deg[k]);
    }
    for (int i = 0; i < DEGREES; i++) {
        degrees[i] = i;
        for (int k = 0; k < LINES; k++) over_angle[k * DEGREES + i] = value_at(m, line_um[k], i);
    }
    if (spectrum_path) TRY(draw(spectrum_path, m->name, "um", um, WAVELENGTHS, over_um, angles));
    if (angle_path)
        TRY(draw(angle_path, m->name, "degrees", degrees, DEGREES, over_angle, wavelengths));
out:
    return rc;
}
