/* Triangle: where a ray meets it, decided so that no ray slips between neighbours. Woop, Benthin,
 * Wald, "Watertight ray/triangle intersection", JCGT 2(1), 2013.
 *
 * The axes are sheared so that the ray runs along z from the origin. What an edge decides then
 * depends on its two ends alone and changes its sign exactly with their order, because products are
 * not fused (dialect.h). ray.h holds the same test for eight triangles. */
#ifndef TRIANGLE_H
#define TRIANGLE_H

#include "kernels/rays/double_float.h"
#include "kernels/records.h"

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

/* A triangle as a sheared ray sees it. */
typedef struct triangle_sight {
    float x[3], y[3], z[3], edge[3];
    float determinant; /* of the edges: their sum */
    float distance;    /* range times the determinant */
} triangle_sight;

static inline triangle_sight triangle_see(const float vertex[3][3], const float origin[3],
                                          const triangle_shear *s)
{
    triangle_sight t;

    UNROLL
    for (int v = 0; v < 3; v++) {
        t.z[v] = vertex[v][s->z] - origin[s->z];
        t.x[v] = (vertex[v][s->x] - origin[s->x]) - s->slope_x * t.z[v];
        t.y[v] = (vertex[v][s->y] - origin[s->y]) - s->slope_y * t.z[v];
    }
    t.edge[0] = t.x[2] * t.y[1] - t.y[2] * t.x[1];
    t.edge[1] = t.x[0] * t.y[2] - t.y[0] * t.x[2];
    t.edge[2] = t.x[1] * t.y[0] - t.y[1] * t.x[0];
    t.determinant = (t.edge[0] + t.edge[1]) + t.edge[2];
    t.distance = ((t.edge[0] * t.z[0] + t.edge[1] * t.z[1]) + t.edge[2] * t.z[2]) * s->scale_z;
    return t;
}

/* Finds where the ray's line meets the triangle.
 *   out_range    in lengths of the direction; negative behind the origin
 *   out_weight   of the three vertices, 0 .. 1 with sum 1
 * Returns 1 where it is seen counter-clockwise, -1 clockwise, 0 where it is missed or seen edge-on. */
static inline int triangle_meet(const float vertex[3][3], const float origin[3],
                                const triangle_shear *s, float *out_range, float out_weight[3])
{
    const triangle_sight t = triangle_see(vertex, origin, s);

    *out_range = t.distance / t.determinant;
    UNROLL
    for (int v = 0; v < 3; v++) out_weight[v] = t.edge[v] / t.determinant;
    if (t.determinant == 0) return 0;
    if (t.edge[0] >= 0 && t.edge[1] >= 0 && t.edge[2] >= 0) return 1;
    return t.edge[0] <= 0 && t.edge[1] <= 0 && t.edge[2] <= 0 ? -1 : 0;
}

/* The plane of a triangle: normal (not unit) and the corner opposite the longest edge, between the two
 * shorter ones, from which the normal is most accurate. */
typedef struct triangle_plane {
    double_float normal[3];
    uint corner;
} triangle_plane;

static inline triangle_plane triangle_plane_of(const float vertex[3][3])
{
    float longest = -1;
    double_float u[3], v[3];
    triangle_plane plane;

    plane.corner = 0;
    for (uint c = 0; c < 3; c++) {
        const uint a = (c + 1) % 3, b = (c + 2) % 3;
        float square = 0;
        for (int k = 0; k < 3; k++) {
            const float along = vertex[a][k] - vertex[b][k];
            square += along * along;
        }
        if (square <= longest) continue;
        longest = square;
        plane.corner = c;
    }
    for (int k = 0; k < 3; k++) {
        const float from = -vertex[plane.corner][k];
        u[k] = double_float_sum(vertex[(plane.corner + 1) % 3][k], from);
        v[k] = double_float_sum(vertex[(plane.corner + 2) % 3][k], from);
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        double_float back = double_float_multiply(u[b], v[a]);
        back.high = -back.high;
        back.low = -back.low;
        plane.normal[k] = double_float_add(double_float_multiply(u[a], v[b]), back);
    }
    return plane;
}

/* Range to the plane. */
static inline double_float triangle_plane_range(const triangle_plane *plane,
                                                const float vertex[3][3], const float origin[3],
                                                const float direction[3])
{
    double_float distance = {0, 0}, speed = {0, 0};

    for (int k = 0; k < 3; k++) {
        const double_float away = double_float_sum(vertex[plane->corner][k], -origin[k]);
        const double_float along = {direction[k], 0};
        distance = double_float_add(distance, double_float_multiply(plane->normal[k], away));
        speed = double_float_add(speed, double_float_multiply(plane->normal[k], along));
    }
    return double_float_divide(distance, speed);
}

