#include "spectrum/spectral_curve.h"

#include "files/file_name.h"
#include "spectrum/spectral_file.h"

#include <math.h>
#include <stdlib.h>
#include <string.h>

#define SEAM                                                                                       \
    1e-9 /* of a wavelength, between the last point of one curve and the first of the next */

void spectral_curve_free(spectral_curve *s)
{
    if (!s) return;
    wavelength_grid_free(&s->grid);
    free(s->value);
    free(s->absorption);
    free(s);
}

const char *spectral_curve_quantity_name(spectral_quantity quantity)
{
    static const char *const names[] = {"emissivity", "reflectance", "transmittance",
                                        "optical constants"};

    return names[quantity];
}

void spectral_curve_take_kirchhoff(spectral_curve *s)
{
    if (s->quantity != SPECTRAL_REFLECTANCE) return;
    for (size_t i = 0; i < s->grid.count; i++) s->value[i] = 1.0 - s->value[i];
    s->quantity = SPECTRAL_EMISSIVITY;
}

static status read_text(spectral_curve **out, const spectral_source *source)
{
    status rc = STATUS_OK;
    record_file *file = NULL;

    TRY(record_file_open(&file, source->path));
    const char *line = record_file_peek(file);
    if (file_name_ends(source->path, ".yml") || file_name_ends(source->path, ".yaml") ||
        (line && !strncmp(line, "REFERENCES:", 11)))
        TRY(refractive_index_file_read(out, file, source->path));
    else if (line && ecostress_file_begins(line))
        TRY(ecostress_file_read(out, file, source->path));
    else if (line && splib_file_begins(line))
        TRY(splib_file_read(out, file, source));
    else if (line && svc_file_begins(line))
        TRY(svc_file_read(out, file, source->path));
    else
        TRY(spectral_table_read(out, file, source->path));
out:
    record_file_free(file);
    return rc;
}

status spectral_curve_read(spectral_curve **out, const spectral_source *source)
{
    if (file_name_ends(source->path, ".sli") || file_name_ends(source->path, ".hdr"))
        return envi_library_read(out, source);
    return read_text(out, source);
}

/* A point of either curve. */
typedef struct joined_point {
    double um, value, absorption;
    wavelength_link link;
    bool is_other;
} joined_point;

static joined_point point_of(const spectral_curve *s, size_t i, bool is_other)
{
    return (joined_point){s->grid.wavelength_um[i], s->value[i],
                          s->absorption ? s->absorption[i] : 0.0, s->grid.link[i], is_other};
}

static int ascending(const void *a, const void *b)
{
    const double first = ((const joined_point *)a)->um, second = ((const joined_point *)b)->um;

    return (first > second) - (first < second);
}

/* Widens the range where both have values. */
static void overlap(double range_um[2], double um)
{
    range_um[0] = fmin(um, range_um[0]);
    range_um[1] = fmax(um, range_um[1]);
}

/* Adds the other curve's value beside an end of the first one's ranges, if it has one there. */
static size_t add_seam(joined_point *out, const spectral_curve *other, double end_um, double um,
                       double overlap_um[2])
{
    if (!wavelength_grid_measures(&other->grid, um)) return 0;
    const wavelength_place at = wavelength_grid_find(&other->grid, 1e4 / um);
    *out = (joined_point){um, wavelength_grid_value(&other->grid, other->value, 1e4 / um), 0.0,
                          other->grid.link[at.low], true};
    if (other->absorption)
        out->absorption = wavelength_grid_value(&other->grid, other->absorption, 1e4 / um);
    overlap(overlap_um, end_um);
    return 1;
}

/* Returns how many points there are: at most two more a point of the first than both have. */
static size_t collect(joined_point *out, const spectral_curve *s, const spectral_curve *other,
                      double overlap_um[2])
{
    size_t n = 0;

    overlap_um[0] = overlap_um[1] = NAN;
    for (size_t i = 0; i < s->grid.count; i++) {
        const double um = s->grid.wavelength_um[i];
        out[n++] = point_of(s, i, false);
        if (i == 0 || s->grid.link[i - 1] == WAVELENGTH_LINK_GAP)
            n += add_seam(out + n, other, um, um * (1.0 - SEAM), overlap_um);
        if (i + 1 == s->grid.count || s->grid.link[i] == WAVELENGTH_LINK_GAP)
            n += add_seam(out + n, other, um, um * (1.0 + SEAM), overlap_um);
    }
    for (size_t i = 0; i < other->grid.count; i++) {
        const double um = other->grid.wavelength_um[i];
        if (wavelength_grid_measures(&s->grid, um))
            overlap(overlap_um, um);
        else
            out[n++] = point_of(other, i, true);
    }
    qsort(out, n, sizeof *out, ascending);
    return n;
}

static status allocate_joined(spectral_curve *out, const spectral_curve *like, size_t count)
{
    status rc = STATUS_OK;

    TRY(wavelength_grid_make(&out->grid, count));
    out->value = malloc(count * sizeof *out->value);
    if (like->absorption) out->absorption = malloc(count * sizeof *out->absorption);
    NEED(out->value && (out->absorption || !like->absorption), STATUS_MEMORY,
         "no memory for %zu wavelengths", count);
out:
    return rc;
}

status spectral_curve_join(spectral_curve *s, const spectral_curve *other, double out_overlap_um[2])
{
    status rc = STATUS_OK;
    spectral_curve *made = calloc(1, sizeof *made);
    joined_point *point = malloc((3 * s->grid.count + other->grid.count) * sizeof *point);

    NEED(made && point, STATUS_MEMORY, "no memory to join spectra");
    const size_t count = collect(point, s, other, out_overlap_um);
    TRY(allocate_joined(made, s, count));
    for (size_t i = 0; i < count; i++) {
        made->grid.wavelength_um[i] = point[i].um;
        made->value[i] = point[i].value;
        if (made->absorption) made->absorption[i] = point[i].absorption;
        made->grid.link[i] = i + 1 < count && point[i].is_other != point[i + 1].is_other
                                 ? WAVELENGTH_LINK_GAP
                                 : point[i].link;
    }
    const spectral_curve old = *s;
    s->grid = made->grid;
    s->value = made->value;
    s->absorption = made->absorption;
    *made = old;
out:
    free(point);
    spectral_curve_free(made);
    return rc;
}
