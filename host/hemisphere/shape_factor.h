/* Shape factor: the fraction of the hemisphere above a point that sees the sky, and what hides the
 * rest. Thesis 2.4.2, eq. 2.4.2-6, 2.4.2-7. */
#ifndef SHAPE_FACTOR_H
#define SHAPE_FACTOR_H

#include "hemisphere/hemisphere_grid.h"
#include "rays/ray_scene.h"

/* What one run over points works with. */
typedef struct shape_factor_points {
    uint32_t count;
    hit_record_buffer hit; /* shape (count); only point, facet and normal are read */
    uint_buffer
        met; /* shape (hemisphere_grid_cell_count, and NEAR_FACETS where there is near_rays, count): written,
                      * hemisphere.cl */
    float_buffer
        near_rays; /* shape (NEAR_FACETS, 4, count): written, near_facets.cl; NULL: nobody asks */
    uint_buffer order; /* shape (count): which point of what is computed each of these is; NULL: the
                        * same */
    uint_buffer
        direction_set; /* shape (count): of grids of several sets; NULL: the first for all */
} shape_factor_points;

/* Casts the rays of the hemisphere above every point and tells what they meet; the rest as below. */
status shape_factor_trace(const hemisphere_grid *grid, const ray_scene *scene, const float *sun,
                          const shape_factor_points *points);

/* Samples the hemisphere above every point; both sides of a facet are seen. A ray that leaves the
 * scene sees the sky, or the ground plane if that is there and the ray goes down.
 *   surfaces         that they may meet
 *   sun              unit vector towards the sun: facets met are marked where it reaches them; NULL:
 *                    nobody asks
 *   out_background   shape (count). Points without a facet get factor 1 and no
 *                    background. Of equally common materials the lowest number is taken; at most
 *                    256 materials are counted at a point */
status shape_factor_run(const hemisphere_grid *grid, const ray_scene *scene,
                        const surface_tables *surfaces, const float *sun,
                        const shape_factor_points *points, background_record_buffer out_background);

/* What kernels read of the rays of a run. */
hemisphere_tables shape_factor_rays(const hemisphere_grid *grid, const shape_factor_points *points);

#endif