/* A range may be off by so many times what triangle_doubt tells: 8 roundings. */
#define TRIANGLE_ROUNDING 4.76837158203125e-7f

/* Ranges are looked at once more where they may be off by so many times 8 roundings of theirs, and stay
 * where they are right within four. */
#define TRIANGLE_DOUBT 16.0f
#define TRIANGLE_RIGHT 2.384185791015625e-7f

#define TRIANGLE_LONG 4.0f

static inline float triangle_widest(const float of[3])
{
    return fmax(fmax(fabs(of[0]), fabs(of[1])), fabs(of[2]));
}

/* How long the distances are of which the range is the small difference, times the determinant: that
 * of the farthest corner; by how much the range grows where corners are moved by the rounding of their
 * x and y; and what the rounding of the edges weighs. */
static inline float triangle_doubt(const triangle_sight *t, const float scale_z)
{
    const float *x = t->x, *y = t->y, *z = t->z;
    const float u = z[1] - z[0], v = z[2] - z[0];
    const float rise_x = u * (y[2] - y[0]) - v * (y[1] - y[0]);
    const float rise_y = u * (x[2] - x[0]) - v * (x[1] - x[0]);
    const float wide_x = triangle_widest(x), wide_y = triangle_widest(y), far = triangle_widest(z);

    return ((far * fabs(t->determinant) +
             (far + (wide_x + wide_y)) * (fabs(rise_x) + fabs(rise_y))) +
            (wide_x * wide_y) * (fabs(u) + fabs(v))) *
           fabs(scale_z);
}

/* Range to a long triangle, whose edges the ray passes inside. It is right where it lies above 0 and up to
 * the limit. */
static inline float triangle_range(const float vertex[3][3], const float origin[3],
                                   const float direction[3], const triangle_shear *s,
                                   const float limit)
{
    const triangle_sight t = triangle_see(vertex, origin, s);
    const float range = t.distance / t.determinant, doubt = triangle_doubt(&t, s->scale_z);
    const float error = TRIANGLE_ROUNDING * doubt / fabs(t.determinant);

    if (!(doubt > TRIANGLE_DOUBT * fabs(t.distance))) return range;
    if (range + error <= 0 || range - error > limit) return range;
    const triangle_plane plane = triangle_plane_of(vertex);
    const float precise = triangle_plane_range(&plane, vertex, origin, direction).high;
    /* Never beyond what rounding explains: next to an edge the ray may pass beside the triangle. */
    const float below = precise < range + error ? precise : range + error;
    const float near = below > range - error ? below : range - error;
    return fabs(near - range) > TRIANGLE_RIGHT * fabs(near) ? near : range;
}

/* Whether rounding may spoil the ranges of rays to a triangle: its longest edge, times its ratio to the
 * height, is large for its coordinates, by the rounding of which facets may lie before each other, or
 * for what rays keep from surfaces at least (RAY_OFFSET_REACH_M). */
static inline uint triangle_is_long(const float vertex[3][3])
{
    float edge[3][3], normal[3], longest = 0, reach = 0;

    for (int v = 0; v < 3; v++) {
        float square = 0;
        for (int k = 0; k < 3; k++) {
            edge[v][k] = vertex[(v + 1) % 3][k] - vertex[v][k];
            square += edge[v][k] * edge[v][k];
            reach = fmax(reach, fabs(vertex[v][k]));
        }
        longest = fmax(longest, square);
    }
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        normal[k] = edge[0][a] * edge[1][b] - edge[0][b] * edge[1][a];
    }
    const float doubled_area =
        sqrt(normal[0] * normal[0] + normal[1] * normal[1] + normal[2] * normal[2]);
    return longest / doubled_area * sqrt(longest) > TRIANGLE_LONG * fmin(reach, RAY_OFFSET_REACH_M);
}

/* Finds where a ray meets a long triangle from its range, where that must be looked at once more; returns 0
 * where the weights of the corners tell it well enough. */
RARE uint triangle_point(const float vertex[3][3], const float origin[3], const float direction[3],
                         const triangle_shear *s, float out[3])
{
    const triangle_sight t = triangle_see(vertex, origin, s);

    if (!(triangle_doubt(&t, s->scale_z) > TRIANGLE_DOUBT * fabs(t.distance))) return 0;
    const triangle_plane plane = triangle_plane_of(vertex);
    const double_float range = triangle_plane_range(&plane, vertex, origin, direction);
    for (int k = 0; k < 3; k++) {
        const double_float from = {origin[k], 0}, along = {direction[k], 0};
        out[k] = double_float_add(from, double_float_multiply(range, along)).high;
    }
    return 1;
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
