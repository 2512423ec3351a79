/* Hit lanes: where LANES_WIDTH rays met their triangles, computed as ray_record of ray.h computes one,
 * operation by operation. */
#ifndef HIT_LANES_H
#define HIT_LANES_H

#include "kernels/lanes.h"
#include "kernels/rays/ray_packet.h"

typedef struct hit_lanes {
    lanes point[3];
    lanes normal[3]; /* unit, turned towards the ray's origin */
} hit_lanes;

/* Corners of the triangles that the rays met; all 0 where one met none. */
static inline void hit_lanes_corners(global const bvh_block *blocks, const ray_packet_hit *met,
                                     lanes out[3][3])
{
    UNROLL
    for (int v = 0; v < 3; v++) UNROLL
    for (int k = 0; k < 3; k++) out[v][k] = (lanes)0.0f;
    for (uint i = 0; i < LANES_WIDTH; i++) {
        if (met->facet[i] == RECORD_NONE) continue;
        global const bvh_block *block = blocks + (met->triangle[i] & ~RAY_LONG) / 8;
        UNROLL
        for (int v = 0; v < 3; v++) UNROLL
        for (int k = 0; k < 3; k++)
            LANES_SET(out[v][k], i, block->vertex[v][k][met->triangle[i] % 8]);
    }
}

/* Shares of the corners in the points met. x and y of the shear never change places, which changes
 * the signs of all edges and no fraction. */
static inline void hit_lanes_shares(const lanes corner[3][3], const lanes o[3], const lanes d[3],
                                    lanes out[3])
{
    const lanes_mask y_over_x = fabs(d[1]) > fabs(d[0]);
    const lanes_mask along_z = fabs(d[2]) > (y_over_x ? fabs(d[1]) : fabs(d[0]));
    const lanes_mask along_y = y_over_x & ~along_z;
    lanes x[3], y[3], z[3];
    const lanes dx = along_z ? d[0] : along_y ? d[2] : d[1];
    const lanes dy = along_z ? d[1] : along_y ? d[0] : d[2];
    const lanes dz = along_z ? d[2] : along_y ? d[1] : d[0];
    const lanes slope_x = dx / dz, slope_y = dy / dz;

    UNROLL
    for (int v = 0; v < 3; v++) {
        const lanes a = corner[v][0] - o[0], b = corner[v][1] - o[1], c = corner[v][2] - o[2];
        z[v] = along_z ? c : along_y ? b : a;
        x[v] = (along_z ? a : along_y ? c : b) - slope_x * z[v];
        y[v] = (along_z ? b : along_y ? a : c) - slope_y * z[v];
    }
    out[0] = x[2] * y[1] - y[2] * x[1];
    out[1] = x[0] * y[2] - y[0] * x[2];
    out[2] = x[1] * y[0] - y[1] * x[0];
    const lanes determinant = (out[0] + out[1]) + out[2];
    UNROLL
    for (int v = 0; v < 3; v++) out[v] /= determinant;
}

/* Unit normals as triangle_normal has them. */
static inline void hit_lanes_normals(const lanes corner[3][3], lanes out[3])
{
    lanes u[3], v[3], largest = (lanes)0.0f;

    UNROLL
    for (int k = 0; k < 3; k++) {
        u[k] = corner[1][k] - corner[0][k];
        v[k] = corner[2][k] - corner[0][k];
    }
    UNROLL
    for (int k = 0; k < 3; k++) {
        const int a = (k + 1) % 3, b = (k + 2) % 3;
        out[k] = u[a] * v[b] - u[b] * v[a];
        largest = fabs(out[k]) > largest ? fabs(out[k]) : largest;
    }
    UNROLL
    for (int k = 0; k < 3; k++) out[k] /= largest;
    const lanes length = sqrt(out[0] * out[0] + out[1] * out[1] + out[2] * out[2]);
    UNROLL
    for (int k = 0; k < 3; k++) out[k] /= length;
}

/* Puts the points right that lie on long triangles, as ray_record does. */
static inline void hit_lanes_set_points(const lanes corner[3][3], const lanes origin[3],
                                        const lanes direction[3], const ray_packet_hit *met,
                                        lanes point[3])
{
    for (uint i = 0; i < LANES_WIDTH; i++) {
        float vertex[3][3], from[3], along[3], right[3];
        if (!(met->triangle[i] & RAY_LONG)) continue;
        for (int k = 0; k < 3; k++) {
            for (int v = 0; v < 3; v++) vertex[v][k] = ((const float *)&corner[v][k])[i];
            from[k] = ((const float *)&origin[k])[i];
            along[k] = ((const float *)&direction[k])[i];
        }
        const triangle_shear shear = triangle_shear_of(along);
        if (!triangle_point(vertex, from, along, &shear, right)) continue;
        for (int k = 0; k < 3; k++) LANES_SET(point[k], i, right[k]);
    }
}

/* ray_offset at each point. */
static inline lanes hit_lanes_offset(const world_record *world, const hit_lanes *at)
{
    const lanes size = (fabs(at->point[0] * at->normal[0]) + fabs(at->point[1] * at->normal[1])) +
                       fabs(at->point[2] * at->normal[2]);

    return fmax((lanes)world->offset_m, RAY_PAD * size);
}

/* Where the rays met their triangles; nothing of use in lanes that met none. */
static inline hit_lanes hit_lanes_of(global const bvh_block *blocks, const lanes origin[3],
                                     const lanes direction[3], const ray_packet_hit *met)
{
    lanes corner[3][3], fraction[3];
    hit_lanes out;

    hit_lanes_corners(blocks, met, corner);
    hit_lanes_shares(corner, origin, direction, fraction);
    hit_lanes_normals(corner, out.normal);
    const lanes along = (out.normal[0] * direction[0] + out.normal[1] * direction[1]) +
                        out.normal[2] * direction[2];
    UNROLL
    for (int k = 0; k < 3; k++) {
        out.point[k] =
            (fraction[0] * corner[0][k] + fraction[1] * corner[1][k]) + fraction[2] * corner[2][k];
        out.normal[k] = along > 0.0f ? -out.normal[k] : out.normal[k];
    }
    hit_lanes_set_points(corner, origin, direction, met, out.point);
    return out;
}

#endif
