#include "render/render_plane.h"

#include "base/spelling.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct plane_kind {
    const char *name, *unit;
    bool categorical;
} plane_kind;

enum { TEMPERATURE = 4, BACKGROUND_TEMPERATURE = 5, SHAPE_FACTOR = 8 };

/* As truth.cl and sun_times.cl write them. */
static const plane_kind truth_kinds[TRUTH_PLANES + SUN_PLANES] = {
    {"material", "number", true},
    {"background_material", "number", true},
    {"sunlit", "0..1", false},
    {"background_sunlit", "0..1", false},
    {"temperature_c", "C", false},
    {"background_temperature_c", "C", false},
    {"interaction", "number", true},
    {"view_angle_deg", "degrees", false},
    {"shape_factor", "cosine", false},
    {"range_m", "m", false},
    {"facet", "number", true},
    {"hours_lit_24h", "h", false},
    {"minutes_since_sun_change", "min", false},
};

static const char radiance_unit[] = "W m-2 sr-1";

/* As band_planes.cl writes them. */
static const plane_kind band_kinds[BAND_PLANES] = {
    {"radiance_%s", radiance_unit, false},
    {"counts_%s", "counts", false},
    {"apparent_temperature_%s_c", "C", false},
    {"emissivity_%s", "1", false},
    {"background_emissivity_%s", "1", false},
    {"emitted_%s", radiance_unit, false},
    {"reflected_sun_%s", radiance_unit, false},
    {"reflected_sky_%s", radiance_unit, false},
    {"reflected_background_%s", radiance_unit, false},
    {"path_%s", radiance_unit, false},
    {"transmission_%s", "1", false},
    {"stderr_%s", radiance_unit, false},
};

static render_plane truth_plane(const scene *s, uint32_t kind)
{
    const plane_kind *k = &truth_kinds[kind];
    render_plane p = {.source = kind,
                      .is_surface_c = kind == TEMPERATURE || kind == BACKGROUND_TEMPERATURE,
                      .plane = {.unit = k->unit, .categorical = k->categorical}};

    snprintf(p.name, sizeof p.name, "%s", k->name);
    /* Its unit is its reading. */
    if (s->thesis && kind == SHAPE_FACTOR) p.plane.unit = "thesis eq. 2.4.2-6";
    return p;
}

static render_plane band_plane(const scene *s, uint32_t index, uint32_t kind, double centre_um,
                               double width_um)
{
    const plane_kind *k = &band_kinds[kind];
    render_plane p = {.source = index * BAND_PLANES + kind,
                      .is_of_band = true,
                      .is_radiance = kind == 0,
                      .is_part = kind >= BAND_PARTS && kind < BAND_PARTS + RADIANCE_PARTS,
                      .plane = {.unit = k->unit}};

    snprintf(p.name, sizeof p.name, k->name, s->bands[index].name);
    if (p.is_radiance) {
        p.plane.wavelength_um = centre_um;
        p.plane.fwhm_um = width_um;
    }
    if (s->bands[index].is_mean && k->unit == radiance_unit) p.plane.unit = "W m-2 sr-1 um-1";
    return p;
}

status render_plane_list(render_plane **out, size_t *out_count, const scene *s,
                         const double *centre_um, const double *width_um)
{
    status rc = STATUS_OK;
    const size_t count = TRUTH_PLANES + SUN_PLANES + (size_t)s->band_count * BAND_PLANES;
    render_plane *list = calloc(count, sizeof *list);
    size_t n = 0;

    NEED(list, STATUS_MEMORY, "no memory for the list of planes");
    for (uint32_t b = 0; b < s->band_count; b++)
        list[n++] = band_plane(s, b, 0, centre_um[b], width_um[b]);
    for (uint32_t k = 0; k < TRUTH_PLANES + SUN_PLANES; k++) list[n++] = truth_plane(s, k);
    for (uint32_t b = 0; b < s->band_count; b++)
        for (uint32_t k = 1; k < BAND_PLANES; k++)
            if (k != BAND_STDERR || s->samples_per_side > 1)
                list[n++] = band_plane(s, b, k, 0.0, 0.0);
    for (size_t i = 0; i < n; i++) list[i].plane.name = list[i].name;
    *out = list;
    *out_count = n;
out:
    return rc;
}

status render_plane_check(const render_plane *list, size_t count, const char *name)
{
    spelling near = spelling_of(name);
    char hint[SPELLING_HINT_SIZE];

    for (size_t i = 0; i < count; i++) {
        if (!strcmp(list[i].name, name)) return STATUS_OK;
        spelling_offer(&near, list[i].name);
    }
    return status_set(STATUS_ARGUMENT, "there is no plane '%s' in this scene%s", name,
                      spelling_hint(&near, "", hint));
}
