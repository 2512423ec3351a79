/* Ray lanes: 16 rays made ready, and their tests against boxes and triangles. What is computed is what
 * ray.h and triangle.h compute, operation by operation. */
#ifndef RAY_LANES_H
#define RAY_LANES_H

#include "kernels/rays/ray.h"

/* Bounds over the lanes of where they pass a plane of a box, along one axis: the two extreme
 * reciprocals, each with what ray_frame calls near and far. */
typedef struct ray_lanes_bound {
    float reciprocal[2], near[2], far[2];
} ray_lanes_bound;

/* A lane that is not alive is a copy of one that is, so that it widens no bounds. The shear is that of
 * triangle.h, but x and y never change places: that would change the signs of all edges and nothing
 * else. */
typedef struct ray_lanes {
    float16 reciprocal[3], near[3], far[3];
    float16 origin[3];                          /* along the shear's x, y and z */
    const float (*start)[16], (*direction)[16]; /* of the world, as given */
    float16 slope_x, slope_y, scale_z;
    int16 along_y, along_z; /* the shear's z is that axis of the world, else x */
    float16 front, back; /* edges are met from front up and from back down; see ray_lanes_inside */
    uint axis;           /* the shear's z of all lanes, 3 where they differ */
    uint near_plane[3], far_plane[3]; /* of that octant: where a node has them, counted in floats */
    uint octant;                      /* of the first lane: bit 0 x, 1 y, 2 z negative */
    uint coherent;                    /* all lanes have this octant: bound is set */
    ray_lanes_bound bound[3];
} ray_lanes;

/* Takes the lowest bit of a mask. */
static inline uint ray_lanes_next(uint *mask)
{
    const uint lane = 31 - clz(*mask & -*mask);

    *mask &= *mask - 1;
    return lane;
}

static inline int16 ray_lanes_of_mask(const uint mask)
{
    const int16 bit = {1 << 0, 1 << 1, 1 << 2,  1 << 3,  1 << 4,  1 << 5,  1 << 6,  1 << 7,
                       1 << 8, 1 << 9, 1 << 10, 1 << 11, 1 << 12, 1 << 13, 1 << 14, 1 << 15};

    return ((int16)(int)mask & bit) != 0;
}

static inline float16 ray_lanes_least(const float16 a, const float16 b)
{
    return a < b ? a : b;
}

static inline float16 ray_lanes_most(const float16 a, const float16 b)
{
    return a > b ? a : b;
}

/* The lowest of neighbours: pairs of the first in the low half, of the second in the high. */
static inline float16 ray_lanes_fold(const float16 a, const float16 b)
{
    return ray_lanes_least((float16)(a.even, b.even), (float16)(a.odd, b.odd));
}

/* The lowest lane of each of eight. */
static inline float8 ray_lanes_lowest(const float16 of[8])
{
    const float16 first =
        ray_lanes_fold(ray_lanes_fold(of[0], of[1]), ray_lanes_fold(of[2], of[3]));
    const float16 last = ray_lanes_fold(ray_lanes_fold(of[4], of[5]), ray_lanes_fold(of[6], of[7]));
    const float16 pairs = ray_lanes_fold(first, last);

    return ray_least(pairs.even, pairs.odd);
}

static inline void ray_lanes_set_shear(ray_lanes *f, const float16 o[3], const float16 d[3],
                                       const uint cull_back)
{
    const int16 y_over_x = fabs(d[1]) > fabs(d[0]);
    const int16 along_z = fabs(d[2]) > (y_over_x ? fabs(d[1]) : fabs(d[0]));
    const int16 along_y = y_over_x & ~along_z;
    const float16 z = along_z ? d[2] : along_y ? d[1] : d[0];
    const uint y_lanes = mask_of_16(along_y), z_lanes = mask_of_16(along_z);

    f->along_y = along_y;
    f->along_z = along_z;
    f->slope_x = (along_z ? d[0] : along_y ? d[2] : d[1]) / z;
    f->slope_y = (along_z ? d[1] : along_y ? d[0] : d[2]) / z;
    f->scale_z = 1.0f / z;
    f->origin[0] = along_z ? o[0] : along_y ? o[2] : o[1];
    f->origin[1] = along_z ? o[1] : along_y ? o[0] : o[2];
    f->origin[2] = along_z ? o[2] : along_y ? o[1] : o[0];
    if (cull_back) {
        f->front = z < 0.0f ? (float16)INFINITY : (float16)0.0f;
        f->back = z < 0.0f ? (float16)0.0f : (float16)-INFINITY;
    }
    f->axis = 3;
    if (z_lanes == 0xffff) f->axis = 2;
    if (y_lanes == 0xffff) f->axis = 1;
    if ((y_lanes | z_lanes) == 0) f->axis = 0;
}

