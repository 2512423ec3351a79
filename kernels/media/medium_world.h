/* What rays need to know of a scene's transmissive bodies, on host and device. */
#ifndef CROSSING_WORLD_H
#define CROSSING_WORLD_H

#include "kernels/media/transmission.h"

/* Besides the triangles. */
typedef struct medium_world {
    float low[3], high[3];              /* box of all */
    float altitude_m;                   /* of z 0, for the air's temperature */
    uint level_count;                   /* of the air */
    float stated_k[TRANSMISSION_MEDIA]; /* a material's temperature; 0: the air's at its middle */
    float broad_band_per_m[TRANSMISSION_MEDIA]; /* extinction of sunlight */
    uint scatters[TRANSMISSION_MEDIA];          /* 1: a material has a table of scattering */
} medium_world;
RECORD_SIZE(medium_world, 80);

/* Transmissive bodies in a tree of their own.
 *   medium_row   of every facet: its material's row of the extinction
 *   air_level    shape (bodies.level_count, 2): altitude m, temperature K; altitudes ascend */
#define MEDIUM_TABLES(TABLE, AND)                                                                  \
    TABLE(medium_world, media)                                                                     \
    AND TABLE(global const bvh_node *, medium_nodes)                                               \
    AND TABLE(global const bvh_block *, medium_blocks)                                             \
    AND TABLE(global const uint *, medium_row)                                                     \
    AND TABLE(global const float *, air_level)

#ifdef __OPENCL_C_VERSION__
TABLES_STRUCT(medium_tables, MEDIUM_TABLES);
#endif

#endif
