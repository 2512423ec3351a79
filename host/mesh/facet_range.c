#include "mesh/facet_range.h"

#include "base/vector.h"
#include "mesh/polygon.h"

#include <math.h>

/* Finds the range to the plane of a triangle; returns the least weight of its vertices there, below
 * 0 outside, NAN where the ray is parallel to it. Moeller, Trumbore 1997. */
static double meet(const float *a, const float *b, const float *c, const double ray[6],
                   double *out_range)
{
    double u[3], v[3], s[3], p[3], q[3];

    for (int k = 0; k < 3; k++) {
        u[k] = (double)b[k] - (double)a[k];
        v[k] = (double)c[k] - (double)a[k];
        s[k] = ray[k] - (double)a[k];
    }
    vector_cross(ray + 3, v, p);
    vector_cross(s, u, q);
    const double determinant = vector_dot(u, p);
    const double first = vector_dot(s, p) / determinant,
                 second = vector_dot(ray + 3, q) / determinant;
    *out_range = vector_dot(v, q) / determinant;
    return determinant == 0 ? (double)NAN : fmin(1 - first - second, fmin(first, second));
}

double facet_range(const uint32_t corner[4], const float (*position)[3], const double ray[6],
                   double range)
{
    const double beside = -1e-4; /* least weight */
    const uint32_t is_quad = corner[3] != UINT32_MAX;
    const uint32_t d = is_quad ? polygon_diagonal(corner, position) : 0;
    double best = beside;

    for (uint32_t t = 0; t <= is_quad; t++) {
        const float *a = position[corner[d]], *b = position[corner[d + 1 + t]];
        const float *c = position[corner[(d + 2 + t) % 4]];
        double at;
        const double weight = meet(a, b, c, ray, &at);
        if (!(weight >= best && at > 0)) continue;
        best = weight;
        range = at;
    }
    return range;
}