/* Sets the bounds, twice a ray's pad wider, so that no rounding makes them narrower than a ray's own. */
static inline void ray_lanes_set_bounds(ray_lanes *f, const float16 o[3])
{
    const float16 all[8] = {o[0], o[1], o[2], f->reciprocal[0], f->reciprocal[1], f->reciprocal[2],
                            0,    0};
    float16 reversed[8];
    float low[8], high[8];

    UNROLL
    for (int i = 0; i < 8; i++) reversed[i] = -all[i];
    const float8 lowest = ray_lanes_lowest(all), highest = -ray_lanes_lowest(reversed);
    const float8 reach = ray_most(-lowest, highest);
    const float reach_xy = reach.s0 > reach.s1 ? reach.s0 : reach.s1;
    const float pad = 2.0f * RAY_PAD * (reach_xy > reach.s2 ? reach_xy : reach.s2);
    vstore8(lowest, 0, low);
    vstore8(highest, 0, high);
    UNROLL
    for (int k = 0; k < 3; k++) {
        ray_lanes_bound *b = &f->bound[k];
        const uint negative = f->octant >> k & 1;
        const float first = negative ? high[k] + pad : low[k] - pad;
        const float last = negative ? low[k] - pad : high[k] + pad;
        b->reciprocal[0] = low[3 + k];
        b->reciprocal[1] = high[3 + k];
        UNROLL
        for (int i = 0; i < 2; i++) {
            b->near[i] = -last * b->reciprocal[i];
            b->far[i] = -first * b->reciprocal[i];
        }
    }
}

/* Makes 16 rays ready.
 *   alive     a bit per lane in use, at least one
 *   bounded   0: the bounds are not needed */
static inline ray_lanes ray_lanes_of(const float origin[3][16], const float direction[3][16],
                                     const uint alive, const uint cull_back, const uint bounded)
{
    const uint first = 31 - clz(alive & -alive);
    const int16 in_use = ray_lanes_of_mask(alive);
    ray_lanes f = {
        .front = 0, .back = 0, .octant = 0, .coherent = 1, .start = origin, .direction = direction};
    float16 o[3], d[3], reach = 0;

    UNROLL
    for (int k = 0; k < 3; k++) {
        o[k] = in_use ? *(const float16 *)origin[k] : (float16)origin[k][first];
        d[k] = in_use ? *(const float16 *)direction[k] : (float16)direction[k][first];
        reach = ray_lanes_most(fabs(o[k]), reach);
    }
    ray_lanes_set_shear(&f, o, d, cull_back);
    const float16 pad = RAY_PAD * reach;
    UNROLL
    for (int k = 0; k < 3; k++) {
        const float16 least = copysign((float16)1e-18f, d[k]);
        f.reciprocal[k] = 1.0f / (fabs(d[k]) < 1e-18f ? least : d[k]);
        f.near[k] = -o[k] * f.reciprocal[k] - pad * fabs(f.reciprocal[k]);
        f.far[k] = -o[k] * f.reciprocal[k] + pad * fabs(f.reciprocal[k]);
        const uint negative = mask_of_16(f.reciprocal[k] < 0.0f);
        const uint is_negative = negative >> first & 1;
        f.octant |= is_negative << k;
        f.near_plane[k] = 8 * k + 24 * is_negative;
        f.far_plane[k] = 8 * k + 24 * !is_negative;
        f.coherent &= negative == 0 || negative == 0xffff;
    }
    if (bounded && f.coherent) ray_lanes_set_bounds(&f, o);
    return f;
}

/* Finds the children that a ray of the packet may enter: a bit each. */
static inline uint ray_lanes_reach(const ray_lanes *f, global const bvh_node *node)
{
    float8 from = 0, to = MAXFLOAT;

    UNROLL
    for (int k = 0; k < 3; k++) {
        const float8 a = *(global const float8 *)(node->low[0] + f->near_plane[k]);
        const float8 b = *(global const float8 *)(node->low[0] + f->far_plane[k]);
        const ray_lanes_bound *n = &f->bound[k];
        from = ray_most(ray_least(fma(a, (float8)n->reciprocal[0], (float8)n->near[0]),
                                  fma(a, (float8)n->reciprocal[1], (float8)n->near[1])),
                        from);
        to = ray_least(ray_most(fma(b, (float8)n->reciprocal[0], (float8)n->far[0]),
                                fma(b, (float8)n->reciprocal[1], (float8)n->far[1])),
                       to);
    }
    return mask_of_8(from <= to);
}

/* Finds the rays that enter a child before their limits, and where: all bits of a lane.
 *   coherent   of the lanes: a constant, so that each kind has code of its own */
