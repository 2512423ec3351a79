#include "mesh/facet_shape.h"

#include "base/interrupt.h"
#include "base/vector.h"

#include <math.h>
#include <stdbool.h>
#include <stdlib.h>

static bool is_finite(const double p[3])
{
    return isfinite(p[0]) && isfinite(p[1]) && isfinite(p[2]);
}

static void set_origin(geometry *g, const double (*position)[3])
{
    double low[3] = {INFINITY, INFINITY, INFINITY}, high[3] = {-INFINITY, -INFINITY, -INFINITY};

    for (uint32_t i = 0; i < g->vertex_count; i++) {
        if (!is_finite(position[i])) continue;
        for (int k = 0; k < 3; k++) {
            low[k] = fmin(low[k], position[i][k]);
            high[k] = fmax(high[k], position[i][k]);
        }
    }
    for (int k = 0; k < 3; k++) {
        if (low[k] > high[k]) low[k] = high[k] = 0.0;
        g->origin_m[k] = round(.5 * (low[k] + high[k]));
        g->low[k] = (float)(low[k] - g->origin_m[k]);
        g->high[k] = (float)(high[k] - g->origin_m[k]);
    }
}

/* Area vector of a polygon: half the sum of the cross products of its corners (Newell). */
static void area_vector(const geometry *g, uint32_t facet, const double (*position)[3],
                        double out[3])
{
    const uint32_t *corner = g->corner[facet];
    const int count = corner[3] == UINT32_MAX ? 3 : 4;
    const double *base = position[corner[0]];

    out[0] = out[1] = out[2] = 0.0;
    for (int k = 1; k + 1 < count; k++) {
        double a[3], b[3];
        for (int i = 0; i < 3; i++) {
            a[i] = position[corner[k]][i] - base[i];
            b[i] = position[corner[k + 1]][i] - base[i];
        }
        out[0] += .5 * (a[1] * b[2] - a[2] * b[1]);
        out[1] += .5 * (a[2] * b[0] - a[0] * b[2]);
        out[2] += .5 * (a[0] * b[1] - a[1] * b[0]);
    }
}

static void set_facet(geometry *g, uint32_t facet, const double (*position)[3])
{
    double a[3], azimuth;

    area_vector(g, facet, position, a);
    const double area = vector_length(a);
    const float stored_m2 = (float)area;
    const bool has_area = isfinite(stored_m2) && stored_m2 > 0.0f;
    for (int k = 0; k < 3; k++) g->normal[facet][k] = has_area ? (float)(a[k] / area) : 0.0f;
    g->area_m2[facet] = has_area ? stored_m2 : 0.0f;
    g->slope_rad[facet] = has_area ? (float)acos(fmax(-1.0, fmin(1.0, a[2] / area))) : 0.0f;
    azimuth = has_area && (a[0] != 0.0 || a[1] != 0.0) ? atan2(a[0], a[1]) : 0.0;
    g->azimuth_rad[facet] = (float)(azimuth < 0.0 ? azimuth + 2.0 * M_PI : azimuth);
}

status facet_shape_set(geometry *g, const double (*position)[3])
{
    status rc = STATUS_OK;

    g->position = malloc((g->vertex_count + 1) * sizeof *g->position);
    g->normal = malloc((g->facet_count + 1) * sizeof *g->normal);
    g->area_m2 = malloc((g->facet_count + 1) * sizeof *g->area_m2);
    g->slope_rad = malloc((g->facet_count + 1) * sizeof *g->slope_rad);
    g->azimuth_rad = malloc((g->facet_count + 1) * sizeof *g->azimuth_rad);
    NEED(g->position && g->normal && g->area_m2 && g->slope_rad && g->azimuth_rad, STATUS_MEMORY,
         "no memory for %u facets", g->facet_count);
    set_origin(g, position);
    for (uint32_t i = 0; i < g->vertex_count; i++)
        for (int k = 0; k < 3; k++) g->position[i][k] = (float)(position[i][k] - g->origin_m[k]);
    for (uint32_t i = 0; i < g->facet_count; i++) {
        TRY(interrupt_check());
        set_facet(g, i, position);
    }
out:
    return rc;
}
