#include "spectrum/wavelength_grid.h"

#include <math.h>
#include <stdio.h>
#include <stdlib.h>

#define HELD_SHARE 0.1  /* of the wavelength of an end */
#define HELD_ON_UM 13.5 /* what ends here or later ends with its instrument's range */
#define BEYOND 1e-9     /* of a wavelength, to step out of what is covered */

status wavelength_grid_make(wavelength_grid *out, size_t count)
{
    status rc = STATUS_OK;

    *out = (wavelength_grid){.count = count,
                             .wavelength_um = malloc(count * sizeof *out->wavelength_um),
                             .link = calloc(count, sizeof *out->link)};
    NEED(out->wavelength_um && out->link, STATUS_MEMORY, "no memory for %zu wavelengths", count);
out:
    return rc;
}

void wavelength_grid_free(wavelength_grid *grid)
{
    free(grid->wavelength_um);
    free(grid->link);
    *grid = (wavelength_grid){0};
}

static wavelength_place find_even(const wavelength_grid *grid, double wavenumber_cm1)
{
    const double last = (double)(grid->count - 1);
    const double place = fmax(0.0, fmin((grid->first_cm1 - wavenumber_cm1) / grid->step_cm1, last));
    const size_t low = place >= last ? grid->count - 2 : (size_t)place;

    return (wavelength_place){low, place - (double)low};
}

/* The last point at or before a wavelength; the first, and the last but one, beyond the ends. */
static size_t find_low(const wavelength_grid *grid, double wavelength_um)
{
    size_t low = 0, high = grid->count - 1;

    while (high - low > 1) {
        const size_t middle = (low + high) / 2;
        if (grid->wavelength_um[middle] <= wavelength_um)
            low = middle;
        else
            high = middle;
    }
    return low;
}

/* In a gap the values of its ends hold as far as they do beyond the last ones; between, where a wide one is not
 * covered, and over a narrow one they are joined. */
static double fraction_in_gap(double um, double low_um, double high_um)
{
    const double held_low = low_um * (1.0 + HELD_SHARE), held_high = high_um * (1.0 - HELD_SHARE);

    if (held_low >= held_high) return (um - low_um) / (high_um - low_um);
    return (um - held_low) / (held_high - held_low);
}

wavelength_place wavelength_grid_find(const wavelength_grid *grid, double wavenumber_cm1)
{
    if (!grid->wavelength_um) return find_even(grid, wavenumber_cm1);
    const double um = 1e4 / wavenumber_cm1;
    const size_t low = find_low(grid, um);
    const double *l = grid->wavelength_um + low;
    double fraction = (um - l[0]) / (l[1] - l[0]);
    if (grid->link[low] == WAVELENGTH_LINK_CM1)
        fraction = (1e4 / l[0] - wavenumber_cm1) / (1e4 / l[0] - 1e4 / l[1]);
    if (grid->link[low] == WAVELENGTH_LINK_GAP) fraction = fraction_in_gap(um, l[0], l[1]);
    return (wavelength_place){low, fmax(0.0, fmin(fraction, 1.0))};
}

double wavelength_grid_value(const wavelength_grid *grid, const double *value,
                             double wavenumber_cm1)
{
    const wavelength_place at = wavelength_grid_find(grid, wavenumber_cm1);

    return value[at.low] + at.fraction * (value[at.low + 1] - value[at.low]);
}

bool wavelength_grid_measures(const wavelength_grid *grid, double wavelength_um)
{
    const double *l = grid->wavelength_um;

    if (!l) return true;
    if (wavelength_um < l[0] || wavelength_um > l[grid->count - 1]) return false;
    const size_t low = find_low(grid, wavelength_um);
    return grid->link[low] != WAVELENGTH_LINK_GAP || wavelength_um == l[low] ||
           wavelength_um == l[low + 1];
}

/* The farthest wavelength that the value of an end is held to, towards longer ones. */
static double held_up_to(double end_um)
{
    return end_um >= HELD_ON_UM ? (double)INFINITY : end_um * (1.0 + HELD_SHARE);
}

/* How far from a wavelength on all is covered; not beyond it: the wavelength is not covered. */
static double covered_up_to(const wavelength_grid *grid, double from_um)
{
    const double *l = grid->wavelength_um;
    double reach = from_um;

    for (size_t i = 0, end; i < grid->count; i = end + 1) {
        for (end = i; end + 1 < grid->count && grid->link[end] != WAVELENGTH_LINK_GAP; end++) {
        }
        const double low = l[i] * (1.0 - HELD_SHARE), high = held_up_to(l[end]);
        if (low <= reach && high > reach) reach = high;
    }
    return reach;
}

bool wavelength_grid_covers(const wavelength_grid *grid, double wavelength_um)
{
    return isnan(wavelength_grid_uncovered(grid, wavelength_um, wavelength_um));
}

double wavelength_grid_uncovered(const wavelength_grid *grid, double low_um, double high_um)
{
    if (!grid->wavelength_um) return NAN;
    const double from_um = low_um * (1.0 - BEYOND);
    const double reach = covered_up_to(grid, from_um);
    if (!(reach > from_um)) return low_um;
    return reach * (1.0 + BEYOND) >= high_um ? (double)NAN : reach;
}

const char *wavelength_grid_text(const wavelength_grid *grid, char *out, size_t size)
{
    size_t length = 0;

    *out = '\0';
    for (size_t i = 0, end; i < grid->count && length < size; i = end + 1) {
        for (end = i; end + 1 < grid->count && grid->link[end] != WAVELENGTH_LINK_GAP; end++) {
        }
        length += (size_t)snprintf(out + length, size - length, "%s%.4g to %.4g", i ? ", " : "",
                                   grid->wavelength_um[i], grid->wavelength_um[end]);
    }
    return out;
}