INLINE int16 ray_lanes_enter(const ray_lanes *f, global const bvh_node *node, const uint child,
                             const uint coherent, const float16 limit, float16 *out_range)
{
    global const float *planes = node->low[0];
    float16 from = 0, to = limit;

    UNROLL
    for (int k = 0; k < 3; k++) {
        float16 a, b;
        if (coherent) {
            a = planes[f->near_plane[k] + child];
            b = planes[f->far_plane[k] + child];
        } else {
            const float16 low = node->low[k][child], high = node->high[k][child];
            const int16 negative = f->reciprocal[k] < 0.0f;
            a = negative ? high : low;
            b = negative ? low : high;
        }
        from = ray_lanes_most(fma(a, f->reciprocal[k], f->near[k]), from);
        to = ray_lanes_least(fma(b, f->reciprocal[k], f->far[k]), to);
    }
    *out_range = from;
    return from <= to;
}

/* Shears the corners of a triangle.
 *   axis   of the lanes: 3 must be a constant, so that each kind has code of its own */
INLINE void ray_lanes_shear(const ray_lanes *f, global const bvh_block *block, const uint lane,
                            const uint axis, float16 x[3], float16 y[3], float16 z[3])
{
    const uint axis_x = axis == 2 ? 0 : axis + 1, axis_y = axis == 0 ? 2 : axis - 1;

    UNROLL
    for (int v = 0; v < 3; v++) {
        float16 at[3];
        if (axis < 3) {
            at[0] = block->vertex[v][axis_x][lane];
            at[1] = block->vertex[v][axis_y][lane];
            at[2] = block->vertex[v][axis][lane];
        } else {
            const float16 east = block->vertex[v][0][lane], north = block->vertex[v][1][lane],
                          up = block->vertex[v][2][lane];
            at[0] = f->along_z ? east : f->along_y ? up : north;
            at[1] = f->along_z ? north : f->along_y ? east : up;
            at[2] = f->along_z ? up : f->along_y ? north : east;
        }
        z[v] = at[2] - f->origin[2];
        x[v] = (at[0] - f->origin[0]) - f->slope_x * z[v];
        y[v] = (at[1] - f->origin[1]) - f->slope_y * z[v];
    }
}

/* Edge functions of a triangle, and the lowest and the highest of the three. distance / determinant is
 * the range. */
typedef struct ray_lanes_edges {
    float16 determinant, distance, lowest, highest;
} ray_lanes_edges;

/* The edges of sheared corners. */
INLINE ray_lanes_edges ray_lanes_edges_of(const float16 x[3], const float16 y[3],
                                          const float16 z[3], const float16 scale_z)
{
    const float16 a = x[2] * y[1] - y[2] * x[1];
    const float16 b = x[0] * y[2] - y[0] * x[2];
    const float16 c = x[1] * y[0] - y[1] * x[0];

    return (ray_lanes_edges){(a + b) + c, ((a * z[0] + b * z[1]) + c * z[2]) * scale_z,
                             ray_lanes_least(ray_lanes_least(a, b), c),
                             ray_lanes_most(ray_lanes_most(a, b), c)};
}

/* The edges of one triangle as all lanes see it. */
INLINE ray_lanes_edges ray_lanes_edges_of_one(const ray_lanes *f, global const bvh_block *block,
                                              const uint lane, const uint axis)
{
    float16 x[3], y[3], z[3];

    ray_lanes_shear(f, block, lane, axis, x, y, z);
    return ray_lanes_edges_of(x, y, z, f->scale_z);
}

/* The lanes that are inside of all edges on a side that counts. Where all edges are 0, seen edge-on, the
 * range is no number. */
INLINE int16 ray_lanes_inside(const ray_lanes_edges *e, const float16 front, const float16 back)
{
    return (e->lowest >= front) | (e->highest <= back);
}

/* The lanes of them whose range is above 0: its two parts have one sign. */
INLINE int16 ray_lanes_before(const ray_lanes_edges *e)
{
    return (e->distance != 0.0f) & ~(as_int16(e->distance) ^ as_int16(e->determinant));
}

/* Two lanes: the first in all of the low half, the second in the high. */
INLINE float16 ray_lanes_two(const float16 *of, const uint first, const uint second)
{
    const float *lane = (const float *)of;

    return (float16)((float8)lane[first], (float8)lane[second]);
}

/* The edges of all triangles of a block as two lanes see them, a half each.
 *   axis   of the lanes, below 3 */
