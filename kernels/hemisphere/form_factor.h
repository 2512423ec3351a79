/* Form factor: the fraction of a point's hemisphere that a triangle takes, by its cosine, when nothing stands before
 * it. J. Lambert's formula (Photometria, 1760) of the polygon that is left above the horizon; and whether a direction
 * meets the triangle at all. LANES_WIDTH points side by side. */
#ifndef FORM_FACTOR_H
#define FORM_FACTOR_H

#include "kernels/constants.h"
#include "kernels/dialect.h"
#include "kernels/lanes.h"

/* A triangle as points see it: corners from each. */
typedef struct form_factor_triangle {
    lanes corner[3][3];
} form_factor_triangle;

/* What it is to them. */
typedef struct form_factor_view {
    lanes fraction;   /* of the hemisphere */
    lanes towards[3]; /* a direction into what is above the horizon, of any length */
} form_factor_view;

static inline lanes form_factor_dot(const lanes *a, const lanes *b)
{
    return (a[0] * b[0] + a[1] * b[1]) + a[2] * b[2];
}

static inline void form_factor_cross(const lanes *a, const lanes *b, lanes *out)
{
    for (int k = 0; k < 3; k++) {
        const int i = (k + 1) % 3, j = (k + 2) % 3;
        out[k] = a[i] * b[j] - a[j] * b[i];
    }
}

/* The angle of a sine of 0 or more and a cosine of any common length, within 3e-7: M. Abramowitz and I. Stegun,
 * Handbook of Mathematical Functions (1964), 4.4.49. */
static inline lanes form_factor_angle(lanes sine, lanes cosine)
{
    const lanes none = 0.0f, along = fabs(cosine);
    const lanes ratio = fmin(sine, along) / fmax(fmax(sine, along), 1e-37f + none);
    const lanes square = ratio * ratio;
    lanes sum = 0.0028662257f + none;

    sum = sum * square - 0.0161657367f;
    sum = sum * square + 0.0429096138f;
    sum = sum * square - 0.0752896400f;
    sum = sum * square + 0.1065626393f;
    sum = sum * square - 0.1420889944f;
    sum = sum * square + 0.1999355085f;
    sum = sum * square - 0.3333314528f;
    sum = ratio * (1.0f + square * sum);
    sum = sine > along ? 0.5f * PI_F - sum : sum;
    return cosine < none ? PI_F - sum : sum;
}

/* What the edge from a to b adds: its angle, times how far its plane's normal leans to the horizon's. */
static inline lanes form_factor_edge(const lanes *normal, const lanes *a, const lanes *b)
{
    const lanes least = 1e-30f;
    lanes across[3];

    form_factor_cross(a, b, across);
    const lanes sine = sqrt(form_factor_dot(across, across));
    return form_factor_angle(sine, form_factor_dot(a, b)) * form_factor_dot(across, normal) /
           fmax(sine, least);
}

/*   normal   unit, of the points' horizons */
static inline form_factor_view form_factor_of(const lanes *normal, const form_factor_triangle *t)
{
    const lanes none = 0.0f;
    lanes up[3], leaves[3] = {none, none, none}, enters[3] = {none, none, none}, sum = none;
    form_factor_view view = {none, {none, none, none}};

    for (int v = 0; v < 3; v++) up[v] = form_factor_dot(normal, t->corner[v]);
    for (int v = 0; v < 3; v++) {
        const lanes from = up[v], to = up[(v + 1) % 3];
        const lanes_mask sets = (from > none) & (to <= none), rises = (from <= none) & (to > none);
        const lanes_mask is_seen = (from > none) | (to > none);
        const lanes at = from / (from != to ? from - to : 1.0f + none);
        lanes a[3], b[3];
        for (int k = 0; k < 3; k++) {
            const lanes begin = t->corner[v][k], end = t->corner[(v + 1) % 3][k];
            const lanes crossing = begin + at * (end - begin);
            a[k] = rises ? crossing : begin;
            b[k] = sets ? crossing : end;
            leaves[k] = sets ? crossing : leaves[k];
            enters[k] = rises ? crossing : enters[k];
            view.towards[k] += is_seen ? a[k] + b[k] : none;
        }
        sum += is_seen ? form_factor_edge(normal, a, b) : none;
    }
    sum += form_factor_edge(normal, leaves, enters);
    view.fraction = fabs(sum) / (2.0f * PI_F);
    return view;
}

/* Normals of the planes through a point and the edges of a triangle, turned inwards. */
typedef struct form_factor_cone {
    lanes inward[3][3];
} form_factor_cone;

static inline form_factor_cone form_factor_cone_of(const form_factor_triangle *t)
{
    const lanes none = 0.0f;
    form_factor_cone cone;

    for (int v = 0; v < 3; v++)
        form_factor_cross(t->corner[(v + 1) % 3], t->corner[(v + 2) % 3], cone.inward[v]);
    const lanes_mask is_behind = form_factor_dot(cone.inward[0], t->corner[0]) < none;
    for (int v = 0; v < 3; v++)
        for (int k = 0; k < 3; k++)
            cone.inward[v][k] = is_behind ? -cone.inward[v][k] : cone.inward[v][k];
    return cone;
}

/* Whether a direction goes through the triangle. */
static inline lanes_mask form_factor_meets(const form_factor_cone *cone, const lanes *direction)
{
    const lanes none = 0.0f;

    return (form_factor_dot(cone->inward[0], direction) >= none) &
           (form_factor_dot(cone->inward[1], direction) >= none) &
           (form_factor_dot(cone->inward[2], direction) >= none);
}

#endif
