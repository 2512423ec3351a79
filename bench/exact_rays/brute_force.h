/* Brute force: what rays meet, every ray against every triangle in double precision (Moeller, Trumbore,
 * "Fast, minimum storage ray/triangle intersection", 1997). */
#ifndef BRUTE_FORCE_H
#define BRUTE_FORCE_H

#include "bench_mesh.h"

/* Finds the nearest triangle of each ray, from both sides; the lowest of equal ones. Edges belong to
 * their triangles.
 *   rays           shape (6, count): origins, directions
 *   out_range      shape (count), in lengths of the direction: INFINITY for a miss
 *   out_triangle   shape (count), index into mesh->triangle: UINT32_MAX for a miss */
status brute_force_trace(const bench_mesh *mesh, const float *rays, uint32_t count,
                         double *out_range, uint32_t *out_triangle);

/* How a ray passes a triangle.
 *   out_range     where it crosses the triangle's plane, in lengths of the direction
 *   returns       metres from the point of crossing to the triangle, 0 inside; INFINITY where the ray
 *                 is parallel to the plane or crosses it behind its origin */
double brute_force_distance(const bench_mesh *mesh, uint32_t triangle, const double ray[6],
                            double *out_range);

#endif
