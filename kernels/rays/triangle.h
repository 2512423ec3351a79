/* Triangle: where a ray meets it, decided so that no ray slips between neighbours. Woop, Benthin,
 * Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013.
 *
 * The axes are sheared so that the ray runs along z from the origin. What an edge decides then
 * depends on its two ends alone and changes its sign exactly with their order, because products are
 * not fused (dialect.h). ray.h holds the same test for eight triangles. */
#ifndef TRIANGLE_H
#define TRIANGLE_H

#include "kernels/dialect.h"

/* The shear of a direction. Axis z is its largest component, x and y follow so that a triangle keeps
 * the side that it turns to the ray. */
typedef struct triangle_shear {
    uint x, y, z;
    float slope_x, slope_y, scale_z;
} triangle_shear;

static inline triangle_shear triangle_shear_of(const float direction[3])
{
    triangle_shear s;

    s.z = fabs(direction[1]) > fabs(direction[0]) ? 1 : 0;
    s.z = fabs(direction[2]) > fabs(direction[s.z]) ? 2 : s.z;
    s.x = direction[s.z] < 0 ? (s.z + 2) % 3 : (s.z + 1) % 3;
    s.y = 3 - s.z - s.x;
    s.slope_x = direction[s.x] / direction[s.z];
    s.slope_y = direction[s.y] / direction[s.z];
    s.scale_z = 1.0f / direction[s.z];
    return s;
}

/* Finds where the ray's line meets the triangle.
 *   out_range    in lengths of the direction; negative behind the origin
 *   out_weight   of the three vertices, 0 .. 1 with sum 1
 * Returns 1 where it is seen counter-clockwise, -1 clockwise, 0 where it is missed or seen edge-on. */
static inline int triangle_meet(const float vertex[3][3], const float origin[3],
                                const triangle_shear *s, float *out_range, float out_weight[3])
{
    float x[3], y[3], z[3], edge[3], determinant;

    UNROLL
    for (int v = 0; v < 3; v++) {
        z[v] = vertex[v][s->z] - origin[s->z];
        x[v] = (vertex[v][s->x] - origin[s->x]) - s->slope_x * z[v];
        y[v] = (vertex[v][s->y] - origin[s->y]) - s->slope_y * z[v];
    }
    edge[0] = x[2] * y[1] - y[2] * x[1];
    edge[1] = x[0] * y[2] - y[0] * x[2];
    edge[2] = x[1] * y[0] - y[1] * x[0];
    determinant = (edge[0] + edge[1]) + edge[2];
    *out_range = ((edge[0] * z[0] + edge[1] * z[1]) + edge[2] * z[2]) * s->scale_z / determinant;
    UNROLL
    for (int v = 0; v < 3; v++) out_weight[v] = edge[v] / determinant;
    if (determinant == 0) return 0;
    if (edge[0] >= 0 && edge[1] >= 0 && edge[2] >= 0) return 1;
    return edge[0] <= 0 && edge[1] <= 0 && edge[2] <= 0 ? -1 : 0;
}

/* Unit normal, on the side from which the vertices run counter-clockwise. */
static inline void triangle_normal(const float vertex[3][3], float out[3])
{
    float u[3], v[3], largest = 0, length;

    UNROLL
    for (int k = 0; k < 3; k++) {
        u[k] = vertex[1][k] - vertex[0][k];
        v[k] = vertex[2][k] - vertex[0][k];
    }
    UNROLL
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        out[k] = u[a] * v[b] - u[b] * v[a];
        largest = fabs(out[k]) > largest ? fabs(out[k]) : largest;
    }
    /* The square of a small facet's area would underflow. */
    UNROLL
    for (int k = 0; k < 3; k++) out[k] /= largest;
    length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    UNROLL
    for (int k = 0; k < 3; k++) out[k] /= length;
}

#endif