INLINE ray_lanes_edges ray_lanes_edges_of_two(const ray_lanes *f, global const bvh_block *block,
                                              const uint first, const uint second, const uint axis)
{
    const uint axis_x = axis == 2 ? 0 : axis + 1, axis_y = axis == 0 ? 2 : axis - 1;
    const float16 slope_x = ray_lanes_two(&f->slope_x, first, second);
    const float16 slope_y = ray_lanes_two(&f->slope_y, first, second);
    float16 origin[3], x[3], y[3], z[3];

    UNROLL
    for (int k = 0; k < 3; k++) origin[k] = ray_lanes_two(&f->origin[k], first, second);
    UNROLL
    for (int v = 0; v < 3; v++) {
        const float8 at_x = *(global const float8 *)block->vertex[v][axis_x];
        const float8 at_y = *(global const float8 *)block->vertex[v][axis_y];
        const float8 at_z = *(global const float8 *)block->vertex[v][axis];
        z[v] = (float16)(at_z, at_z) - origin[2];
        x[v] = ((float16)(at_x, at_x) - origin[0]) - slope_x * z[v];
        y[v] = ((float16)(at_y, at_y) - origin[1]) - slope_y * z[v];
    }
    return ray_lanes_edges_of(x, y, z, ray_lanes_two(&f->scale_z, first, second));
}

/* What triangle_plane_range tells, of one triangle for all lanes. */
static inline float16 ray_lanes_plane_range(const ray_lanes *f, const float vertex[3][3])
{
    const triangle_plane plane = triangle_plane_of(vertex);
    double_float16 distance = {0, 0}, speed = {0, 0};

    for (int k = 0; k < 3; k++) {
        const double_float16 normal = {plane.normal[k].high, plane.normal[k].low};
        const double_float16 along = {*(const float16 *)f->direction[k], 0};
        const double_float16 away =
            double_float16_sum((float16)vertex[plane.corner][k], -*(const float16 *)f->start[k]);
        distance = double_float16_add(distance, double_float16_multiply(normal, away));
        speed = double_float16_add(speed, double_float16_multiply(normal, along));
    }
    return double_float16_divide(distance, speed).high;
}

/* The largest magnitude of the three. */
static inline float16 ray_lanes_widest(const float16 of[3])
{
    return ray_lanes_most(ray_lanes_most(fabs(of[0]), fabs(of[1])), fabs(of[2]));
}

/* What triangle_doubt tells, but for the scale. */
static inline float16 ray_lanes_doubt(const float16 x[3], const float16 y[3], const float16 z[3],
                                      const float16 determinant)
{
    const float16 u = z[1] - z[0], v = z[2] - z[0];
    const float16 rise_x = u * (y[2] - y[0]) - v * (y[1] - y[0]);
    const float16 rise_y = u * (x[2] - x[0]) - v * (x[1] - x[0]);
    const float16 wide_x = ray_lanes_widest(x), wide_y = ray_lanes_widest(y);
    const float16 far = ray_lanes_widest(z);

    return (far * determinant + (far + (wide_x + wide_y)) * (fabs(rise_x) + fabs(rise_y))) +
           (wide_x * wide_y) * (fabs(u) + fabs(v));
}

/* Where lanes inside of a long triangle meet it: triangle_range for all. */
RARE float16 ray_lanes_range(const ray_lanes *f, global const bvh_block *block, const uint lane,
                             const int16 inside, const float16 limit)
{
    float16 x[3], y[3], z[3];
    float vertex[3][3];

    ray_lanes_shear(f, block, lane, 3, x, y, z);
    const ray_lanes_edges e = ray_lanes_edges_of(x, y, z, f->scale_z);
    const float16 doubt = ray_lanes_doubt(x, y, z, fabs(e.determinant)) * fabs(f->scale_z);
    const float16 range = e.distance / e.determinant;
    const float16 error = TRIANGLE_ROUNDING * doubt / fabs(e.determinant);
    const int16 again = inside & (doubt > TRIANGLE_DOUBT * fabs(e.distance)) &
                        ~((range + error <= 0.0f) | (range - error > limit));
    if (mask_of_16(again) == 0) return range;
    ray_triangle(block, lane, vertex);
    const float16 below = ray_lanes_least(ray_lanes_plane_range(f, vertex), range + error);
    const float16 near = ray_lanes_most(below, range - error);
    const int16 wrong = again & (fabs(near - range) > TRIANGLE_RIGHT * fabs(near));
    return wrong ? near : range;
}

/* The same for one lane.
 *   axis   of the lanes, below 3 */
RARE float ray_lanes_range_of_one(const ray_lanes *f, global const bvh_block *block,
                                  const uint lane, const uint axis, const uint triangle,
                                  const float limit)
{
    const triangle_shear s = {axis == 2 ? 0 : axis + 1,
                              axis == 0 ? 2 : axis - 1,
                              axis,
                              ((const float *)&f->slope_x)[lane],
                              ((const float *)&f->slope_y)[lane],
                              ((const float *)&f->scale_z)[lane]};
    float vertex[3][3], origin[3], direction[3];

    for (int k = 0; k < 3; k++) {
        origin[k] = f->start[k][lane];
        direction[k] = f->direction[k][lane];
    }
    ray_triangle(block, triangle, vertex);
    return triangle_range(vertex, origin, direction, &s, limit);
}

#endif
