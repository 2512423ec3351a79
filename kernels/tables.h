/* Tables: what many kernels read, in groups. A group is listed once,
 *   #define SOME_TABLES(TABLE, AND) TABLE(type, name) AND TABLE([OPTIONAL] global const type *, name)
 * and a kernel takes it whole: kernel void some(TABLES(SOME_TABLES), ...). kernels/launches.py reads the
 * list for the host, where a struct of the same name holds the buffers. */
#ifndef TABLES_H
#define TABLES_H

#include "kernels/records.h"

/* The tree of what is opaque, and what rays need to know besides. */
#define TREE_TABLES(TABLE, AND)                                                                    \
    TABLE(world_record, world)                                                                     \
    AND TABLE(global const bvh_node *, nodes)                                                      \
    AND TABLE(global const bvh_block *, blocks)

/* Facets, the ground plane's behind the real ones, their temperatures, and the materials that they name. */
#define SURFACE_TABLES(TABLE, AND)                                                                 \
    TABLE(global const facet_record *, facets)                                                     \
    AND TABLE(global const material_record *, materials)                                           \
    AND TABLE(global const float *, facet_temperature_k)

/* Spectra, in rows of the frame's sample_count floats each:
 *   rows         SPECTRA_... of records.h
 *   emissivity   of the materials, and their diffuse lobes
 *   extinction   CLOUD_... of cloud.h; NULL: no transmissive bodies
 * and how samples lie between knots; NULL: all samples are knots.
 *   knot_first      shape (blocks of SPECTRA_BLOCK samples): the first knot that each takes
 *   knot_fraction   shape (blocks, knot_span, SPECTRA_BLOCK): what each knot counts at its samples */
#define SPECTRA_TABLES(TABLE, AND)                                                                 \
    TABLE(global const float *, rows)                                                              \
    AND TABLE(global const float *, emissivity)                                                    \
    AND TABLE(OPTIONAL global const float *, extinction)                                           \
    AND TABLE(OPTIONAL global const uint *, knot_first)                                            \
    AND TABLE(OPTIONAL global const float *, knot_fraction)

/* Rays of points' hemispheres, and what they met.
 *   cell             shape (sets, cell_count, 4): direction along upslope, across and normal, weight; all sets
 *                    have the same weights
 *   hit              shape (count): the points
 *   met              shape (cell_count, count): as hemisphere.cl writes it; behind those NEAR_FACETS rows more
 *                    where there is `near_rays`
 *   order            shape (count): which point of what is computed each of these is; NULL: the same
 *   near_rays        shape (NEAR_FACETS, 4, count), see near_facets.cl; NULL: none
 *   direction_set    shape (count): the set that each takes; NULL: the first
 * and what the rays of pixels' specular shares met, NULL where all surfaces are taken as diffuse:
 *   background       shape (pixels): of mirrors, what they show
 *   background_lit   shape (pixels): whether the sun reaches that
 *   gloss_words      shape (LOBE_RAYS, pixels), see gloss.cl; NULL where nothing is rough */
#define HEMISPHERE_TABLES(TABLE, AND)                                                              \
    TABLE(global const float *, cell)                                                              \
    AND TABLE(global const hit_record *, hit)                                                      \
    AND TABLE(global const uint *, met)                                                            \
    AND TABLE(OPTIONAL global const uint *, order)                                                 \
    AND TABLE(OPTIONAL global const uint *, direction_set)                                         \
    AND TABLE(OPTIONAL global const float *, near_rays)                                            \
    AND TABLE(OPTIONAL global const background_record *, background)                               \
    AND TABLE(OPTIONAL global const float *, background_lit)                                       \
    AND TABLE(OPTIONAL global const uint *, gloss_words)

/* Light between facets, the ground's last.
 *   facet_background   shape (facets): what each sees
 *   light              shape (facets, LIGHT_ROWS, light_length), see interreflection.cl */
#define LIGHT_TABLES(TABLE, AND)                                                                   \
    TABLE(global const background_record *, facet_background)                                      \
    AND TABLE(global const float *, light)

#ifdef __OPENCL_C_VERSION__

TABLES_STRUCT(tree_tables, TREE_TABLES);
TABLES_STRUCT(surface_tables, SURFACE_TABLES);
TABLES_STRUCT(spectra_tables, SPECTRA_TABLES);
TABLES_STRUCT(hemisphere_tables, HEMISPHERE_TABLES);
TABLES_STRUCT(light_tables, LIGHT_TABLES);

#endif

#endif
